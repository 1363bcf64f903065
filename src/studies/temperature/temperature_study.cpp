#include "studies/temperature/temperature_study.h"

#include "core/error.h"
#include "core/format.h"
#include "studies/common/report_figures.h"
#include "studies/common/study_files.h"
#include "studies/temperature/temperature_sections.h"

namespace ifov::studies {
namespace {

constexpr const char* kTemperatureTitle = "Validation of solved temperatures";
constexpr const char* kTemperatureAbout =
    "Made by `ifov study temperature --reference DIR`, where DIR holds the reference data; what is missing there is not measured. "
    "[Theory](../theory/temperature.md).";

}  // namespace

StudyOutcome run_temperature_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  make_folder(options.output_folder / "page");
  const ReferenceData reference(reference_folder(options));
  const TemperatureOptions choices{reference, options};
  std::vector<ReportSection> sections;
  for (const auto section :
       {conduction_section, balance_section, shadow_section, fault_section, height_section, suburb_section,
        measured_day_section, query_section, unmeasured_section}) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    sections.push_back(section(choices));
    if (options.log != nullptr) options.log->info(sections.back().title);
  }
  FigureTable all;
  for (const ReportSection& section : sections) all.append(section.figures);
  StudyOutcome outcome{all.text(), {}, all.all_met()};
  const auto keep = [&](const std::string& name, const std::string& content) {
    write_file(options.output_folder / name, content);
    outcome.files.push_back(options.output_folder / name);
  };
  keep("figures.json", all.json());
  ReportFigures drawn;
  keep("report.html", sections_page(kTemperatureTitle, sections, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  keep("page/temperature.md",
       sections_markdown(kTemperatureTitle, kTemperatureAbout, "temperature", sections));
  for (const ReportSection& section : sections)
    for (const ReportPlot& plot : section.plots)
      keep(format("page/temperature_{}.svg", plot.name), draw(plot.plot).svg);
  return outcome;
}

}  // namespace ifov::studies
