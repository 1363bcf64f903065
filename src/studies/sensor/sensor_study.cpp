#include "studies/sensor/sensor_study.h"

#include "core/error.h"
#include "core/format.h"
#include "studies/common/report_figures.h"
#include "studies/common/study_files.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr const char* kSensorTitle = "Validation of sensors";
constexpr const char* kSensorAbout =
    "Made by `ifov study sensor --reference DIR`, where DIR holds the reference data; what is missing there is not measured. Theory: "
    "[cameras and pixels](../theory/sensor.md), [orbits](../theory/orbits.md), [detectors](../theory/detectors.md).";

}  // namespace

StudyOutcome run_sensor_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  make_folder(options.output_folder / "page");
  const ReferenceData reference(reference_folder(options));
  const SensorOptions choices{reference, options};
  std::vector<ReportSection> sections;
  for (const auto section : {orbit_section, location_section, bands_section, tirs_section, modulation_section,
                             point_target_section, channels_section, scanning_section, noise_section,
                             parts_section, cost_section, missing_section}) {
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
  keep("report.html", sections_page(kSensorTitle, sections, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  keep("page/sensor.md", sections_markdown(kSensorTitle, kSensorAbout, "sensor", sections));
  for (const ReportSection& section : sections)
    for (const ReportPlot& plot : section.plots)
      keep(format("page/sensor_{}.svg", plot.name), draw(plot.plot).svg);
  return outcome;
}

}  // namespace ifov::studies
