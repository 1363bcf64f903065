#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/ray.h"
#include "math/vec3.h"
#include "thermal/surface_classes.h"

namespace ifov::geometry {
struct Presence;
struct SurfacePoint;
}  // namespace ifov::geometry

namespace ifov::exposure {

class PastScene;

/// A surface point, from the side that was met, to ask what its surroundings hide; of a sheet of two faces both, each towards its own side. Keeps
/// a reference to the scene.
class ExposedPoint {
 public:
  ExposedPoint(const PastScene& scene, const geometry::SurfacePoint& point, bool two_faces = false);

  math::Point3 position_m() const { return origin_m_; }
  /// Shading normal, out of the side that was met; of two faces that which looks up.
  math::Vec3 normal() const { return normal_; }
  /// That, and how high above ground the point is, which may take a ray.
  thermal::Pose pose() const;

  /// Whether a direction does; and its ray.
  bool leaves(math::Vec3 direction) const;
  math::Ray ray(math::Vec3 direction) const;
  /// 1 where nothing stands in a direction that leaves the surface, 0 where something does or it does not leave. `times_s`: when,
  /// after the picture's time; empty: now. A point of what was elsewhere then is told how it was at the nearest time at which
  /// that was there.
  void free(std::span<const math::Vec3> directions, std::span<const double> times_s,
            std::span<std::uint8_t> is_free) const;
  /// The time of that.
  double time_here_s(double time_s) const;

  /// Pairs of directions to the sky above the point's own horizon, as it sees it (by their cosines), by chance: each pair in a
  /// stratum of its own. None where no sky is above it. Of two faces each direction is one's, as often as that sees of the sky.
  void sky_directions(std::uint64_t key, int pairs, std::vector<math::Vec3>& directions) const;
  /// The same to below the horizon.
  void ground_directions(std::uint64_t key, int pairs, std::vector<math::Vec3>& directions) const;

 private:
  void directions(std::uint64_t key, int pairs, bool up, std::vector<math::Vec3>& found) const;

  void of_both_faces(std::uint64_t key, int pairs, bool up, std::vector<math::Vec3>& directions) const;

  const PastScene& scene_;
  const geometry::Presence* presence_ = nullptr;  ///< of the point's object; null: it was always there
  math::Point3 origin_m_, behind_m_;
  math::Vec3 normal_, outward_;
  bool two_faces_;
};

}  // namespace ifov::exposure
