#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "geometry/world/surface_survey.h"
#include "transport/mirrors/round_mirrors.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::transport {

/// The mirrors of a scene under its Sun: flat ones by their normals, through each of which the Sun has one image, and whatever else may send sunlight somewhere that no image tells of.
class SunMirrors {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// So many normals are told apart, those of the largest areas; sunlight by way of other faces is not sought.
  static constexpr std::size_t kMostFacings = 1024;
  /// Spheres about what is not sought.
  static constexpr std::size_t kMostGroups = 16;

  SunMirrors(const scene::Scene& scene, const geometry::SurfaceSurvey& survey);

  struct Facing {
    math::Vec3 normal;
    geometry::World::Bounds bounds{};
    bool one_plane = true;  ///< light that leaves it cannot meet it again
  };
  std::span<const Facing> facings() const { return facings_; }

  /// Which facing a point of a mirror belongs to, by the normal that it reflects about; kNone for one that bends.
  std::uint32_t facing_of(const geometry::SurfacePoint& hit, math::Vec3 normal) const;

  /// On whose outer side the Sun is sought.
  const RoundMirrors& rounds() const { return rounds_; }

  /// Whether the Sun's glint on a point that the sensor sees directly is found by its shape (Glints).
  bool glints_by_shape(const geometry::SurfacePoint& hit) const {
    return by_shape_ && !bends_[hit.material] &&
           (hit.bend == geometry::Bend::round || hit.bend == geometry::Bend::smooth);
  }

  /// Whether some light comes by ways that are not sought, however many reflections are.
  bool may_hide() const {
    return refracts_ || !groups_.empty() || facings_.size() + rounds_.all().size() > 1 ||
           (facings_.size() == 1 && !facings_[0].one_plane);
  }
  /// Spheres about all mirrors of which some light is not sought at its first reflection.
  std::span<const geometry::SurfaceSurvey::Ball> groups() const { return groups_; }
  const geometry::SurfaceSurvey& survey() const { return survey_; }
  /// kMostGroups spheres about all of these, or fewer.
  static std::vector<geometry::SurfaceSurvey::Ball> grouped(std::vector<geometry::SurfaceSurvey::Ball> balls);

 private:
  const geometry::SurfaceSurvey& survey_;
  std::vector<Facing> facings_;
  bool by_shape_ = true;  // copies of a periodic scene, and faces that pass for curved ones, are not searched
  bool refracts_ = false;    // some let light into a medium
  std::vector<bool> bends_;  // by surface assignment: a relief tilts its normals
  RoundMirrors rounds_;
  std::vector<geometry::SurfaceSurvey::Ball> groups_;
};

/// Whether any ray within `slope` (a tangent) of a direction meets a box; now and then true where none does.
bool may_meet(const geometry::World::Bounds& box, math::Point3 from, math::Vec3 direction, double slope);

}  // namespace ifov::transport
