#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/vec3.h"

namespace ifov::geometry {
struct SurfacePoint;
class World;
}  // namespace ifov::geometry

namespace ifov::exposure {

/// A surface point, from the side that was met, to ask what its surroundings hide. Keeps a reference to the world.
class ExposedPoint {
 public:
  ExposedPoint(const geometry::World& world, const geometry::SurfacePoint& point);

  math::Vec3 normal() const { return normal_; }  ///< shading normal, out of the side that was met

  /// 1 where nothing stands in a direction that leaves the surface, 0 where something does or it does not leave.
  void free(std::span<const math::Vec3> directions, std::span<std::uint8_t> is_free) const;

  /// Pairs of directions to the sky above the point's own horizon, as it sees it (by their cosines), by chance: each pair in a
  /// stratum of its own where the surface is level. None where hardly any sky is above it.
  void sky_directions(std::uint64_t key, int pairs, std::vector<math::Vec3>& directions) const;

 private:
  const geometry::World& world_;
  math::Point3 origin_m_;
  math::Vec3 normal_, outward_;
};

}  // namespace ifov::exposure
