#include "studies/temperature/temperature_study.h"

#include "studies/common/study_files.h"
#include "studies/common/study_sections.h"
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
  const ReferenceData reference(reference_folder(options));
  const auto measured = {conduction_section,   balance_section, shadow_section,
                         fault_section,        height_section,  suburb_section,
                         measured_day_section, query_section,   unmeasured_section};
  const StudyPage page{"temperature", kTemperatureAbout};
  return write_sections(kTemperatureTitle,
                        measure_sections(measured, SectionOptions{reference, options}, options), options,
                        &page);
}

}  // namespace ifov::studies
