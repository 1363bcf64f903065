#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "math/vec3.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::transport {

class ShiningParts;

/// Images of what shines in mirrors that the sensor sees directly, and that are added to it separately: whoever meets such a
/// thing by way of such a mirror goes on as if it were not there. Mirrors are told apart by object where they bend and by
/// plane where they are flat.
class SeparateImages {
 public:
  using Mirror = std::uint64_t;
  static constexpr Mirror kNone = ~Mirror{0};
  /// So many planes of flat mirrors are told apart, and so many normals from smooth triangles that bend.
  static constexpr std::size_t kMostPlanes = 64, kMostNormals = 1024;

  struct Plane {
    math::Vec3 normal;
    double offset_m = 0.0;  ///< normal . p
  };

  SeparateImages(const scene::Scene& scene, const ShiningParts& parts);

  std::span<const Plane> planes() const { return planes_; }
  /// Whether any mirror is told from others: not so in a world that repeats.
  bool any() const { return any_; }
  static constexpr Mirror curved(std::uint32_t object) { return object; }
  static constexpr Mirror flat(std::size_t plane) { return (Mirror{1} << 32) | plane; }
  /// The mirror that a point belongs to, by the normal that it reflects about; kNone where it has a relief, is a height
  /// field, or one too many.
  Mirror mirror_of(const geometry::SurfacePoint& hit, math::Vec3 normal) const;

  void add(Mirror mirror, std::uint32_t object) { pairs_.push_back({mirror, object}); }
  /// Before the first question.
  void finish();
  bool empty() const { return pairs_.empty(); }

  /// Whether the image of what was met is added separately where it is seen in a mirror.
  bool holds(Mirror mirror, const geometry::SurfacePoint& met) const;

 private:
  struct Pair {
    Mirror mirror;
    std::uint32_t object;
    friend auto operator<=>(const Pair&, const Pair&) = default;
  };
  const ShiningParts& parts_;
  bool any_ = false, smooth_ = false;
  std::vector<bool> bends_;  // by surface assignment: a relief tilts its normals
  std::vector<Plane> planes_;
  std::vector<math::Vec3> normals_;  // of all flat mirrors, at most kMostNormals
  std::vector<Pair> pairs_;          // sorted
};

}  // namespace ifov::transport
