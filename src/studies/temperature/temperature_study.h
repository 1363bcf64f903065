#pragma once

#include "studies/common/study_options.h"

namespace ifov::studies {

/// `ifov study temperature`: temperatures that are solved under weather, against closed forms and full solutions.
StudyOutcome run_temperature_study(const StudyOptions& options);

}  // namespace ifov::studies
