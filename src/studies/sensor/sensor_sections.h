#pragma once

#include "studies/common/study_sections.h"

/// The sections of the study of sensors.
namespace ifov::studies {

ReportSection orbit_section(const SectionOptions& options);
ReportSection location_section(const SectionOptions& options);
ReportSection bands_section(const SectionOptions& options);
ReportSection tirs_section(const SectionOptions& options);
ReportSection modulation_section(const SectionOptions& options);
ReportSection point_target_section(const SectionOptions& options);
ReportSection channels_section(const SectionOptions& options);
ReportSection scanning_section(const SectionOptions& options);
ReportSection moving_section(const SectionOptions& options);
ReportSection pupil_section(const SectionOptions& options);
ReportSection noise_section(const SectionOptions& options);
ReportSection parts_section(const SectionOptions& options);
ReportSection cost_section(const SectionOptions& options);
ReportSection memory_section(const SectionOptions& options);
/// What is asked of sensors and cannot be measured, with why.
ReportSection missing_section(const SectionOptions& options);

}  // namespace ifov::studies
