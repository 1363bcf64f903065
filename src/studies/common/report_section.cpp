#include "studies/common/report_section.h"

#include <cmath>

#include "core/format.h"
#include "studies/common/html_page.h"
#include "studies/common/report_figures.h"

namespace ifov::studies {
namespace {

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

}  // namespace

ReportSection unmeasured_of(std::string_view of, const std::vector<NotMeasured>& figures) {
  ReportSection section;
  section.title = "Not measured";
  section.text =
      format("What is asked of {} and is not measured here, with the reason; none of it counts as met.", of);
  for (const NotMeasured& one : figures) section.not_measured(one.name, one.meaning, one.missing);
  return section;
}

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

std::string sections_markdown(std::string_view title, std::string_view about, std::string_view prefix,
                              const std::vector<ReportSection>& sections) {
  std::string out = format("# {}\n\n{}\n", title, about);
  for (const ReportSection& section : sections) {
    out += format("\n## {}\n\n{}\n\n| what | found | must be | |\n|---|---|---|---|\n", section.title,
                  section.text);
    for (const Figure& f : section.figures.figures())
      out += format("| {} | {} {} | {} | {} |\n", cell(f.meaning),
                    std::isfinite(f.value) ? format("{:.3g}", f.value) : "-", cell(f.unit), cell(f.must),
                    !f.ok   ? ""
                    : *f.ok ? "yes"
                            : "**no**");
    for (const ReportPlot& plot : section.plots)
      out += format("\n![{}]({}_{}.svg)\n\n{}\n", plot.plot.title, prefix, plot.name, plot.caption);
  }
  return out;
}

}  // namespace ifov::studies
