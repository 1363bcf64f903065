#pragma once

#include "studies/common/reference_data.h"
#include "studies/common/report_section.h"
#include "studies/common/study_options.h"

/// The sections of the study of temperatures.
namespace ifov::studies {

struct TemperatureOptions {
  const ReferenceData& reference;
  const StudyOptions& study;
};

ReportSection conduction_section(const TemperatureOptions& options);
ReportSection balance_section(const TemperatureOptions& options);
ReportSection shadow_section(const TemperatureOptions& options);
ReportSection fault_section(const TemperatureOptions& options);
ReportSection height_section(const TemperatureOptions& options);
ReportSection suburb_section(const TemperatureOptions& options);
ReportSection measured_day_section(const TemperatureOptions& options);
ReportSection query_section(const TemperatureOptions& options);
/// What is asked of temperatures and cannot be measured, with why.
ReportSection unmeasured_section(const TemperatureOptions& options);

}  // namespace ifov::studies
