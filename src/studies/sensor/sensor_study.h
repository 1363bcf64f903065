#pragma once

#include "studies/common/study_options.h"

namespace ifov::studies {

/// `ifov study sensor`: orbits, cameras, scanners, optics and detectors against published verifications and closed forms.
StudyOutcome run_sensor_study(const StudyOptions& options);

}  // namespace ifov::studies
