#pragma once

#include "studies/common/study_options.h"

namespace ifov::studies {

/// Study 1, `ifov study aliasing`: a resolution chart against its exact answer.
StudyOutcome run_aliasing_study(const StudyOptions& options);

}  // namespace ifov::studies
