#include "session/temperatures/looked_for_point.h"

#include <cmath>

#include "core/error.h"
#include "geometry/world.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

constexpr double kAbove_m = 1.0;
constexpr int kMostPassed = 4096;  // surfaces of other objects

math::Ray ray_of(const Parts& parts, std::optional<std::size_t> object, const PointQuestion& question) {
  math::Ray ray{{question.x_m, question.y_m, question.z_m},
                {question.along_x, question.along_y, question.along_z}};
  const double length = std::sqrt(math::dot(ray.direction, ray.direction));
  if (!(length > 0.0) || !std::isfinite(length))
    throw InputError("the direction in which a surface is looked for has no length");
  ray.direction = (1.0 / length) * ray.direction;
  if (question.above_object && object && parts.placed.count(*object) > 0) {
    const math::Point3 middle_m = parts.scene.world->object(parts.placed.first(*object)).pilot_point_m;
    ray.origin_m.x = middle_m.x;
    ray.origin_m.y = middle_m.y;
  }
  if (!std::isfinite(ray.origin_m.z)) ray.origin_m.z = parts.scene.world->heights().high_m + kAbove_m;
  return ray;
}

geometry::SurfacePoint met_by(const Parts& parts, math::Ray ray, std::optional<std::size_t> object) {
  geometry::SurfacePoint met;
  for (int k = 0; k < kMostPassed; ++k) {
    parts.scene.world->intersect({&ray, 1}, {&met, 1});
    if (!met.hit() || !object || parts.placed.of(met.instance) == *object) return met;
    ray.t_min_m = met.distance_m + met.offset_m;
  }
  return {};
}

}  // namespace

LookedForPoint look_for(const Parts& parts, std::optional<std::size_t> object,
                        const PointQuestion& question) {
  LookedForPoint found;
  found.along = ray_of(parts, object, question);
  found.met = met_by(parts, found.along, object);
  if (!found.met.hit()) return found;
  found.object = parts.placed.of(found.met.instance);
  const scene::ResolvedSurface resolved = parts.scene.resolve_without_temperature(found.met);
  const scene::SurfaceState& state = parts.scene.states[resolved.constituents[0].state];
  if (state.solved == 0) return found;
  found.material = state.solved - 1;
  found.surface = parts.scene.solved[found.material].get();
  found.optics = &parts.scene.materials[found.material];
  if (!parts.temperature_errors) return found;
  const auto error = parts.temperature_errors->by_material.find(found.material);
  if (error != parts.temperature_errors->by_material.end())
    found.half_width_k = error->second.whole_half_width_k();
  return found;
}

}  // namespace ifov::session
