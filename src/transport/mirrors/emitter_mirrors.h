#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "transport/mirrors/round_mirrors.h"
#include "transport/shapes/emitter_shape.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::transport {

/// The mirrors of a scene by way of one of which light is sought from emitters: flat ones by their planes, through each of
/// which a surface sees what shines as if it stood mirrored behind the plane, and round ones.
class EmitterMirrors {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// So many planes are told apart; where there are more, none is sought by.
  static constexpr std::size_t kMost = 64;

  /// Null where there are none that are sought, or copies of a periodic scene.
  static std::unique_ptr<const EmitterMirrors> find(const scene::Scene& scene);

  /// Whether light of emitters may come by mirrors in ways that are not sought: meshes and stretched shapes, inner sides,
  /// several in turn, planes that are not told apart.
  static bool leave_some(const scene::Scene& scene);

  std::size_t count() const { return planes_.size(); }  ///< of planes
  const RoundMirrors& rounds() const { return rounds_; }
  /// The plane of a mirror that was met; kNone for one that bends, or a relief.
  std::uint32_t plane_of(const geometry::SurfacePoint& hit, math::Vec3 reflecting_normal) const;
  /// The receiver on the other side of a plane: light that leaves it straight is light that leaves the true one by way of
  /// the mirror.
  Receiver behind(std::uint32_t plane, const Receiver& receiver) const;
  math::Vec3 mirrored(std::uint32_t plane, math::Vec3 direction) const;

 private:
  struct Plane {
    math::Vec3 normal;
    double offset_m;  // normal . p
  };
  EmitterMirrors(const scene::Scene& scene, const geometry::SurfaceSurvey& survey);

  std::vector<Plane> planes_;
  bool all_planes_ = true;
  RoundMirrors rounds_;
  std::vector<bool> bends_;  // by surface assignment
};

}  // namespace ifov::transport
