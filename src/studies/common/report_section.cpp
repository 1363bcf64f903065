#include "studies/common/report_section.h"

#include "core/format.h"
#include "studies/common/html_page.h"
#include "studies/common/report_figures.h"

namespace ifov::studies {

std::string sections_page(std::string_view title, const std::vector<ReportSection>& sections,
                          ReportFigures& figures) {
  std::string body;
  for (const ReportSection& section : sections) {
    body += format("<h2>{}</h2>\n<p>{}</p>\n{}", html_text(section.title), html_text(section.text),
                   section.figures.html());
    for (const ReportPlot& plot : section.plots)
      body += format("<figure>{}<figcaption>{}</figcaption></figure>\n", figures.add(plot.plot),
                     html_text(plot.caption));
  }
  return html_page(title, body);
}

}  // namespace ifov::studies
