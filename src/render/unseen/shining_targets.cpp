#include "render/unseen/shining_targets.h"

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

}  // namespace ifov::render
