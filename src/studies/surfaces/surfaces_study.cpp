#include "studies/surfaces/surfaces_study.h"

#include <vector>

#include "core/error.h"
#include "studies/common/report_figures.h"
#include "studies/common/study_files.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {

StudyOutcome run_surfaces_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  std::vector<ReportSection> sections;
  for (const auto section : {models_section, lobes_section, fresnel_section, furnace_section, sea_section,
                             domes_section, model_speed_section}) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    sections.push_back(section(options));
    if (options.log != nullptr) options.log->info(sections.back().title);
  }
  FigureTable all;
  for (const ReportSection& section : sections) all.append(section.figures);
  StudyOutcome outcome{all.text(), {}, all.all_met()};
  const auto keep = [&](const char* name, const std::string& content) {
    write_file(options.output_folder / name, content);
    outcome.files.push_back(options.output_folder / name);
  };
  keep("figures.json", all.json());
  ReportFigures drawn;
  keep("report.html", sections_page("Surfaces", sections, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  return outcome;
}

}  // namespace ifov::studies
