#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "math/ray.h"
#include "sampling/field.h"

namespace ifov::geometry {
class World;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// What lies behind panes and in media, and what mirrors show, for labels: so that edges which are seen, or throw shadows, through glass or in a mirror are found like others. Flat mirrors
/// show what stands before them as a window would; of what bends only whether it shows the sky is told, because all else in so little would be clutter. Where the Sun's disc, which outshines all else, is seen that way, also by
/// more mirrors than are followed for what they show, is told as well. An object serves one thread.
class SeenThrough {
 public:
  static constexpr std::uint64_t kUnevenState = 2;
  /// Reflections by which the Sun's disc is looked for; what else mirrors show is told by fewer.
  static constexpr std::uint8_t kMostReflectionsOfSun = 6;

  explicit SeenThrough(const transport::SpectralScene& scene);

  /// Whether anything lets light pass, or reflects as a mirror.
  bool any() const { return any_; }
  bool any_mirror() const { return !mirrors_.empty(); }
  /// Replaces rays that met a pane, a boundary or a flat mirror, and what they met, by where they go on and what they meet there;
  /// `states`: by ray, the same 64 bits for what came the same way, 0 where nothing was passed; with kUnevenState where what is seen
  /// may be many things.
  void follow(std::span<math::Ray> rays, std::span<geometry::SurfacePoint> hits,
              std::span<std::uint64_t> states, sampling::RayCounts& counts);
  /// Whether a ray that nothing stops ends on the Sun's disc.
  bool meets_sun(math::Vec3 direction) const { return math::dot(direction, towards_sun_) >= cosine_of_sun_; }
  /// The ways on which a ray goes on behind panes and in mirrors, flat or bent, each until what of a world it meets; `hit`: what the ray
  /// met, then what the last of them does. Behind those that are there.
  void list_ways(math::Ray ray, const geometry::World& world, geometry::SurfacePoint& hit,
                 std::vector<math::Ray>& ways, sampling::RayCounts& counts) const;
  /// Follows a ray that something blocks straight through panes: what those are that it passes, 0 where it is blocked.
  std::uint64_t passed(math::Ray ray, sampling::RayCounts& counts);

 private:
  enum class Way : std::uint8_t { none, through, flat_mirror, bent_mirror };
  /// Turns a ray to where it goes on; none where nothing is seen through the surface, or in it.
  Way turn(math::Ray& ray, const geometry::SurfacePoint& hit, bool only_straight) const;
  /// Whether what a ray was seen to pass shows it the Sun's disc, as still water does.
  bool glints(math::Vec3 direction, const geometry::SurfacePoint& hit) const;
  /// Whether a mirror, flat or of a face of a mesh, may show the whole of the Sun's disc.
  bool shows_sun(Way way, const geometry::SurfacePoint& hit) const;
  /// Follows the rays that more mirrors reflect than are followed, to the Sun's disc alone.
  void look_for_sun(std::span<std::uint64_t> states, sampling::RayCounts& counts);

  const transport::SpectralScene& scene_;
  math::Vec3 towards_sun_{};
  double cosine_of_sun_ = 2.0;  ///< of its half-angle; above 1 where no disc is seen
  bool passages_ = false;
  std::vector<bool> mirrors_;  // by surface assignment: it may reflect as a mirror; empty: none does
  bool any_ = false;
  std::vector<std::uint32_t> going_, next_;
  std::vector<Way> ways_;
  std::vector<bool> glints_;               // by ray that goes on
  std::vector<std::uint8_t> reflections_;  // by ray
  struct Beyond {
    std::uint32_t ray;
    std::uint8_t reflections;
    math::Ray onward;
  };
  std::vector<Beyond> beyond_;
  std::vector<math::Ray> rays_;
  std::vector<geometry::SurfacePoint> hits_;
};

}  // namespace ifov::render
