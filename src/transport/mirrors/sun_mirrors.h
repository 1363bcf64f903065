#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/world.h"
#include "geometry/world/surface_survey.h"
#include "scene/scene.h"
#include "transport/mirrors/round_mirrors.h"

namespace ifov::transport {

/// The mirrors of a scene under its Sun: flat ones by their normals, through each of which the Sun has one image, and
/// whatever else may send sunlight somewhere that no image tells of.
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
    return !groups_.empty() || facings_.size() + rounds_.all().size() > 1 ||
           (facings_.size() == 1 && !facings_[0].one_plane);
  }
  /// Spheres about all mirrors of which some light is not sought at its first reflection.
  std::span<const geometry::SurfaceSurvey::Ball> groups() const { return groups_; }
  const geometry::SurfaceSurvey& survey() const { return survey_; }

 private:
  const geometry::SurfaceSurvey& survey_;
  std::vector<Facing> facings_;
  bool by_shape_ = true;  // copies of a periodic scene, and faces that pass for curved ones, are not searched
  std::vector<bool> bends_;  // by surface assignment: a relief tilts its normals
  RoundMirrors rounds_;
  std::vector<geometry::SurfaceSurvey::Ball> groups_;
};

/// Directions in which a surface sees the Sun by way of flat mirrors: s reflected about the normals of up to a number
/// of facings in turn. Sequences with the same image are one image, so that every way counts once; walls that stand
/// square to each other have three, however many reflections.
class SunImages {
 public:
  /// Up to so many are kept; fewer reflections are sought where there would be more.
  static constexpr std::size_t kMost = 1024;
  /// The same from the third reflection on: what they bring is not worth the noise of choosing among many.
  static constexpr std::size_t kMostOfLongWays = 24;
  /// Of a way, at most.
  static constexpr int kMostReflections = 8;

  SunImages() = default;
  SunImages(const SunMirrors& mirrors, math::Vec3 towards_sun, int reflections);

  struct Image {
    math::Vec3 direction;              ///< unit, from the surface
    geometry::World::Bounds bounds{};  ///< of the mirrors that are met first
  };
  std::span<const Image> images() const { return images_; }
  /// How many reflections are sought; 0: none.
  int reflections() const { return reflections_; }
  /// The image that mirrors of these facings, met in this order, make; kNone where they cannot.
  std::uint32_t image_of(std::span<const std::uint16_t> facings) const;

 private:
  std::uint32_t find(math::Vec3 direction) const;
  std::uint32_t index_of(math::Vec3 direction, const geometry::World::Bounds& first);
  math::Vec3 towards_sun_{};
  std::vector<math::Vec3> normals_;  // by facing
  int reflections_ = 0;
  std::vector<Image> images_;
};

/// Whether any ray within `slope` (a tangent) of a direction meets a box; now and then true where none does.
bool may_meet(const geometry::World::Bounds& box, math::Point3 from, math::Vec3 direction, double slope);

}  // namespace ifov::transport
