#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "geometry/world/surface_survey.h"
#include "transport/shapes/emitter_shape.h"

namespace ifov::scene {
class RadiationPattern;
}

namespace ifov::transport {

class EmitterTree;
class SpectralScene;
struct Emitter;
struct EmitterChoice;
struct GroupedRadiance;

/// What of a scene light is sought from by next-event estimation: the pieces of surface that EmitterChoice names. Each is
/// drawn from by EmitterTree and EmitterShape; what paths find by scattering is weighed against that by density().
/// In a world that repeats, the copies in the receiver's own cell and the eight around it are sought, others are found.
class Emitters {
 public:
  /// More pieces than this are not sought.
  static constexpr std::size_t kMost = 1 << 20;
  /// Faint things are not looked for among more triangles and objects than this, copies counted.
  static constexpr std::size_t kMostLookedThrough = 4 << 20;

  /// Null where there is nothing to seek. Keeps no reference to the scene.
  static std::unique_ptr<const Emitters> find(const SpectralScene& scene);
  ~Emitters();

  /// Whether some are so bright that what is not sought of them is told (EmitterChoice::outshines()).
  bool outshine() const { return outshone_; }
  /// 0 where all that there is is left out.
  std::size_t count() const { return names_.size(); }
  /// Whether some of what ought to be sought is not: on planes and height fields, of too many pieces, or because its material says so.
  bool leaves_some() const { return passes_over_ || declines_some_; }
  /// Whether some because its material says so.
  bool declines_some() const { return declines_some_; }
  /// Whether some for another reason.
  bool passes_over() const { return passes_over_; }

  /// What is not sought because there are too many pieces or its material says so, of one surface assignment and near each other; of a world that repeats
  /// those of the first cell and the eight around it.
  struct LeftOut {
    geometry::SurfaceSurvey::Ball ball;
    double area_m2 = 0.0;
    std::uint32_t assignment = 0;
  };
  std::span<const LeftOut> left_out() const { return left_out_; }

  /// One of them, as it lies in the receiver's cell or beside it.
  struct Piece {
    std::uint32_t emitter = 0;
    std::int32_t column = 0, row = 0;  ///< of the receiver's cell
  };
  /// A direction in which an emitter may be seen; density 0: none. Emitters share out `u.x`, so that points that are well
  /// spread over the unit square are so over all that is sought together.
  struct Aim : Piece {
    math::Vec3 direction;  ///< unit
    double density = 0.0;  ///< 1/sr, of this emitter in this direction
  };
  Aim aim(const Receiver& receiver, sampling::Point2 u) const;

  /// A point of an emitter, wherever it may be seen from; density 0: none.
  struct Point : Piece, SurfaceSample {};
  Point point(const Receiver& receiver, sampling::Point2 u) const;

  /// Whether what a ray met is what was aimed at.
  bool is(const Piece& piece, const geometry::SurfacePoint& hit) const;

  /// Of aim() for what a ray from the receiver met in a direction; 0 where that is not sought.
  double density(const Receiver& receiver, math::Vec3 direction, const geometry::SurfacePoint& hit) const;

  /// Of point() for what a ray met; 0 where that is not sought.
  double point_density(const Receiver& receiver, const geometry::SurfacePoint& hit) const;

  /// The surface assignments some of whose light is sought.
  const geometry::WantedMaterials& assignments() const { return wanted_; }

  /// Whether all that a surface assignment emits is sought.
  bool seeks_all_of(std::uint32_t assignment) const {
    return !leaves_some() && wanted_[assignment] && !in_part_[assignment];
  }

  /// About what emitters send to a receiver, in a unit of its own.
  double reach(const Receiver& receiver) const;

 private:
  struct Name {
    std::uint32_t object, primitive, patch;
    std::int32_t column, row;
    friend auto operator<=>(const Name&, const Name&) = default;
  };
  struct Home {
    Receiver receiver;  // moved to the first cell
    std::int32_t column = 0, row = 0;
  };
  Emitters();
  void take(const SpectralScene& scene, const EmitterChoice& choice);
  /// Leaves to chance what does not outshine the scene, where it has more pieces than this.
  void leave_many_faint(const geometry::World& world, const EmitterChoice& choice, std::size_t most);
  void add(const geometry::SurfacePiece& piece, bool closed, const GroupedRadiance& radiance);
  /// Puts together by place what is not sought.
  void leave_out(const geometry::World& world, const geometry::WantedMaterials& what);
  void finish();
  /// The emitter that a ray met; none where that is not sought.
  std::optional<std::uint32_t> emitter_of(const Home& home, const geometry::SurfacePoint& hit) const;
  Home at_home(const Receiver& receiver) const;

  geometry::World::Period period_;
  bool repeats_ = false, passes_over_ = false, declines_some_ = false, outshone_ = false;
  geometry::WantedMaterials wanted_, in_part_;  ///< in_part_: some of it is no piece: planes, height fields
  std::vector<const scene::RadiationPattern*> patterns_;  // of lamps, by surface assignment
  std::vector<Emitter> emitters_;
  std::size_t groups_ = 1;  // of their radiance
  std::vector<LeftOut> left_out_;
  std::vector<Name> names_;             // by emitter
  std::vector<std::uint32_t> by_name_;  // emitters, sorted by name
  std::unique_ptr<EmitterTree> tree_;
};

}  // namespace ifov::transport
