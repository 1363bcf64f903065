#include "studies/atmosphere/atmosphere_study.h"

#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/model_comparisons.h"
#include "studies/common/study_files.h"
#include "studies/common/study_sections.h"

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
  const ReferenceData reference(reference_folder(options));
  const auto measured = {lowtran7_section,    terms_section,         scattering_section, solar_codes_section,
                         round_earth_section, thermal_codes_section, broadband_section,  nodes_section,
                         rendered_section,    sun_section,           speed_section};
  std::vector<ReportSection> sections =
      measure_sections(measured, SectionOptions{reference, options}, options);
  const std::vector<ModelComparison> comparisons = model_comparisons(reference, options.is_quick() ? 24 : 6);
  sections.push_back(model_section(comparisons));
  const StudyPage page{"atmosphere", kAbout};
  StudyOutcome outcome = write_sections(kTitle, sections, options, &page);
  const std::filesystem::path file = options.output_folder / "model_comparisons.csv";
  write_file(file, comparisons_csv(comparisons));
  outcome.files.push_back(file);
  return outcome;
}

}  // namespace ifov::studies
