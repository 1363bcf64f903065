#pragma once

#include "studies/common/study_options.h"

namespace ifov::studies {

/// Study 2, `ifov study thermal`: sub-pixel thermal radiometry.
StudyOutcome run_thermal_study(const StudyOptions& options);

}  // namespace ifov::studies
