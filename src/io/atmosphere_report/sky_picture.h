#pragma once

#include "io/atmosphere_report/atmosphere_report.h"
#include "io/figures/canvas.h"

namespace ifov::io {

enum class SkyQuantity { brightness, polarization };

/// The report's sky as one sees it lying on the back with the head to the north: the zenith in the middle,
/// the horizon around (distance from the middle goes with the zenith angle), east on the left; with a scale
/// of colours on the right. Brightness is radiance, or temperature where the report says so.
void draw_sky(Canvas& canvas, const AtmosphereReport& report, CanvasPoint centre, double radius,
              SkyQuantity quantity);

}  // namespace ifov::io
