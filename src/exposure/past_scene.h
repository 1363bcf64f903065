#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/vec3.h"

namespace ifov::geometry {
class World;
}
namespace ifov::math {
struct Ray;
}

namespace ifov::exposure {

/// What stands about a scene and what stood there before, asked by rays that have their time (seconds after the picture's, 0 or below). Keeps references to both worlds.
class PastScene {
 public:
  /// `departed`: what is there at other times than the picture's alone; null: nothing is.
  explicit PastScene(const geometry::World& world, const geometry::World* departed = nullptr);

  const geometry::World& world() const { return world_; }
  /// Whether anything came or went before the picture's time; else no ray needs a time.
  bool changes() const { return !changes_s_.empty(); }
  /// When something did, in order.
  const std::vector<double>& changes_s() const { return changes_s_; }
  /// Whether something is not as it is now at some time between these.
  bool is_otherwise_within(double low_s, double high_s) const;

  /// The lowest surface at a place that faces up, or what lies in the place of a foundation: by a ray from below that passes what faces down. Nothing where it meets none below a height.
  std::optional<double> ground_m(double x_m, double y_m, double below_m) const;
  /// How high a place is above that. 0 where that is no more than `least_m`, or nothing is there.
  double height_above_ground_m(math::Point3 place_m, double least_m) const;
  /// No place is higher.
  double highest_m() const { return high_m_ - low_m_; }

  /// 1 where anything was in a ray's way.
  void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  const geometry::World& world_;
  const geometry::World* departed_;
  std::vector<double> changes_s_;
  double low_m_, high_m_;  ///< of everything
};

}  // namespace ifov::exposure
