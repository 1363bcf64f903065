#include "geometry/motion/moving_world.h"

#include <algorithm>
#include <cmath>

#include "geometry/motion/motion.h"
#include "geometry/world/surface_survey.h"

namespace ifov::geometry {

/// The rays of a batch that come near a mover, in its own frame.
class MovingWorld::Turned {
 public:
  explicit Turned(const Moving& of) : of_(of) {}

  /// Up to `last_m` along it.
  void add(const math::Ray& ray, std::uint32_t owner, double last_m) {
    math::Ray own = ray;
    own.t_max_m = std::min(ray.t_max_m, last_m);
    if (of_.swept->covers(ray.time_s) && !of_.swept->may_meet(own, ray.time_s, ray.time_s)) return;
    if (!known_ || ray.time_s != time_s_) {
      known_ = true, time_s_ = ray.time_s;
      scene_from_carrier_ = of_.motion->scene_from_carrier(time_s_);
      carrier_from_scene_ = scene_from_carrier_.inverse();
    }
    own.origin_m = carrier_from_scene_(ray.origin_m);
    own.direction = carrier_from_scene_(ray.direction);
    if (!SweptBoxes::meets(own, of_.box)) return;
    rays.push_back(own);
    owners.push_back(owner);
    frames.push_back(scene_from_carrier_);
  }

  std::vector<math::Ray> rays;
  std::vector<std::uint32_t> owners;
  std::vector<math::Transform> frames;

 private:
  const Moving& of_;
  bool known_ = false;
  double time_s_ = 0.0;
  math::Transform scene_from_carrier_, carrier_from_scene_;
};

MovingWorld::MovingWorld(std::unique_ptr<World> still, std::vector<Mover> movers, double from_s, double to_s)
    : still_(std::move(still)), from_s_(from_s), to_s_(to_s), heights_(still_->heights()) {
  std::uint32_t moved_before = 0;
  const bool empty = still_->object_count() == 0;
  bool bounded = false;
  for (std::size_t k = 0; !bounded && k < still_->object_count(); ++k)
    bounded = std::isfinite(still_->object(k).radius_m);
  if (bounded) bounds_ = still_->bounds();
  bool first = empty;
  for (Mover& mover : movers) {
    Moving made;
    made.body = std::move(mover.body), made.motion = std::move(mover.motion), made.after = mover.after;
    made.first = mover.after + moved_before;
    made.count = static_cast<std::uint32_t>(made.body->object_count());
    moved_before += made.count;
    made.box = made.body->bounds();
    made.swept = std::make_unique<const SweptBoxes>(*made.motion, made.box, from_s, to_s);
    const Bounds hull = made.swept->reach();
    if (bounded) {
      bounds_.low_m = {std::min(bounds_.low_m.x, hull.low_m.x), std::min(bounds_.low_m.y, hull.low_m.y),
                       std::min(bounds_.low_m.z, hull.low_m.z)};
      bounds_.high_m = {std::max(bounds_.high_m.x, hull.high_m.x), std::max(bounds_.high_m.y, hull.high_m.y),
                        std::max(bounds_.high_m.z, hull.high_m.z)};
    } else {
      bounds_ = hull, bounded = true;
    }
    heights_ =
        first ? Heights{hull.low_m.z, hull.high_m.z}
              : Heights{std::min(heights_.low_m, hull.low_m.z), std::max(heights_.high_m, hull.high_m.z)};
    first = false;
    movers_.push_back(std::move(made));
  }
  std::vector<Bounds> hulls;
  for (const Moving& mover : movers_) hulls.push_back(mover.swept->hull());
  tree_ = std::make_unique<const BoxTree>(hulls);
  survey_ = numbered(still_->survey());
  lobe_survey_ = numbered(still_->lobe_survey());
}

std::unique_ptr<const SurfaceSurvey> MovingWorld::numbered(const SurfaceSurvey* of_still) const {
  if (of_still == nullptr) return nullptr;
  auto numbered = std::make_unique<SurfaceSurvey>(*of_still);
  for (SurfaceSurvey::Round& round : numbered->rounds) round.object = number_of_still(round.object);
  for (SurfaceSurvey::Smooth& smooth : numbered->smooths) smooth.object = number_of_still(smooth.object);
  return numbered;
}

template <class At>
void MovingWorld::visit_near(const math::Ray& ray, double spread_rad, const At& at) const {
  if (ray.time_s >= from_s_ && ray.time_s <= to_s_) return tree_->visit(ray, spread_rad, at);
  for (std::uint32_t m = 0; m < movers_.size(); ++m) at(m);
}

MovingWorld::~MovingWorld() = default;

std::uint32_t MovingWorld::number_of_still(std::uint32_t own) const {
  std::uint32_t number = own;
  for (const Moving& mover : movers_) {
    if (mover.after > own) break;
    number += mover.count;
  }
  return number;
}

MovingWorld::Place MovingWorld::place_of(std::uint32_t object) const {
  std::uint32_t own = object;
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const Moving& mover = movers_[m];
    if (object < mover.first) break;
    if (object < mover.first + mover.count) return {m, object - mover.first};
    own -= mover.count;
  }
  return {kStill, own};
}

