#include "studies/common/study_sections.h"

#include <string>

#include "core/format.h"
#include "studies/common/report_figures.h"
#include "studies/common/study_files.h"

namespace ifov::studies {

StudyOutcome write_sections(std::string_view title, const std::vector<ReportSection>& sections,
                            const StudyOptions& options, const StudyPage* page) {
  make_folder(options.output_folder);
  FigureTable all;
  for (const ReportSection& section : sections) all.append(section.figures);
  StudyOutcome outcome{all.text(), {}, all.all_met()};
  const auto keep = [&](const std::string& name, const std::string& content) {
    write_file(options.output_folder / name, content);
    outcome.files.push_back(options.output_folder / name);
  };
  keep("figures.json", all.json());
  ReportFigures drawn;
  keep("report.html", sections_page(title, sections, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  if (page == nullptr) return outcome;
  make_folder(options.output_folder / "page");
  keep(format("page/{}.md", page->name), sections_markdown(title, page->about, page->name, sections));
  for (const ReportSection& section : sections)
    for (const ReportPlot& plot : section.plots)
      keep(format("page/{}_{}.svg", page->name, plot.name), draw(plot.plot).svg);
  return outcome;
}

}  // namespace ifov::studies
