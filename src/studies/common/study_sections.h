#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/run_control.h"
#include "studies/common/reference_data.h"
#include "studies/common/report_section.h"
#include "studies/common/study_options.h"

namespace ifov::studies {

/// What sections are measured by.
struct SectionOptions {
  const ReferenceData& reference;
  const StudyOptions& study;
};

/// Measures one section after the other and logs their titles. Throws Cancelled.
template <class Sections, class Choices>
std::vector<ReportSection> measure_sections(const Sections& measured, const Choices& choices,
                                            const StudyOptions& options) {
  std::vector<ReportSection> sections;
  for (const auto section : measured) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    sections.push_back(section(choices));
    if (options.log != nullptr) options.log->info(sections.back().title);
  }
  return sections;
}

/// The page of a study among the documentation's: page/NAME.md, its plots beside it.
struct StudyPage {
  std::string_view name, about;
};

/// Writes figures.json, report.html and, where there is a page, that.
StudyOutcome write_sections(std::string_view title, const std::vector<ReportSection>& sections,
                            const StudyOptions& options, const StudyPage* page = nullptr);

}  // namespace ifov::studies
