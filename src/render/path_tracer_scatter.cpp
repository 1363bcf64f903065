// What a path does at a surface: light sent to the Sun, and where it goes on.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/scattering.h"
#include "math/vec3.h"
#include "render/path_tracer.h"
#include "sampling/sequence.h"

namespace ifov::render {

namespace {

/// Surfaces a path scatters at before it may be ended by chance.
constexpr int kCertainScatterings = 3;

/// What the random choice between shapes at a surface is keyed by, beside its path and depth.
constexpr std::uint64_t kShapeChoice = 0x7368617065ull;

/// Share of the directions that a level surface draws from the sky.
constexpr double kMostSkySamples = 0.6;

/// A shading normal is bent back until the viewer stands at least this far above its horizon (a cosine):
/// nobody sees a surface from behind.
constexpr double kLeastCosine = 1e-3;

math::Vec3 mirrored(math::Vec3 direction, math::Vec3 normal) {
  return direction - 2.0 * math::dot(direction, normal) * normal;
}

}  // namespace

/// The surface as seen along a path: normals on the viewer's side.
struct PathTracer::Sides {
  math::Vec3 outgoing;  // towards the viewer
  math::Vec3 outward;   // geometric normal
  math::Normal3 shading;
  bool bent = false;  // the two differ

  Sides(math::Vec3 towards_viewer, const geometry::SurfacePoint& hit, math::Normal3 shading_normal)
      : outgoing(towards_viewer),
        outward((hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector()),
        shading(hit.front ? shading_normal : -shading_normal) {
    const math::Vec3 s = shading.as_vector();
    bent = s.x != outward.x || s.y != outward.y || s.z != outward.z;
    if (!bent) return;
    const double seen = math::dot(s, outgoing);
    if (seen < kLeastCosine) {
      const double along = std::max(1e-9, math::dot(outward, outgoing));
      shading = math::as_normal(math::normalized(s + (kLeastCosine - seen) / along * outward));
    }
  }
};

PathVertex PathTracer::vertex_of(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe) {
  PathVertex vertex;
  if (surface.count > 1 || surface.constituents[0].mapped_temperature_k > 0.0) {
    vertex.mixed = static_cast<std::uint32_t>(record_.mixed.size());
    record_.mixed.push_back({surface, lobe});
  } else {
    vertex.emission = scene_.emission(surface, nullptr);
  }
  return vertex;
}

void PathTracer::scatter(const Path& path, std::uint32_t path_index, const scene::ResolvedSurface& surface,
                         int depth) {
  const double choice =
      surface.count > 1
          ? sampling::unit_double(sampling::hash(path.key.sequence, path.key.index, depth, kShapeChoice))
          : 0.0;
  const SurfaceLobe lobe = surface_lobe(scene_, surface, choice);
  const geometry::SurfacePoint& hit = hits_[path_index];
  Scatter& event = scatters_.emplace_back();
  event.path = path_index;
  event.vertex = vertex_of(surface, lobe);
  event.vertex.height_m = hit.position_m.z;
  if (depth == options_.maximum_scatterings || lobe.highest_reflectance + lobe.highest_transmittance <= 0.0) return;

  const Sides sides(-path.ray.direction, hit, surface.shading_normal);
  const std::uint32_t pair = 1u + 2u * static_cast<std::uint32_t>(depth);
  if (scene_.scene().sun && !lobe.scattering->is_delta())
    send_to_sun(lobe, sides, hit, sampling::sequence_point(path.key.sequence, path.key.index, pair), event);
  PathVertex& vertex = event.vertex;
  if (depth + 1 != options_.maximum_scatterings &&
      bounce(lobe, sides, hit, sampling::sequence_point(path.key.sequence, path.key.index, pair + 1u), event) &&
      depth + 1 >= kCertainScatterings) {
    const double highest = vertex.bounce_through ? lobe.highest_transmittance : lobe.highest_reflectance;
    const double chance = std::min(1.0, highest * vertex.bounce_weight);
    const bool survives =
        sampling::unit_double(sampling::hash(path.key.sequence, path.key.index, depth)) < chance;
    vertex.bounce_weight = survives ? static_cast<float>(vertex.bounce_weight / chance) : 0.0f;
  }
  if (vertex.mixed != PathVertex::kNone) return;
  const std::uint32_t material = surface.constituents[0].material;
  const auto factor = [&](bool through) {
    return through ? scene_.materials().transmittance(material) : scene_.materials().reflectance(material);
  };
  vertex.sun_factor = factor(vertex.sun_through);
  vertex.bounce_factor = factor(vertex.bounce_through);
}

void PathTracer::send_to_sun(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                             sampling::Point2 u, Scatter& event) {
  const bool transmits = lobe.highest_transmittance > 0.0;
  const math::Vec3 towards_sun = scene_.scene().sun->direction;
  const bool behind = transmits && math::dot(sides.outward, towards_sun) < 0.0;
  const math::Vec3 lit_side = behind ? -sides.shading.as_vector() : sides.shading.as_vector();
  const sampling::LightSample light = sample_sun(lit_side, transmits && !sides.bent, u);
  const double height = math::dot(light.direction, sides.outward);
  const bool through = transmits && height < 0.0;
  if (light.weight_sr <= 0.0 || (through ? height >= 0.0 : height <= 0.0)) return;

  // Light that a bent normal would take from below the surface comes mirrored from above it.
  const math::Vec3 normal = through ? -sides.shading.as_vector() : sides.shading.as_vector();
  const math::Vec3 viewer =
      through ? normal : sides.outgoing;  // what is let through looks alike from everywhere
  const math::Normal3 axis = math::as_normal(normal);
  double weight = light.weight_sr * lobe.scattering->evaluate(viewer, light.direction, axis);
  if (sides.bent) {
    const math::Vec3 image = mirrored(light.direction, sides.outward);
    const double own = math::dot(normal, light.direction), below = math::dot(normal, image);
    if (own > 0.0 && below > 0.0)
      weight += light.weight_sr * lobe.scattering->evaluate(viewer, image, axis) * below / own;
  }
  if (weight <= 0.0) return;
  event.vertex.sun_weight = static_cast<float>(weight);
  event.vertex.sun_through = through;
  event.shadow = static_cast<std::uint32_t>(shadow_rays_.size());
  shadow_rays_.push_back(
      {hit.position_m + (through ? -hit.offset_m : hit.offset_m) * sides.outward, light.direction});
}

bool PathTracer::bounce(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                        sampling::Point2 u, Scatter& event) const {
  // The side is chosen so that no node's weight outgrows the sum of the two highest factors.
  double chance = 1.0;
  bool through = false;
  if (lobe.highest_transmittance > 0.0) {
    chance = lobe.highest_reflectance / (lobe.highest_reflectance + lobe.highest_transmittance);
    through = !(u.x < chance);
    u.x = through ? (u.x - chance) / (1.0 - chance) : u.x / chance;
    if (through) chance = 1.0 - chance;
  }
  const math::Vec3 outward = through ? -sides.outward : sides.outward;
  const math::Normal3 axis = through ? -sides.shading : sides.shading;
  const math::Vec3 viewer = through ? axis.as_vector() : sides.outgoing;
  materials::ScatterSample sample = sample_bounce(*lobe.scattering, viewer, axis, sides.bent, u);
  if (sides.bent && math::dot(sample.incoming, outward) < 0.0)
    sample.incoming = mirrored(sample.incoming, outward);
  if (!(sample.weight > 0.0) || !(math::dot(sample.incoming, outward) > 0.0)) return false;
  event.vertex.bounce_weight = static_cast<float>(sample.weight / chance);
  event.vertex.bounce_through = through;
  event.next = {hit.position_m + hit.offset_m * outward, sample.incoming};
  event.next_sees_sun = lobe.scattering->is_delta();
  return true;
}

/// Under a sky that is brighter here than there, some directions are drawn from the sky and all weigh by the
/// density of both (Veach and Guibas 1995, one sample, balance heuristic): those that see the sky weigh
/// almost alike.
materials::ScatterSample PathTracer::sample_bounce(const materials::Scattering& scattering, math::Vec3 viewer,
                                                   math::Normal3 lobe, bool bent, sampling::Point2 u) const {
  const double height = lobe.as_vector().z;
  const double share = sky_ == nullptr || bent || scattering.is_delta() || height <= 0.0
                           ? 0.0
                           : kMostSkySamples * height * height;
  if (share == 0.0) return scattering.sample(viewer, lobe, u.x, u.y);
  materials::ScatterSample sample;
  if (u.x < share)
    sample.incoming = sky_->sample({u.x / share, u.y});
  else
    sample = scattering.sample(viewer, lobe, (u.x - share) / (1.0 - share), u.y);
  const double cosine = math::dot(lobe.as_vector(), sample.incoming);
  sample.pdf =
      (1.0 - share) * scattering.pdf(viewer, sample.incoming, lobe) + share * sky_->density(sample.incoming);
  sample.weight = cosine > 0.0 && sample.pdf > 0.0
                      ? scattering.evaluate(viewer, sample.incoming, lobe) * cosine / sample.pdf
                      : 0.0;
  return sample;
}

sampling::LightSample PathTracer::sample_sun(math::Vec3 normal, bool either_side, sampling::Point2 u) const {
  // Weights are relative to the irradiance of a surface that faces the Sun.
  const scene::Sun& sun = *scene_.scene().sun;
  if (sun.half_angle_rad <= 0.0) return {sun.direction, std::max(0.0, math::dot(sun.direction, normal))};
  sampling::LightSample sample = disc_->sample(sun.direction, normal, u);
  const double sine = std::sin(sun.half_angle_rad);
  // Cut by the horizon, the disc is sampled whole: what is below lights the other side.
  if (either_side && !disc_->uncut(sun.direction, normal))
    sample.weight_sr = disc_->solid_angle_sr() * std::abs(math::dot(sample.direction, normal));
  sample.weight_sr /= std::numbers::pi * sine * sine;
  return sample;
}

}  // namespace ifov::render
