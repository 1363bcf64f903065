#include "session/facade/rays.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/world.h"
#include "ifov/radiometry.h"
#include "radiometry/planck.h"
#include "session/loaded/parts.h"

namespace ifov {
namespace session {
namespace {

constexpr std::size_t kBatch = 1024;  // rays that are traced together

math::Ray ray_of(const std::array<double, 3>& origin, const std::array<double, 3>& direction,
                 const math::Vec3& offset_m, std::size_t number) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!std::isfinite(length) || !(length > 0.0) || !std::isfinite(origin[0] + origin[1] + origin[2]))
    throw InputError(
        format("ray {}: from ({:g}, {:g}, {:g}) towards ({:g}, {:g}, {:g}); expected a point and a "
               "direction",
               number, origin[0], origin[1], origin[2], direction[0], direction[1], direction[2]));
  math::Ray ray;
  ray.origin_m = {origin[0] - offset_m.x, origin[1] - offset_m.y, origin[2] - offset_m.z};
  ray.direction = {direction[0] / length, direction[1] / length, direction[2] / length};
  return ray;
}

RayHit hit_of(const Parts& parts, const geometry::SurfacePoint& point) {
  RayHit hit;
  if (!point.hit()) return hit;
  hit.hit = true;
  hit.distance_m = point.distance_m;
  hit.position_m = {point.position_m.x + parts.map_offset_m.x, point.position_m.y + parts.map_offset_m.y,
                    point.position_m.z + parts.map_offset_m.z};
  const double side = point.front ? 1.0 : -1.0;
  const auto& normal = point.geometric_normal;
  hit.normal = {side * normal.x, side * normal.y, side * normal.z};
  hit.u = point.u, hit.v = point.v;
  const std::size_t object = parts.placed.of(point.instance);
  if (object < parts.placed.document_objects()) hit.object = static_cast<int>(object);
  const scene::ResolvedSurface surface = parts.scene.resolve_without_temperature(point);
  const auto largest = std::max_element(
      surface.begin(), surface.end(),
      [](const scene::Constituent& a, const scene::Constituent& b) { return a.weight < b.weight; });
  hit.material = parts.scene.materials[largest->material].name;
  return hit;
}

}  // namespace

std::vector<RayHit> cast_rays(const Parts& parts, std::span<const std::array<double, 3>> origins_m,
                              std::span<const std::array<double, 3>> directions, int threads) {
  if (origins_m.size() != directions.size())
    throw InputError(format("{} origins and {} directions; expected as many of one as of the other",
                            origins_m.size(), directions.size()));
  std::vector<RayHit> hits(origins_m.size());
  const std::size_t batches = (hits.size() + kBatch - 1) / kBatch;
  parallel_for(static_cast<std::int64_t>(batches), threads, [&](std::int64_t batch) {
    const std::size_t first = static_cast<std::size_t>(batch) * kBatch,
                      end = std::min(first + kBatch, hits.size());
    std::vector<math::Ray> rays;
    for (std::size_t k = first; k < end; ++k)
      rays.push_back(ray_of(origins_m[k], directions[k], parts.map_offset_m, k));
    std::vector<geometry::SurfacePoint> points(rays.size());
    parts.scene.world->intersect(rays, points);
    for (std::size_t k = first; k < end; ++k) hits[k] = hit_of(parts, points[k - first]);
  });
  return hits;
}

}  // namespace session

double planck_radiance(double wavelength_um, double temperature_k) {
  return radiometry::planck_w_m2_sr_um(wavelength_um, temperature_k);
}

double brightness_temperature(double wavelength_um, double radiance) {
  return radiometry::brightness_temperature_k(wavelength_um, radiance);
}

}  // namespace ifov