void MovingWorld::intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const {
  intersect(rays, hits, &World::intersect);
}

void MovingWorld::intersect_uncut(std::span<const math::Ray> rays, std::span<SurfacePoint> hits) const {
  intersect(rays, hits, &World::intersect_uncut);
}

void MovingWorld::intersect(std::span<const math::Ray> rays, std::span<SurfacePoint> hits, Meet meet) const {
  // Of two surfaces in one place, but for rounding.
  constexpr double kOne = 4e-12;
  ((*still_).*meet)(rays, hits);
  for (SurfacePoint& hit : hits) {
    if (!hit.hit()) continue;
    hit.instance = number_of_still(hit.instance);
    if (hit.shared_with != kNoMaterial) hit.shared_with = number_of_still(hit.shared_with);
  }
  std::vector<SurfacePoint> found;
  const auto rounding_m = [&](const math::Ray& ray, double distance_m) {
    return kOne * (1.0 + distance_m + math::length(ray.origin_m - math::Point3{}));
  };
  std::vector<std::vector<std::uint32_t>> near(movers_.size());
  for (std::uint32_t k = 0; k < rays.size(); ++k) {
    math::Ray seen = rays[k];
    if (hits[k].hit())
      seen.t_max_m = std::min(seen.t_max_m, hits[k].distance_m + rounding_m(rays[k], hits[k].distance_m));
    visit_near(seen, 0.0, [&](std::uint32_t m) { near[m].push_back(k); });
  }
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    if (near[m].empty()) continue;
    const Moving& mover = movers_[m];
    Turned turned(mover);
    for (const std::uint32_t k : near[m]) {
      const double seen_m = hits[k].hit() ? hits[k].distance_m : rays[k].t_max_m;
      turned.add(rays[k], k, hits[k].hit() ? seen_m + rounding_m(rays[k], seen_m) : seen_m);
    }
    if (turned.rays.empty()) continue;
    found.resize(turned.rays.size());
    ((*mover.body).*meet)(turned.rays, found);
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (!found[j].hit()) continue;
      const std::uint32_t k = turned.owners[j];
      const SurfacePoint behind = hits[k];
      SurfacePoint& hit = hits[k];
      hit = found[j];
      const math::Transform& scene_from_carrier = turned.frames[j];
      hit.position_m = scene_from_carrier(hit.position_m);
      hit.geometric_normal = scene_from_carrier(hit.geometric_normal);
      hit.shading_normal = scene_from_carrier(hit.shading_normal);
      hit.instance += mover.first;
      if (hit.shared_with != kNoMaterial) hit.shared_with += mover.first;
      if (behind.hit() && std::abs(behind.distance_m - hit.distance_m) <= rounding_m(rays[k], hit.distance_m))
        hit.shared_with = behind.instance;
    }
  }
}

