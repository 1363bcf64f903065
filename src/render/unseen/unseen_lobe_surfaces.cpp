// What UnseenLobes takes a surface for that a ray met.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "materials/bsdf/narrow_lobes.h"
#include "render/unseen/unseen_lobe_rays.h"
#include "sampling/hash.h"
#include "scene/scene.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

using math::Point3;
using math::Vec3;

Point3 UnseenLobes::at_home(Point3 at) const { return render::at_home(scene_.scene(), at); }

UnseenLobes::Met UnseenLobes::met(const math::Ray& ray, const geometry::SurfacePoint& hit) const {
  Met met;
  if (!hit.hit()) return met;
  met.any = true;
  met.time_s = ray.time_s;
  met.outgoing = -ray.direction;
  met.outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
  met.surface_at = hit.position_m;
  met.at = hit.position_m + hit.offset_m * met.outward;
  met.surface = scene_.scene().resolve(hit);
  met.normal = hit.front ? met.surface.shading_normal : -met.surface.shading_normal;
  if (!(dot(met.normal, met.outgoing) > 0.0)) met.normal = math::as_normal(met.outward);
  double most = 0.0;
  for (const scene::Constituent& part : met.surface) {
    const materials::Bsdf& bsdf = *scene_.scene().materials[part.material].bsdf;
    const double share = part.weight * scene_.brightest(part.material);
    met.passes = met.passes || scene_.materials().maximum_transmittance(part.material) > 0.0f;
    if (bsdf.is_delta()) {
      met.mirrored += share;
      continue;
    }
    if (!(materials::throws_rarely(bsdf) && bsdf.lobe_is_all())) met.spread += share;
    if (!materials::throws_rarely(bsdf)) continue;
    met.narrow += share;
    const double least = bsdf.lobe_slopes().least;
    most = most > 0.0 ? std::min(most, least) : least;
  }
  met.slope = most;
  // Faces of one object count as one where they bend, each as its own else.
  const std::uint64_t face =
      hit.bend == geometry::Bend::none || hit.bend == geometry::Bend::facet ? hit.primitive + 1u : 0u;
  met.way = sampling::hash(hit.instance, hit.patch, face);
  const Vec3 n = met.normal.as_vector();
  met.onward = math::normalized(ray.direction - 2.0 * dot(ray.direction, n) * n);
  return met;
}

double UnseenLobes::shown(const Met& from, const ShiningTarget& target, double slope) const {
  const transport::ShiningParts::Part& part = target.part;
  const Vec3 to = target.centre_m - at_home(from.at), n = from.normal.as_vector();
  const double distance = length(to), radius = part.ball.radius_m;
  if (!(dot(to, from.outward) > -radius)) return 0.0;
  const double sine = distance > radius ? radius / distance : 1.0;
  // Of what stands across the horizon, a place above it.
  Vec3 direction = to / std::max(distance, 1e-300);
  const double above = dot(direction, n), least = std::max(1e-3, 0.5 * sine);
  if (above < least) direction = math::normalized(direction + (least - above) * n);
  const double light_sr = std::numbers::pi * sine * sine * part.fill * dot(direction, n);
  const double reach = distance > target.reach_m() ? target.reach_m() / distance : 1.0;
  const double wide = std::max(slope, 0.5 * std::asin(std::min(1.0, reach)));
  const Vec3 east = std::abs(n.x) < 0.999 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  materials::BsdfEvent event{from.outgoing, direction, from.normal, math::normalized(east - dot(east, n) * n),
                             materials::Side::reflected};
  double sum = 0.0;
  for (const scene::Constituent& constituent : from.surface) {
    const materials::Bsdf& bsdf = *scene_.scene().materials[constituent.material].bsdf;
    if (!materials::throws_rarely(bsdf)) continue;
    sum += constituent.weight * scene_.brightest(constituent.material) *
           std::min(1.0, bsdf.widened_lobe(event, wide) * light_sr);
  }
  return sum;
}

bool UnseenLobes::is_free(const Met& from, const ShiningTarget& target, sampling::RayCounts& counts) const {
  const Point3 at = at_home(from.at);
  const Vec3 to = target.centre_m - at;
  const double distance = length(to), before = distance - target.reach_m();
  if (!(before > 0.0)) return true;
  const math::Ray ray{at, to / distance, 0.0, before * (1.0 - 1e-6),
                      target.moving != nullptr ? target.moving->time_s : from.time_s};
  std::uint8_t blocked = 0;
  scene_.scene().world->occluded({&ray, 1}, {&blocked, 1});
  ++counts.shadow;
  return blocked == 0;
}

}  // namespace ifov::render
