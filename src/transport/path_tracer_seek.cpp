// Light that is sought from emitters, and its balance with what scattered rays find.
#include <algorithm>

#include "geometry/world.h"
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/path_parts.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/sky/sky_dome.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

/// Dimension pairs of the choice of an emitter begin here, beyond those of any path's own.
constexpr std::uint32_t kSeekPairs = 1u << 16;

}  // namespace

double PathTracer::scattered(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                             bool transmitted) {
  materials::BsdfEvent event = sides.event(lobe, transmitted, direction);
  if (lobe.directional) {
    const LobeEvent kept = scattering(lobe, sides, direction, transmitted);
    return kept.weight > 0.0f || kept.image_weight > 0.0f ? 1.0 : 0.0;
  }
  const double own = std::max(0.0, event.incoming_cosine());
  double light = own > 0.0 ? own * lobe.bsdf->shape(event) : 0.0;
  if (sides.perturbed) {
    // What the bent normal would take from below the surface comes mirrored from above it.
    event.incoming = mirrored(direction, sides.outward);
    const double below = event.incoming_cosine();
    if (below > 0.0) light += below * lobe.bsdf->shape(event);
  }
  return light;
}

double PathTracer::continuation_density(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                                        bool transmitted) const {
  materials::BsdfEvent event = sides.event(lobe, transmitted, direction);
  const double share = sky_share(*lobe.bsdf, event, sides.perturbed);
  double density = (1.0 - share) * lobe.bsdf->pdf(event);
  if (share > 0.0) density += share * sky_->density(direction);
  if (!sides.perturbed) return density;
  event.incoming = mirrored(direction, sides.outward);
  return density + lobe.bsdf->pdf(event);
}

void PathTracer::seek(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                      const PathKey& key, int depth, SurfaceEvent& event) {
  const std::uint32_t pair = kSeekPairs + 2u * static_cast<std::uint32_t>(depth);
  const sampling::Point2 u = sampling::sequence_point(key.sequence, key.index, pair);
  const auto on_side = [&](bool transmitted) {
    const math::Vec3 outward = transmitted ? -sides.outward : sides.outward;
    return Receiver{hit.position_m + hit.offset_m * outward, outward};
  };
  double reflected = 1.0;
  if (lobe.highest_transmittance > 0.0) {
    const double front = lobe.highest_reflectance * emitters_->reach(on_side(false));
    const double behind = lobe.highest_transmittance * emitters_->reach(on_side(true));
    if (!(front + behind > 0.0)) return;
    reflected = front / (front + behind);
  }
  event.seek_reflected = reflected;
  const bool transmitted =
      reflected < 1.0 && !(sampling::sequence_point(key.sequence, key.index, pair + 1u).x < reflected);
  const Receiver receiver = on_side(transmitted);
  Seek seek;
  seek.aim = emitters_->aim(receiver, u);
  if (!(seek.aim.density > 0.0) || !(math::dot(seek.aim.direction, receiver.normal) > 0.0)) return;
  const double density = seek.aim.density * (transmitted ? 1.0 - reflected : reflected);
  const double found = side_probability(lobe, sides, transmitted) *
                       continuation_density(lobe, sides, seek.aim.direction, transmitted);
  if (!(density > found)) return;
  seek.weight = scattered(lobe, sides, seek.aim.direction, transmitted) / density;
  if (!(seek.weight > 0.0)) return;
  if (PathRecord::Events* events = events_of(event.vertex))
    events->sought = scattering(lobe, sides, seek.aim.direction, transmitted);
  event.vertex.sought_transmitted = transmitted;
  event.seek = static_cast<std::uint32_t>(seeks_.size());
  seeks_.push_back(seek);
  seek_rays_.push_back(sides.leaving(receiver.at_m, seek.aim.direction));
}

void PathTracer::leave(const SurfaceLobe& lobe, const Sides& sides, bool transmitted, double probability,
                       SurfaceEvent& event) const {
  event.left = {};
  if (lobe.bsdf->is_delta() || event.seek_reflected < 0.0) return;
  event.left.receiver = {event.next.origin_m, transmitted ? -sides.outward : sides.outward};
  event.left.density = probability * continuation_density(lobe, sides, event.next.direction, transmitted);
  event.left.seek_probability = transmitted ? 1.0 - event.seek_reflected : event.seek_reflected;
}

float PathTracer::unsought(const Path& path, const geometry::SurfacePoint& hit) const {
  double density = 0.0;  // 1/sr where the path left
  if (path.left.round != kNone) {
    density = emitters_->point_density(path.left.receiver, hit);
    if (density > 0.0) {
      RoundMirror::Image image;
      std::copy(path.left.widens.begin(), path.left.widens.end(), image.widens);
      density *=
          image.area_m2(hit.distance_m) /
          std::max(kGrazing, std::abs(math::dot(hit.geometric_normal.as_vector(), path.ray.direction)));
    }
  } else {
    geometry::SurfacePoint seen = hit;
    if (path.left.unfolded) seen.distance_m = math::length(hit.position_m - path.left.receiver.at_m);
    density = emitters_->density(path.left.receiver, path.ray.direction, seen);
  }
  return path.left.seek_probability * density > path.left.density ? 0.0f : 1.0f;
}

void PathTracer::trace_seeks(sampling::RayCounts& counts) {
  seek_hits_.resize(seek_rays_.size());
  scene_.scene().world->intersect(seek_rays_, seek_hits_);
  counts.shadow += seek_rays_.size();
  if (passages_) pass_seeks(counts);
  for (SurfaceEvent& event : events_) {
    if (event.seek == kNone) continue;
    const Seek& seek = seeks_[event.seek];
    const geometry::SurfacePoint& hit = seek_hits_[event.seek];
    if (!emitters_->is(seek.aim, hit)) continue;
    PathVertex& vertex = event.vertex;
    vertex.sought_weight = static_cast<float>(seek.weight);
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    const math::Vec3 outgoing = -seek.aim.direction;
    if (options_.no_spectra || scene_.is_mixed(surface))
      vertex.sought_mixed = add_mixed(surface, SurfaceLobe{}, outgoing);
    else
      vertex.sought_emission = scene_.emission(surface, outgoing, nullptr);
  }
}

}  // namespace ifov::transport
