// Light that is sought from emitters, and its balance with what scattered rays find.
#include <algorithm>

#include "materials/bsdf/mirror.h"
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "transport/emitter_mirrors.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/sky/sky_dome.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

/// Dimension pairs of the choice of an emitter begin here, beyond those of any path's own.
constexpr std::uint32_t kSeekPairs = 1u << 16, kMirrorSeekPairs = 1u << 18;
/// Planes of mirrors by way of which a surface seeks; where there are more, some are picked by chance.
constexpr std::size_t kMostPlanes = 4;

}  // namespace

double PathTracer::scattered(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                             bool through) {
  materials::BsdfEvent event = sides.event(lobe, through, direction);
  if (lobe.directional) {
    const LobeEvent kept = scattering(lobe, sides, direction, through);
    return kept.weight > 0.0f || kept.image_weight > 0.0f ? 1.0 : 0.0;
  }
  const double own = std::max(0.0, event.incoming_cosine());
  double light = own > 0.0 ? own * lobe.bsdf->shape(event) : 0.0;
  if (sides.bent) {
    // What the bent normal would take from below the surface comes mirrored from above it.
    event.incoming = mirrored(direction, sides.outward);
    const double below = event.incoming_cosine();
    if (below > 0.0) light += below * lobe.bsdf->shape(event);
  }
  return light;
}

double PathTracer::bounce_density(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                                  bool through) const {
  materials::BsdfEvent event = sides.event(lobe, through, direction);
  const double share = sky_share(*lobe.bsdf, event, sides.bent);
  double density = (1.0 - share) * lobe.bsdf->pdf(event);
  if (share > 0.0) density += share * sky_->density(direction);
  if (!sides.bent) return density;
  event.incoming = mirrored(direction, sides.outward);
  return density + lobe.bsdf->pdf(event);
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
  if (PathRecord::Events* events = events_of(event.vertex))
    events->sought = scattering(lobe, sides, seek.aim.direction, through);
  event.vertex.sought_through = through;
  event.seek = static_cast<std::uint32_t>(seeks_.size());
  seeks_.push_back(seek);
  seek_rays_.push_back({receiver.at_m, seek.aim.direction});
}

void PathTracer::leave(const SurfaceLobe& lobe, const Sides& sides, bool through, double chance,
                       Scatter& event) const {
  event.left = {};
  if (lobe.bsdf->is_delta() || event.seek_reflected < 0.0) return;
  event.left.receiver = {event.next.origin_m, through ? -sides.outward : sides.outward};
  event.left.density = chance * bounce_density(lobe, sides, event.next.direction, through);
  event.left.seek_chance = through ? 1.0 - event.seek_reflected : event.seek_reflected;
}

float PathTracer::unsought(const Path& path, const geometry::SurfacePoint& hit) const {
  geometry::SurfacePoint seen = hit;
  if (path.left.unfolded) seen.distance_m = math::length(hit.position_m - path.left.receiver.at_m);
  const double sought =
      path.left.seek_chance * emitters_->density(path.left.receiver, path.ray.direction, seen);
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
    const math::Vec3 outgoing = -seek.aim.direction;
    if (scene_.is_mixed(surface))
      vertex.sought_mixed = add_mixed(surface, SurfaceLobe{}, outgoing);
    else
      vertex.sought_emission = scene_.emission(surface, outgoing, nullptr);
  }
}

double PathTracer::mirror_chance() const {
  const std::size_t planes = emitter_mirrors_->count();
  return static_cast<double>(std::min(planes, kMostPlanes)) / static_cast<double>(planes);
}

