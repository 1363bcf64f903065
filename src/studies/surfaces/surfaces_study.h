#pragma once

#include "studies/common/study_options.h"

namespace ifov::studies {

/// `ifov study surfaces`: models of scattering against what they promise and against closed forms, by themselves and rendered.
StudyOutcome run_surfaces_study(const StudyOptions& options);

}  // namespace ifov::studies
