#pragma once

#include "studies/common/study_sections.h"

/// The sections of the study of temperatures.
namespace ifov::studies {

ReportSection conduction_section(const SectionOptions& options);
ReportSection balance_section(const SectionOptions& options);
ReportSection shadow_section(const SectionOptions& options);
ReportSection fault_section(const SectionOptions& options);
ReportSection height_section(const SectionOptions& options);
ReportSection suburb_section(const SectionOptions& options);
ReportSection measured_day_section(const SectionOptions& options);
ReportSection query_section(const SectionOptions& options);
/// What is asked of temperatures and cannot be measured, with why.
ReportSection unmeasured_section(const SectionOptions& options);

}  // namespace ifov::studies
