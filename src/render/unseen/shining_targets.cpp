#include "render/unseen/shining_targets.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "scene/scene.h"

namespace ifov::render {

using math::Point3;
using math::Vec3;

Point3 at_home(const scene::Scene& scene, Point3 at) {
  const auto period = scene.world->period();
  if (!period) return at;
  return at - Vec3{std::floor(at.x / period->x_m) * period->x_m, std::floor(at.y / period->y_m) * period->y_m,
                   0.0};
}

std::vector<Vec3> copies_about(const scene::Scene& scene) {
  const auto period = scene.world->period();
  if (!period) return {Vec3{}};
  std::vector<Vec3> copies;
  for (int column = -1; column <= 1; ++column)
    for (int row = -1; row <= 1; ++row) copies.push_back({column * period->x_m, row * period->y_m, 0.0});
  return copies;
}

std::vector<ShiningTarget> still_targets(const scene::Scene& scene, const transport::ShiningParts& parts) {
  std::vector<ShiningTarget> targets;
  for (const Vec3 moved : copies_about(scene))
    for (const transport::ShiningParts::Part& part : parts.parts())
      targets.push_back({part, at_home(scene, part.ball.centre_m) + moved, nullptr});
  return targets;
}

namespace {

double disc_m2(const ShiningTarget& target) {
  return target.part.fill * target.part.ball.radius_m * target.part.ball.radius_m;
}

ShiningTarget whole_of(std::span<const ShiningTarget> targets) {
  ShiningTarget whole = *std::max_element(
      targets.begin(), targets.end(),
      [](const ShiningTarget& a, const ShiningTarget& b) { return a.part.contrast < b.part.contrast; });
  double all = 0.0;
  Vec3 sum{};
  for (const ShiningTarget& target : targets) {
    all += disc_m2(target);
    sum = sum + disc_m2(target) * (target.centre_m - Point3{});
  }
  whole.centre_m = Point3{} + (1.0 / all) * sum;
  whole.part.ball = {whole.centre_m, 0.0};
  for (const ShiningTarget& target : targets)
    whole.part.ball.radius_m = std::max(whole.part.ball.radius_m,
                                        length(target.centre_m - whole.centre_m) + target.part.ball.radius_m);
  whole.part.fill = std::min(1.0, all / (whole.part.ball.radius_m * whole.part.ball.radius_m));
  return whole;
}

void halve(std::span<ShiningTarget> targets, std::size_t most, std::vector<ShiningTarget>& to) {
  if (most <= 1 || targets.size() <= 1) {
    to.push_back(targets.size() == 1 ? targets.front() : whole_of(targets));
    return;
  }
  Point3 low = targets.front().centre_m, high = low;
  for (const ShiningTarget& target : targets) {
    const Point3 at = target.centre_m;
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  const Vec3 across = high - low;
  const auto along = [&](const ShiningTarget& target) {
    return across.x >= std::max(across.y, across.z) ? target.centre_m.x
           : across.y >= across.z                   ? target.centre_m.y
                                                    : target.centre_m.z;
  };
  const std::size_t half = targets.size() / 2;
  std::nth_element(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(half), targets.end(),
                   [&](const ShiningTarget& a, const ShiningTarget& b) { return along(a) < along(b); });
  halve(targets.subspan(0, half), most / 2, to);
  halve(targets.subspan(half), most - most / 2, to);
}

}  // namespace

std::vector<ShiningTarget> put_together(std::vector<ShiningTarget> targets, std::size_t most) {
  if (targets.size() <= most) return targets;
  std::vector<ShiningTarget> groups;
  halve(targets, most, groups);
  return groups;
}

}  // namespace ifov::render
