#include "studies/atmosphere/atmosphere_study.h"

#include "core/error.h"
#include "core/format.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/model_comparisons.h"
#include "studies/common/report_figures.h"
#include "studies/common/study_files.h"

namespace ifov::studies {
namespace {

constexpr const char* kTitle = "Validation of the atmosphere";
constexpr const char* kAbout =
    "Made by `ifov study atmosphere --reference DIR`, where DIR holds the reference data; what is missing "
    "there is not "
    "measured. Theory: [the atmosphere](../theory/atmosphere.md) and [light in "
    "it](../theory/atmosphere_scattering.md).";

}  // namespace

StudyOutcome run_atmosphere_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  make_folder(options.output_folder / "page");
  const ReferenceData reference(reference_folder(options));
  const AtmosphereOptions choices{reference, options, options.is_quick()};
  std::vector<AtmosphereSection> sections;
  for (const auto section :
       {lowtran7_section, terms_section, scattering_section, solar_codes_section, thermal_codes_section,
        broadband_section, nodes_section, rendered_section, sun_section, speed_section}) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    sections.push_back(section(choices));
    if (options.log != nullptr) options.log->info(sections.back().title);
  }
  const std::vector<ModelComparison> comparisons = model_comparisons(reference, options.is_quick() ? 24 : 6);
  sections.push_back(model_section(comparisons));
  FigureTable all;
  for (const AtmosphereSection& section : sections) all.append(section.figures);
  StudyOutcome outcome{all.text(), {}, all.all_met()};
  const auto keep = [&](const std::string& name, const std::string& content) {
    write_file(options.output_folder / name, content);
    outcome.files.push_back(options.output_folder / name);
  };
  keep("figures.json", all.json());
  keep("model_comparisons.csv", comparisons_csv(comparisons));
  ReportFigures drawn;
  keep("report.html", sections_page(kTitle, sections, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  keep("page/atmosphere.md", sections_markdown(kTitle, kAbout, "atmosphere", sections));
  for (const AtmosphereSection& section : sections)
    for (const ReportPlot& plot : section.plots)
      keep(format("page/atmosphere_{}.svg", plot.name), draw(plot.plot).svg);
  return outcome;
}

}  // namespace ifov::studies
