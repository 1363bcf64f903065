#include "exposure/past_scene.h"

#include <algorithm>

#include "geometry/presence.h"
#include "geometry/surface_point.h"
#include "geometry/world.h"

namespace ifov::exposure {
namespace {

constexpr double kFacesUp = 0.1;  // cosine: a ray up along a wall may meet it, by rounding
constexpr int kMostBelow = 64;    // surfaces that face down, on the way

struct LeftRays {
  std::vector<math::Ray> rays;
  std::vector<std::uint8_t> blocked;
  std::vector<std::size_t> owner;
};

}  // namespace

PastScene::PastScene(const geometry::World& world, const geometry::World* departed)
    : world_(world), departed_(departed) {
  for (const geometry::World* const of : {&world_, departed_}) {
    if (of == nullptr) continue;
    for (const geometry::Presence& presence : of->presences())
      for (const auto& [begin_s, end_s] : presence.intervals)
        for (const double edge_s : {begin_s, end_s})
          if (edge_s <= 0.0) changes_s_.push_back(edge_s);
  }
  const geometry::World::Heights heights = world_.heights();
  low_m_ = heights.low_m;
  high_m_ = heights.high_m;
  std::sort(changes_s_.begin(), changes_s_.end());
  changes_s_.erase(std::unique(changes_s_.begin(), changes_s_.end()), changes_s_.end());
}

bool PastScene::is_otherwise_within(double low_s, double high_s) const {
  const auto any_of = [&](const geometry::World* of) {
    return of != nullptr &&
           std::any_of(of->presences().begin(), of->presences().end(),
                       [&](const geometry::Presence& one) { return one.is_otherwise_within(low_s, high_s); });
  };
  return any_of(&world_) || any_of(departed_);
}

std::optional<double> PastScene::ground_m(double x_m, double y_m, double below_m) const {
  constexpr double kBelow_m = 1.0;
  math::Ray up{.origin_m = {x_m, y_m, low_m_ - kBelow_m}, .direction = {0.0, 0.0, 1.0}};
  up.t_max_m = below_m - up.origin_m.z;
  for (int k = 0; k < kMostBelow; ++k) {
    geometry::SurfacePoint met;
    world_.intersect({&up, 1}, {&met, 1});
    if (!met.hit()) return std::nullopt;
    if (met.geometric_normal.as_vector().z > kFacesUp || met.shared_with != geometry::kNoMaterial)
      return met.position_m.z;
    up.t_min_m = met.distance_m + met.offset_m;
  }
  return std::nullopt;
}

double PastScene::height_above_ground_m(math::Point3 place_m, double least_m) const {
  if (!(place_m.z - low_m_ > least_m)) return 0.0;
  const std::optional<double> ground = ground_m(place_m.x, place_m.y, place_m.z - least_m);
  return ground ? place_m.z - *ground : 0.0;
}

void PastScene::occluded(std::span<const math::Ray> rays, std::span<std::uint8_t> blocked) const {
  world_.occluded(rays, blocked);
  if (departed_ == nullptr) return;
  static thread_local LeftRays left;
  left.rays.clear();
  left.owner.clear();
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (blocked[k] != 0 || !(rays[k].time_s < 0.0)) continue;
    left.rays.push_back(rays[k]);
    left.owner.push_back(k);
  }
  if (left.rays.empty()) return;
  left.blocked.resize(left.rays.size());
  departed_->occluded(left.rays, left.blocked);
  for (std::size_t k = 0; k < left.owner.size(); ++k) blocked[left.owner[k]] = left.blocked[k];
}

}  // namespace ifov::exposure