void MovingWorld::occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const {
  still_->occluded(rays, blocked);
  std::vector<std::uint8_t> found;
  std::vector<std::vector<std::uint32_t>> near(movers_.size());
  for (std::uint32_t k = 0; k < rays.size(); ++k)
    if (blocked[k] == 0) visit_near(rays[k], 0.0, [&](std::uint32_t m) { near[m].push_back(k); });
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    if (near[m].empty()) continue;
    const Moving& mover = movers_[m];
    Turned turned(mover);
    for (const std::uint32_t k : near[m])
      if (blocked[k] == 0) turned.add(rays[k], k, rays[k].t_max_m);
    if (turned.rays.empty()) continue;
    found.resize(turned.rays.size());
    mover.body->occluded(turned.rays, found);
    for (std::size_t j = 0; j < found.size(); ++j) blocked[turned.owners[j]] |= found[j];
  }
}

bool MovingWorld::may_move_into(const math::Ray& ray, double from_s, double to_s, double spread_rad) const {
  bool any = false;
  tree_->visit(ray, spread_rad, [&](std::uint32_t m) {
    any = any || movers_[m].swept->may_meet(ray, from_s, to_s, spread_rad);
  });
  return any;
}

void MovingWorld::when_met(const math::Ray& ray, double from_s, double to_s, double spread_rad,
                           std::vector<TimeInterval>& times) const {
  tree_->visit(ray, spread_rad,
               [&](std::uint32_t m) { movers_[m].swept->when(ray, from_s, to_s, spread_rad, times); });
}

World::PlacedObject MovingWorld::object_at(std::size_t mover, std::uint32_t own, double time_s) const {
  PlacedObject object = movers_[mover].body->object(own);
  const math::Transform scene_from_carrier = movers_[mover].motion->scene_from_carrier(time_s);
  object.centre_m = scene_from_carrier(object.centre_m);
  object.pilot_point_m = scene_from_carrier(object.pilot_point_m);
  for (math::Vec3& side : object.half_sides_m) side = scene_from_carrier(side);
  return object;
}

std::size_t MovingWorld::object_count() const {
  std::size_t count = still_->object_count();
  for (const Moving& mover : movers_) count += mover.count;
  return count;
}

World::PlacedObject MovingWorld::object(std::size_t number) const {
  const Place place = place_of(static_cast<std::uint32_t>(number));
  if (place.mover == kStill) return still_->object(place.own);
  PlacedObject object = object_at(place.mover, place.own, std::clamp(0.0, from_s_, to_s_));
  // What is sent at it has to know when (object_at).
  object.compact = false;
  return object;
}

bool MovingWorld::has_corners(std::size_t number) const {
  const Place place = place_of(static_cast<std::uint32_t>(number));
  return (place.mover == kStill ? *still_ : *movers_[place.mover].body).has_corners(place.own);
}

World::Storage MovingWorld::storage() const {
  Storage all = still_->storage();
  for (const Moving& mover : movers_) {
    const Storage own = mover.body->storage();
    all.stored_triangles += own.stored_triangles;
    all.instances += own.instances;
    all.prototypes_apart += own.prototypes_apart;
    all.chunks += own.chunks;
    all.chunks_made += own.chunks_made;
    all.chunk_bytes += own.chunk_bytes;
    all.bytes += own.bytes;
  }
  return all;
}

void MovingWorld::visit_surfaces(const WantedMaterials& wanted, const PieceVisitor& visitor) const {
  still_->visit_surfaces(wanted, [&](const SurfacePiece& piece) {
    SurfacePiece numbered = piece;
    numbered.object = number_of_still(piece.object);
    visitor(numbered);
  });
}

std::vector<double> MovingWorld::surface_areas_m2(std::size_t materials) const {
  std::vector<double> areas = still_->surface_areas_m2(materials);
  for (const Moving& mover : movers_) {
    const std::vector<double> own = mover.body->surface_areas_m2(materials);
    for (std::size_t m = 0; m < areas.size(); ++m) areas[m] += own[m];
  }
  return areas;
}

const Presence* MovingWorld::presence(std::uint32_t object) const {
  const Place place = place_of(object);
  return place.mover == kStill ? still_->presence(place.own) : nullptr;
}

std::size_t MovingWorld::triangle_count() const {
  std::size_t count = still_->triangle_count();
  for (const Moving& mover : movers_) count += mover.body->triangle_count();
  return count;
}

}  // namespace ifov::geometry
