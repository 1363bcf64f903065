// Light that is sought from emitters, and its balance with what scattered rays find.
#include <algorithm>

#include "materials/scattering.h"
#include "math/vec3.h"
#include "render/path_sides.h"
#include "render/path_tracer.h"
#include "sampling/sequence.h"

namespace ifov::render {

namespace {

/// Dimension pairs of the choice of an emitter begin here, beyond those of any path's own.
constexpr std::uint32_t kSeekPairs = 1u << 16;

}  // namespace

double PathTracer::scattered(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction, bool through) {
  const math::Normal3 axis = through ? -sides.shading : sides.shading;
  const math::Vec3 viewer = through ? axis.as_vector() : sides.outgoing;
  const double own = std::max(0.0, math::dot(axis, direction));
  double light = own > 0.0 ? own * lobe.scattering->evaluate(viewer, direction, axis) : 0.0;
  if (sides.bent) {
    // What the bent normal would take from below the surface comes mirrored from above it.
    const math::Vec3 image = mirrored(direction, sides.outward);
    const double below = math::dot(axis, image);
    if (below > 0.0) light += below * lobe.scattering->evaluate(viewer, image, axis);
  }
  return light;
}

double PathTracer::bounce_density(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                                  bool through) const {
  const math::Normal3 axis = through ? -sides.shading : sides.shading;
  const math::Vec3 viewer = through ? axis.as_vector() : sides.outgoing;
  const double share = sky_share(*lobe.scattering, axis, sides.bent);
  double density = (1.0 - share) * lobe.scattering->pdf(viewer, direction, axis);
  if (share > 0.0) density += share * sky_->density(direction);
  if (sides.bent) density += lobe.scattering->pdf(viewer, mirrored(direction, sides.outward), axis);
  return density;
}

void PathTracer::seek(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                      const PathKey& key, int depth, Scatter& event) {
  const std::uint32_t pair = kSeekPairs + 2u * static_cast<std::uint32_t>(depth);
  const sampling::Point2 u = sampling::sequence_point(key.sequence, key.index, pair);
  const auto on_side = [&](bool through) {
    const math::Vec3 outward = through ? -sides.outward : sides.outward;
    return Receiver{hit.position_m + hit.offset_m * outward, outward};
  };
  double reflected = 1.0, scattered_back = 1.0;
  if (lobe.highest_transmittance > 0.0) {
    const double front = lobe.highest_reflectance * emitters_->reach(on_side(false));
    const double behind = lobe.highest_transmittance * emitters_->reach(on_side(true));
    if (!(front + behind > 0.0)) return;
    reflected = front / (front + behind);
    scattered_back = lobe.highest_reflectance / (lobe.highest_reflectance + lobe.highest_transmittance);
  }
  event.seek_reflected = reflected;
  const bool through =
      reflected < 1.0 && !(sampling::sequence_point(key.sequence, key.index, pair + 1u).x < reflected);
  const Receiver receiver = on_side(through);
  Seek seek;
  seek.aim = emitters_->aim(receiver, u);
  if (!(seek.aim.density > 0.0) || !(math::dot(seek.aim.direction, receiver.normal) > 0.0)) return;
  const double density = seek.aim.density * (through ? 1.0 - reflected : reflected);
  const double found = (through ? 1.0 - scattered_back : scattered_back) *
                       bounce_density(lobe, sides, seek.aim.direction, through);
  if (!(density > found)) return;
  seek.weight = scattered(lobe, sides, seek.aim.direction, through) / density;
  if (!(seek.weight > 0.0)) return;
  event.vertex.sought_through = through;
  event.seek = static_cast<std::uint32_t>(seeks_.size());
  seeks_.push_back(seek);
  seek_rays_.push_back({receiver.at_m, seek.aim.direction});
}

void PathTracer::leave(const SurfaceLobe& lobe, const Sides& sides, bool through, double chance,
                       Scatter& event) const {
  event.left = {};
  if (lobe.scattering->is_delta() || event.seek_reflected < 0.0) return;
  event.left.receiver = {event.next.origin_m, through ? -sides.outward : sides.outward};
  event.left.density = chance * bounce_density(lobe, sides, event.next.direction, through);
  event.left.seek_chance = through ? 1.0 - event.seek_reflected : event.seek_reflected;
}

float PathTracer::unsought(const Path& path, const geometry::SurfacePoint& hit) const {
  const double sought =
      path.left.seek_chance * emitters_->density(path.left.receiver, path.ray.direction, hit);
  return sought > path.left.density ? 0.0f : 1.0f;
}

void PathTracer::trace_seeks(sampling::RayCounts& counts) {
  seek_hits_.resize(seek_rays_.size());
  scene_.scene().world->intersect(seek_rays_, seek_hits_);
  counts.shadow += seek_rays_.size();
  for (Scatter& event : scatters_) {
    if (event.seek == kNone) continue;
    const Seek& seek = seeks_[event.seek];
    const geometry::SurfacePoint& hit = seek_hits_[event.seek];
    if (!emitters_->is(seek.aim, hit)) continue;
    PathVertex& vertex = event.vertex;
    vertex.sought_weight = static_cast<float>(seek.weight);
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    if (surface.count > 1 || surface.constituents[0].mapped_temperature_k > 0.0) {
      vertex.sought_mixed = static_cast<std::uint32_t>(record_.mixed.size());
      record_.mixed.push_back({surface, SurfaceLobe{}});
    } else {
      vertex.sought_emission = scene_.emission(surface, nullptr);
    }
  }
}

}  // namespace ifov::render
