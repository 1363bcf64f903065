#pragma once

#include <optional>

#include "geodesy/frames.h"

namespace ifov::geodesy {

/// Where a straight line first meets the ellipsoid WGS 84; none where it passes by or leads away.
std::optional<EcefPoint> on_ellipsoid(EcefPoint from, EcefVector towards);

}  // namespace ifov::geodesy
