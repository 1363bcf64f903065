#pragma once

#include <algorithm>
#include <limits>

#include "geometry/world.h"

namespace ifov::geometry {

/// Bounds of whatever is included; low is above high where nothing is.
struct GrowingBox {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  World::Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

  void include(math::Point3 low, math::Point3 high) {
    World::Bounds& b = bounds;
    b.low_m = {std::min(b.low_m.x, low.x), std::min(b.low_m.y, low.y), std::min(b.low_m.z, low.z)};
    b.high_m = {std::max(b.high_m.x, high.x), std::max(b.high_m.y, high.y), std::max(b.high_m.z, high.z)};
  }
  void include(const World::Bounds& other) { include(other.low_m, other.high_m); }
  bool empty() const { return !(bounds.low_m.x <= bounds.high_m.x); }
};

}  // namespace ifov::geometry
