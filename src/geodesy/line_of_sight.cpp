#include "geodesy/line_of_sight.h"

#include <cmath>

namespace ifov::geodesy {
namespace {

constexpr double kEquator_m = 6378137.0, kFlattening = 1.0 / 298.257223563;  // WGS 84

}  // namespace

std::optional<EcefPoint> on_ellipsoid(EcefPoint from, EcefVector towards) {
  // The ellipsoid as a unit sphere: x, y over a, z over b.
  constexpr double kPole_m = kEquator_m * (1.0 - kFlattening);
  const math::Vec3 o{from.p.x / kEquator_m, from.p.y / kEquator_m, from.p.z / kPole_m},
      d{towards.v.x / kEquator_m, towards.v.y / kEquator_m, towards.v.z / kPole_m};
  const double a = math::dot(d, d), b = math::dot(o, d), c = math::dot(o, o) - 1.0;
  const double root = b * b - a * c;
  if (!(root >= 0.0) || !(a > 0.0)) return std::nullopt;
  // c / (-b + sqrt) is the nearer root without the difference of two that are alike.
  const double along = b < 0.0 ? c / (-b + std::sqrt(root)) : (-b - std::sqrt(root)) / a;
  if (!(along >= 0.0)) return std::nullopt;
  return from + along * towards;
}

}  // namespace ifov::geodesy
