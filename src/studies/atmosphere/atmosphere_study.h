#pragma once

#include "studies/common/study_options.h"

namespace ifov::studies {

/// `ifov study atmosphere`: the modelled atmosphere against published tables, other programs and itself.
/// Writes figures.json, report.html, and a folder `page` with the same as Markdown and SVG.
StudyOutcome run_atmosphere_study(const StudyOptions& options);

}  // namespace ifov::studies
