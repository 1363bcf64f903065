#include "studies/sensor/sensor_study.h"

#include "studies/common/study_files.h"
#include "studies/common/study_sections.h"
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
  const ReferenceData reference(reference_folder(options));
  const auto measured = {orbit_section,      location_section,     bands_section,    tirs_section,
                         modulation_section, point_target_section, channels_section, pupil_section,
                         scanning_section,   moving_section,       noise_section,    parts_section,
                         cost_section,       memory_section,       missing_section};
  const StudyPage page{"sensor", kSensorAbout};
  return write_sections(kSensorTitle, measure_sections(measured, SectionOptions{reference, options}, options),
                        options, &page);
}

}  // namespace ifov::studies
