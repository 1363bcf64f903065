#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "math/ray.h"
#include "sampling/field.h"

namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// What lies behind panes and in media, for labels: so that edges which are seen, or throw shadows, through glass are found like
/// others. An object serves one thread.
class SeenThrough {
 public:
  explicit SeenThrough(const transport::SpectralScene& scene);

  /// Whether anything lets light pass.
  bool any() const { return any_; }
  /// Replaces rays that met a pane or boundary, and what they met, by where they go on behind it and what they meet there;
  /// `states`: by ray, the same 64 bits for what came the same way, 0 where nothing was passed.
  void follow(std::span<math::Ray> rays, std::span<geometry::SurfacePoint> hits,
              std::span<std::uint64_t> states, sampling::RayCounts& counts);
  /// Follows a ray that something blocks straight through panes: what those are that it passes, 0 where it is blocked.
  std::uint64_t passed(math::Ray ray, sampling::RayCounts& counts);

 private:
  /// Turns a ray to where it goes on; false where nothing is seen through the surface.
  bool turn(math::Ray& ray, const geometry::SurfacePoint& hit, bool only_straight) const;

  const transport::SpectralScene& scene_;
  bool any_ = false;
  std::vector<std::uint32_t> going_, next_;
  std::vector<math::Ray> rays_;
  std::vector<geometry::SurfacePoint> hits_;
};

}  // namespace ifov::render
