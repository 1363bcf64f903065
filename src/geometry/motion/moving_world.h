#pragma once

#include <memory>
#include <vector>

#include "geometry/motion/box_tree.h"
#include "geometry/motion/swept_boxes.h"
#include "geometry/world.h"

namespace ifov::geometry {

class Motion;

/// A world some objects of which move along paths, rigidly: a ray meets each where it is at the ray's time. Every mover is a world of its
/// own in the frame of what carries it, into which rays are turned in double; so nothing is approximated between instants, and hits are
/// as exact as those of what stands still. Where surfaces of both lie in one place, what moves is met.
class MovingWorld final : public World {
 public:
  struct Mover {
    std::unique_ptr<World> body;  ///< in the carrier's frame; bounded
    std::shared_ptr<const Motion> motion;
    std::uint32_t after = 0;  ///< so many of the still world's objects are numbered before its own
  };

  /// Movers in the order of `after`. The time that is told of as a whole (may_move_into, bounds) is that from `from_s` to `to_s`; rays of other
  /// times are answered all the same.
  MovingWorld(std::unique_ptr<World> still, std::vector<Mover> movers, double from_s, double to_s);
  ~MovingWorld() override;

  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  void intersect_uncut(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const override;
  void occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const override;

  const MovingWorld* moving() const override { return this; }
  double from_s() const { return from_s_; }
  double to_s() const { return to_s_; }
  /// Whether anything that moves may lie on a ray, between its ends, at some time of these, or within `spread_rad` about it; never no where
  /// it does.
  bool may_move_into(const math::Ray& ray, double from_s, double to_s, double spread_rad) const;

  /// The times of these at which it may, behind those that are there: in no order, and they may overlap.
  void when_met(const math::Ray& ray, double from_s, double to_s, double spread_rad,
                std::vector<TimeInterval>& times) const;

  const World& still() const { return *still_; }  ///< with numbers of its own
  std::size_t mover_count() const { return movers_.size(); }
  /// The first of a mover's objects, and how many it has.
  std::uint32_t first_object(std::size_t mover) const { return movers_[mover].first; }
  std::uint32_t objects_of(std::size_t mover) const { return movers_[mover].count; }
  /// One of them at an instant.
  PlacedObject object_at(std::size_t mover, std::uint32_t own, double time_s) const;
  const Motion& motion(std::size_t mover) const { return *movers_[mover].motion; }
  const World& body(std::size_t mover) const { return *movers_[mover].body; }  ///< in the carrier's frame
  /// In the carrier's frame.
  const Bounds& box(std::size_t mover) const { return movers_[mover].box; }
  bool is_moving(std::uint32_t object) const { return place_of(object).mover != kStill; }

  Bounds bounds() const override { return bounds_; }
  Heights heights() const override { return heights_; }
  std::size_t object_count() const override;
  /// Of what moves at the document's instant, or the time nearest to it.
  PlacedObject object(std::size_t number) const override;
  bool has_corners(std::size_t number) const override;
  Storage storage() const override;
  /// Of what stands still: light is sought from places that do not change.
  void visit_surfaces(const WantedMaterials& wanted, const PieceVisitor& visitor) const override;
  std::vector<double> surface_areas_m2(std::size_t materials) const override;
  std::span<const Presence> presences() const override { return still_->presences(); }
  const Presence* presence(std::uint32_t object) const override;
  std::size_t triangle_count() const override;
  /// Of what stands still: by its objects' numbers here.
  const SurfaceSurvey* survey() const override { return survey_.get(); }
  const SurfaceSurvey* lobe_survey() const override { return lobe_survey_.get(); }

 private:
  struct Moving {
    std::unique_ptr<World> body;
    std::shared_ptr<const Motion> motion;
    std::uint32_t after = 0, first = 0, count = 0;
    Bounds box;
    std::unique_ptr<const SweptBoxes> swept;
  };
  static constexpr std::size_t kStill = ~std::size_t{0};
  struct Place {
    std::size_t mover = kStill;
    std::uint32_t own = 0;
  };
  class Turned;
  using Meet = void (World::*)(std::span<const math::Ray>, std::span<SurfacePoint>) const;
  void intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits, Meet meet) const;
  /// Calls at(mover) for those that may be met.
  template <class At>
  void visit_near(const math::Ray& ray, double spread_rad, const At& at) const;
  std::uint32_t number_of_still(std::uint32_t own) const;
  std::unique_ptr<const SurfaceSurvey> numbered(const SurfaceSurvey* of_still) const;
  Place place_of(std::uint32_t object) const;

  std::unique_ptr<World> still_;
  std::vector<Moving> movers_;
  std::unique_ptr<const SurfaceSurvey> survey_, lobe_survey_;  // null where the still world has none
  std::unique_ptr<const BoxTree> tree_;                        // of where each may be from from_s_ to to_s_
  double from_s_, to_s_;
  Bounds bounds_;
  Heights heights_;
};

}  // namespace ifov::geometry
