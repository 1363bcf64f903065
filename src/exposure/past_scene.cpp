#include "exposure/past_scene.h"

#include <algorithm>

#include "geometry/presence.h"
#include "geometry/world.h"

namespace ifov::exposure {
namespace {

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
