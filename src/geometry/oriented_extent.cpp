#include "geometry/oriented_extent.h"

#include <algorithm>
#include <limits>

namespace ifov::geometry {

using math::Point3;
using math::Vec3;

namespace {

void sort_sides(HalfSides& sides) {
  std::sort(sides.begin(), sides.end(), [](Vec3 a, Vec3 b) { return dot(a, a) > dot(b, b); });
}

Vec3 half_side(std::span<const Point3> points, Vec3 axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point3& p : points) {
    const double along = dot(p - Point3{}, axis);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return axis * (0.5 * (high - low));
}

}  // namespace

HalfSides oriented_extent(std::span<const Point3> points, const World::Bounds& bounds) {
  const Vec3 half = (bounds.high_m - bounds.low_m) * 0.5;
  HalfSides along_axes{Vec3{half.x, 0.0, 0.0}, Vec3{0.0, half.y, 0.0}, Vec3{0.0, 0.0, half.z}};
  sort_sides(along_axes);
  if (points.size() < 3) return along_axes;

  // The direction to the farthest point from the first one, then the farthest off that line.
  const auto farthest = [&](Point3 from, Vec3 off_line) {
    Vec3 best;
    for (const Point3& p : points) {
      Vec3 d = p - from;
      d = d - off_line * dot(d, off_line);
      if (dot(d, d) > dot(best, best)) best = d;
    }
    return best;
  };
  const Point3 end = points[0] + farthest(points[0], {});
  const Vec3 long_axis = farthest(end, {});
  if (!(length(long_axis) > 0.0)) return along_axes;
  const Vec3 first = normalized(long_axis);
  const Vec3 across = farthest(end, first);
  if (!(length(across) > 1e-12 * length(long_axis))) return along_axes;
  const Vec3 second = normalized(across), third = cross(first, second);
  HalfSides own{half_side(points, first), half_side(points, second), half_side(points, third)};
  sort_sides(own);
  return length(own[1]) < length(along_axes[1]) ? own : along_axes;
}

}  // namespace ifov::geometry