/// A mirror shows an emitter where its image stands, so that the surface's image behind the mirror sees the emitter
/// itself: light is sought for that.
void PathTracer::seek_by_mirrors(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                 const Sides& sides, const geometry::SurfacePoint& hit, const PathKey& key,
                                 int depth, Scatter& event) {
  if (lobe.highest_transmittance > 0.0) return;
  const std::size_t planes = emitter_mirrors_->count(), rays = std::min(planes, kMostPlanes);
  const Receiver receiver{hit.position_m + hit.offset_m * sides.outward, sides.outward};
  for (std::size_t k = 0; k < rays; ++k) {
    const std::uint32_t pair =
        kMirrorSeekPairs + static_cast<std::uint32_t>(2 * kMostPlanes) * static_cast<std::uint32_t>(depth) +
        2u * static_cast<std::uint32_t>(k);
    std::size_t picked = k;
    if (rays < planes) {
      const double place = sampling::sequence_point(key.sequence, key.index, pair + 1u).x;
      picked = std::min(planes - 1,
                        static_cast<std::size_t>((static_cast<double>(k) + place) *
                                                 static_cast<double>(planes) / static_cast<double>(rays)));
    }
    MirrorSeek seek;
    seek.plane = static_cast<std::uint32_t>(picked);
    const Receiver image = emitter_mirrors_->behind(seek.plane, receiver);
    seek.aim = emitters_->aim(image, sampling::sequence_point(key.sequence, key.index, pair));
    if (!(seek.aim.density > 0.0)) continue;
    const math::Vec3 direction = emitter_mirrors_->mirrored(seek.plane, seek.aim.direction);
    if (!(math::dot(direction, receiver.normal) > 0.0)) continue;
    const double density = seek.aim.density * mirror_chance();
    if (!(density > bounce_density(lobe, sides, direction, false))) continue;
    seek.light.weight = static_cast<float>(scattered(lobe, sides, direction, false) / density);
    if (!(seek.light.weight > 0.0f)) continue;
    seek.event = static_cast<std::uint32_t>(scatters_.size() - 1);
    seek.ray = {receiver.at_m, direction};
    seek.light.surface =
        surface_factor(surface, event.vertex,
                       lobe.directional ? scattering(lobe, sides, direction, false) : LobeEvent{}, false);
    mirror_seeks_.push_back(seek);
  }
}

void PathTracer::trace_mirror_seeks(sampling::RayCounts& counts) {
  const auto trace = [&] {
    seek_rays_.clear();
    for (const MirrorSeek& seek : mirror_seeks_) seek_rays_.push_back(seek.ray);
    seek_hits_.resize(seek_rays_.size());
    scene_.scene().world->intersect(seek_rays_, seek_hits_);
    counts.shadow += seek_rays_.size();
  };
  trace();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < mirror_seeks_.size(); ++k) {
    MirrorSeek& seek = mirror_seeks_[k];
    const geometry::SurfacePoint& hit = seek_hits_[k];
    if (!hit.hit()) continue;
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    if (!shows_mirror(surface) ||
        emitter_mirrors_->plane_of(hit, surface.shading_normal.as_vector()) != seek.plane)
      continue;
    seek.light.mirrors[seek.light.count++] = mirror_factor(surface);
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    seek.ray = {hit.position_m + hit.offset_m * outward, seek.aim.direction};
    mirror_seeks_[kept++] = seek;
  }
  mirror_seeks_.resize(kept);
  trace();
  for (std::size_t k = 0; k < mirror_seeks_.size(); ++k) {
    MirrorSeek& seek = mirror_seeks_[k];
    const geometry::SurfacePoint& hit = seek_hits_[k];
    if (!emitters_->is(seek.aim, hit)) continue;
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    seek.light.emitted = true;
    const math::Vec3 outgoing = -seek.ray.direction;
    if (scene_.is_mixed(surface))
      seek.light.emission_mixed = add_mixed(surface, SurfaceLobe{}, outgoing);
    else
      seek.light.emission = scene_.emission(surface, outgoing, nullptr);
    PathVertex& vertex = scatters_[seek.event].vertex;
    seek.light.next = vertex.mirrored;
    vertex.mirrored = static_cast<std::uint32_t>(record_.mirrored.size());
    record_.mirrored.push_back(seek.light);
  }
}

bool PathTracer::shows_mirror(const scene::ResolvedSurface& surface) const {
  return std::any_of(surface.begin(), surface.end(),
                     [&](const scene::Constituent& part) { return is_mirror(scene_.scene(), part); });
}

PathRecord::Mirrored::Factor PathTracer::mirror_factor(const scene::ResolvedSurface& surface) {
  PathRecord::Mirrored::Factor factor;
  if (surface.count == 1) {
    factor.row = scene_.materials().reflectance(surface.constituents[0].material);
  } else {
    SurfaceLobe lobe;
    lobe.bsdf = materials::Mirror::shared().get();
    factor.mixed = add_mixed(surface, lobe, {});
  }
  return factor;
}

PathRecord::Mirrored::Factor PathTracer::surface_factor(const scene::ResolvedSurface& surface,
                                                        const PathVertex& vertex, const LobeEvent& event,
                                                        bool through) {
  PathRecord::Mirrored::Factor factor;
  factor.mixed = vertex.mixed;
  if (vertex.mixed == PathVertex::kNone) {
    const std::uint32_t material = surface.constituents[0].material;
    factor.row =
        through ? scene_.materials().transmittance(material) : scene_.materials().reflectance(material);
  } else if (record_.mixed[vertex.mixed].lobe.directional) {
    factor.event = static_cast<std::uint32_t>(record_.way_events.size());
    record_.way_events.push_back(event);
  }
  return factor;
}

}  // namespace ifov::transport
