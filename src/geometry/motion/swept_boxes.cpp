#include "geometry/motion/swept_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/motion/box_tree.h"
#include "geometry/motion/motion.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Vec3;

std::array<Point3, 8> corners_of(const World::Bounds& box) {
  std::array<Point3, 8> corners;
  for (unsigned k = 0; k < 8; ++k)
    corners[k] = {(k & 1) != 0 ? box.high_m.x : box.low_m.x, (k & 2) != 0 ? box.high_m.y : box.low_m.y,
                  (k & 4) != 0 ? box.high_m.z : box.low_m.z};
  return corners;
}

void include(World::Bounds& bounds, Point3 p) {
  bounds.low_m = {std::min(bounds.low_m.x, p.x), std::min(bounds.low_m.y, p.y),
                  std::min(bounds.low_m.z, p.z)};
  bounds.high_m = {std::max(bounds.high_m.x, p.x), std::max(bounds.high_m.y, p.y),
                   std::max(bounds.high_m.z, p.z)};
}

World::Bounds none() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

}  // namespace

SweptBoxes::SweptBoxes(const Motion& motion, World::Bounds box, double from_s, double to_s)
    : from_s_(from_s), to_s_(to_s), hull_(none()), reach_(none()) {
  const std::array<Point3, 8> corners = corners_of(box);
  const auto moved = [&](double time_s) {
    const math::Transform scene_from_carrier = motion.scene_from_carrier(time_s);
    std::array<Point3, 8> at = corners;
    for (Point3& p : at) p = scene_from_carrier(p);
    return at;
  };
  // As many steps as there are twenty-fifths of the box in its way, and several for each turn.
  constexpr double kShare = 0.04, kMostSteps = 8192.0, kStepsOfTurn = 8.0;
  constexpr int kLooks = 256;
  const double size_m = std::max(math::length(box.high_m - box.low_m), 1e-6);
  double way_m = 0.0;
  if (to_s > from_s) {
    auto before = moved(from_s);
    for (int k = 1; k <= kLooks; ++k) {
      const auto now = moved(from_s + (to_s - from_s) * k / kLooks);
      double furthest_m = 0.0;
      for (std::size_t c = 0; c < now.size(); ++c)
        furthest_m = std::max(furthest_m, math::length(now[c] - before[c]));
      way_m += furthest_m;
      before = now;
    }
  }
  const double turns =
      std::isfinite(motion.step_s()) ? kStepsOfTurn * (to_s - from_s) / motion.step_s() : 0.0;
  const auto count = static_cast<std::size_t>(
      std::clamp(std::ceil(std::max(way_m / (kShare * size_m), turns)), 1.0, kMostSteps));
  for (std::size_t k = 0; k < count; ++k) {
    constexpr int kWithin = 4;
    constexpr double kSlack = 1.1;  // of what lies between the instants that are looked at
    const double span_s = (to_s - from_s) / static_cast<double>(count);
    const double begin_s = from_s + span_s * static_cast<double>(k);
    Step step;
    step.box_from_scene = motion.scene_from_carrier(begin_s + 0.5 * span_s).inverse();
    World::Bounds held = box;
    for (int j = 0; j <= kWithin; ++j)
      for (const Point3& p : moved(begin_s + span_s * j / kWithin)) {
        include(held, step.box_from_scene(p));
        include(reach_, p);
      }
    const double rounding_m = 1e-7 * (size_m + math::length(step.box_from_scene.origin_m() - Point3{}));
    const Vec3 margin{rounding_m, rounding_m, rounding_m};
    step.box.low_m = box.low_m + kSlack * (held.low_m - box.low_m) - margin;
    step.box.high_m = box.high_m + kSlack * (held.high_m - box.high_m) + margin;
    if (k % kBlock == 0) blocks_.push_back(none());
    const math::Transform scene_from_box = step.box_from_scene.inverse();
    for (const Point3& p : corners_of(step.box)) {
      include(blocks_.back(), scene_from_box(p));
      include(hull_, scene_from_box(p));
    }
    steps_.push_back(step);
  }
}

std::size_t SweptBoxes::step_at(double time_s) const {
  if (!(to_s_ > from_s_)) return 0;
  const double at = (time_s - from_s_) / (to_s_ - from_s_) * static_cast<double>(steps_.size());
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(steps_.size()) - 1.0));
}

template <class Found>
void SweptBoxes::find(const math::Ray& ray, double from_s, double to_s, double spread_rad,
                      const Found& found) const {
  if (!comes_near(ray, hull_, cone_reach_m(ray, hull_, spread_rad))) return;
  // A time on the border of two steps belongs to both.
  const double rounding_s = 1e-9 * (to_s_ - from_s_);
  const std::size_t first = step_at(from_s - rounding_s), last = step_at(to_s + rounding_s);
  for (std::size_t k = first; k <= last;) {
    const World::Bounds& block = blocks_[k / kBlock];
    const std::size_t end = std::min(last + 1, (k / kBlock + 1) * kBlock);
    if (!comes_near(ray, block, cone_reach_m(ray, block, spread_rad))) {
      k = end;
      continue;
    }
    for (; k < end; ++k) {
      const Step& step = steps_[k];
      math::Ray turned = ray;
      turned.origin_m = step.box_from_scene(ray.origin_m);
      turned.direction = step.box_from_scene(ray.direction);
      if (comes_near(turned, step.box, cone_reach_m(turned, step.box, spread_rad)) && !found(k)) return;
    }
  }
}

bool SweptBoxes::may_meet(const math::Ray& ray, double from_s, double to_s, double spread_rad) const {
  bool met = false;
  find(ray, from_s, to_s, spread_rad, [&](std::size_t) {
    met = true;
    return false;
  });
  return met;
}

void SweptBoxes::when(const math::Ray& ray, double from_s, double to_s, double spread_rad,
                      std::vector<TimeInterval>& times) const {
  const double span_s = (to_s_ - from_s_) / static_cast<double>(steps_.size());
  std::size_t next = steps_.size();  // of the last interval
  find(ray, from_s, to_s, spread_rad, [&](std::size_t k) {
    const double end_s = from_s_ + span_s * static_cast<double>(k + 1);
    if (k == next)
      times.back().to_s = end_s;
    else
      times.push_back({from_s_ + span_s * static_cast<double>(k), end_s});
    next = k + 1;
    return true;
  });
}

bool SweptBoxes::meets(const math::Ray& in_carrier, const World::Bounds& box) {
  return comes_near(in_carrier, box, 1e-9 * (1.0 + math::length(in_carrier.origin_m - Point3{})));
}

}  // namespace ifov::geometry
