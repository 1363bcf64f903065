#pragma once

#include <span>
#include <string_view>

#include "studies/common/study_options.h"

namespace ifov::studies {

/// All studies, in the order of the help page.
std::span<const StudyEntry> all_studies();

/// null where there is none of that name.
const StudyEntry* find_study(std::string_view name);

}  // namespace ifov::studies
