#pragma once

#include "geodesy/frames.h"

namespace ifov::geodesy {

/// A place on the WGS 84 ellipsoid: geodetic latitude, longitude east positive, height along the normal.
struct Geodetic {
  double latitude_rad = 0.0, longitude_rad = 0.0;
  double height_m = 0.0;  ///< above the ellipsoid
};

/// InputError for latitudes beyond the poles, and for heights near the Earth's centre.
EcefPoint ecef_from_geodetic(const Geodetic& place);

/// Longitude in (-pi, pi]; Fukushima 2006 as ERFA has it: within 5 um up to 800 km, 1 mm at 36,000 km. InputError where
/// coordinates are not finite.
Geodetic geodetic_from_ecef(EcefPoint point);

/// The local frame about a place. Throws as ecef_from_geodetic.
FrameTransform<Ecef, Enu> ecef_from_enu(const Geodetic& origin);

}  // namespace ifov::geodesy
