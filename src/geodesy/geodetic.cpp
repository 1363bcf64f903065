#include "geodesy/geodetic.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::geodesy {

EcefPoint ecef_from_geodetic(const Geodetic& place) {
  if (!(std::abs(place.latitude_rad) <= 0.5 * std::numbers::pi))
    throw InputError(format("a latitude of {:g} degrees is beyond the poles",
                            place.latitude_rad * 180.0 / std::numbers::pi));
  double m[3];
  if (eraGd2gc(ERFA_WGS84, place.longitude_rad, place.latitude_rad, place.height_m, m) != 0)
    throw InputError(format("a height of {:g} m is no place on Earth", place.height_m));
  return {{m[0], m[1], m[2]}};
}

Geodetic geodetic_from_ecef(EcefPoint point) {
  if (!std::isfinite(point.p.x + point.p.y + point.p.z))
    throw InputError("a position about the Earth is not finite");
  double m[3] = {point.p.x, point.p.y, point.p.z};
  Geodetic place;
  eraGc2gd(ERFA_WGS84, m, &place.longitude_rad, &place.latitude_rad, &place.height_m);
  return place;
}

FrameTransform<Ecef, Enu> ecef_from_enu(const Geodetic& origin) {
  const double sin_lat = std::sin(origin.latitude_rad), cos_lat = std::cos(origin.latitude_rad);
  const double sin_lon = std::sin(origin.longitude_rad), cos_lon = std::cos(origin.longitude_rad);
  return {{{-sin_lon, cos_lon, 0.0}},
          {{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat}},
          {{cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}},
          ecef_from_geodetic(origin)};
}

}  // namespace ifov::geodesy
