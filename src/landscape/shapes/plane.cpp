#include "landscape/shapes/plane.h"

#include <algorithm>
#include <limits>

namespace ifov::landscape {
namespace {

bool separated_along(Vec2 axis, const Footprint& a, const Footprint& b) {
  double a_low = std::numeric_limits<double>::infinity(), a_high = -a_low, b_low = a_low, b_high = -a_low;
  for (int k = 0; k < 4; ++k) {
    const double pa = dot(a.corner(k), axis), pb = dot(b.corner(k), axis);
    a_low = std::min(a_low, pa), a_high = std::max(a_high, pa);
    b_low = std::min(b_low, pb), b_high = std::max(b_high, pb);
  }
  return a_high <= b_low || b_high <= a_low;
}

}  // namespace

bool overlap(const Footprint& a, const Footprint& b) {
  return !separated_along(a.stand.along(), a, b) && !separated_along(a.stand.inward, a, b) &&
         !separated_along(b.stand.along(), a, b) && !separated_along(b.stand.inward, a, b);
}

double distance(const Footprint& footprint, Vec2 point) {
  const Vec2 from_origin = point - footprint.stand.origin;
  const double x = dot(from_origin, footprint.stand.along()), y = dot(from_origin, footprint.stand.inward);
  const double dx = std::max({footprint.x0 - x, 0.0, x - footprint.x1});
  const double dy = std::max({footprint.y0 - y, 0.0, y - footprint.y1});
  return std::hypot(dx, dy);
}

}  // namespace ifov::landscape
