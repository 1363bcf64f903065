#include "truth/sunlight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geodesy/sun_position.h"
#include "materials/bsdf/bsdf.h"
#include "truth/side_seen.h"

namespace ifov::truth {
namespace {

constexpr float kNoSun = std::numeric_limits<float>::quiet_NaN();

void collect_sun_angles(const MiddleRays& rays, std::span<float> values) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::fill(values.begin(), values.end(), kNoSun);
  if (!rays.scene.sun) return;
  const scene::Sun& sun = *rays.scene.sun;
  const auto zenith = static_cast<float>(sun.zenith_rad() * kDegrees),
             azimuth = static_cast<float>(geodesy::compass_deg(sun.azimuth_rad()));
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    if (!rays.hits[k].hit()) continue;
    const math::Vec3 normal = normal_seen(rays.hits[k], rays.surfaces[k]);
    values[3 * k] = zenith;
    values[3 * k + 1] = azimuth;
    values[3 * k + 2] = static_cast<float>(
        std::atan2(math::length(math::cross(normal, sun.direction)), math::dot(normal, sun.direction)) *
        kDegrees);
  }
}

bool lets_light_through(const scene::Scene& scene, const scene::ResolvedSurface& surface) {
  return std::any_of(surface.begin(), surface.end(), [&](const scene::Constituent& part) {
    const materials::Material& material = scene.materials[part.material];
    // Of a separable model it is the material that says so.
    return material.transmittance.has_value() ||
           (!material.bsdf->is_separable() && material.bsdf->may_transmit());
  });
}

void collect_shadows(const MiddleRays& rays, std::span<float> values) {
  std::fill(values.begin(), values.end(), kNoSun);
  if (!rays.scene.sun) return;
  const math::Vec3 towards_sun = rays.scene.sun->direction;
  std::vector<math::Ray> sun_rays;
  std::vector<std::size_t> owners;
  for (std::size_t k = 0; k < rays.hits.size(); ++k) {
    const geometry::SurfacePoint& hit = rays.hits[k];
    if (!hit.hit()) continue;
    const math::Vec3 normal = hit.geometric_normal.as_vector(), seen = hit.front ? normal : -normal;
    const bool faces = math::dot(seen, towards_sun) > 0.0;
    values[k] = 1.0f;
    if (!faces && !lets_light_through(rays.scene, rays.surfaces[k])) continue;
    sun_rays.push_back(
        rays.rays[k].onward(hit.position_m + hit.offset_m * (faces ? seen : -seen), towards_sun));
    owners.push_back(k);
  }
  std::vector<std::uint8_t> blocked(sun_rays.size());
  if (!sun_rays.empty()) rays.scene.world->occluded(sun_rays, blocked);
  for (std::size_t j = 0; j < owners.size(); ++j) values[owners[j]] = blocked[j] != 0 ? 1.0f : 0.0f;
}

}  // namespace

constinit const Collector kSunAngles{"sun_angles", 3, collect_sun_angles};
constinit const Collector kShadow{"shadow", 1, collect_shadows};

}  // namespace ifov::truth
