#pragma once

#include "studies/common/reference_data.h"
#include "studies/common/report_section.h"
#include "studies/common/study_options.h"

/// The sections of the study of sensors.
namespace ifov::studies {

struct SensorOptions {
  const ReferenceData& reference;
  const StudyOptions& study;
};

ReportSection orbit_section(const SensorOptions& options);
ReportSection location_section(const SensorOptions& options);
ReportSection bands_section(const SensorOptions& options);
ReportSection tirs_section(const SensorOptions& options);
ReportSection modulation_section(const SensorOptions& options);
ReportSection point_target_section(const SensorOptions& options);
ReportSection channels_section(const SensorOptions& options);
ReportSection scanning_section(const SensorOptions& options);
ReportSection noise_section(const SensorOptions& options);
ReportSection parts_section(const SensorOptions& options);
ReportSection cost_section(const SensorOptions& options);
/// What is asked of sensors and cannot be measured, with why.
ReportSection missing_section(const SensorOptions& options);

}  // namespace ifov::studies
