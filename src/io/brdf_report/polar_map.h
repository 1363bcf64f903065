#pragma once

#include "io/brdf_report/brdf_report.h"
#include "io/figures/axes.h"

namespace ifov::io {

/// The map of a report, with zenith angles, the place of the light and a scale of colours that `scale` (1/sr) spans.
void draw_polar_map(Canvas& canvas, const BrdfReport::Map& map, const Axis& scale, CanvasPoint centre,
                    double radius);

}  // namespace ifov::io
