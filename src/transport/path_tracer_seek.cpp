// Light that is sought from emitters, and its balance with what scattered rays find.
#include <algorithm>

#include "materials/scattering.h"
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"

namespace ifov::transport {

namespace {

/// Dimension pairs of the choice of an emitter begin here, beyond those of any path's own.
constexpr std::uint32_t kSeekPairs = 1u << 16, kMirrorSeekPairs = 1u << 18;
/// Planes of mirrors by way of which a surface seeks; where there are more, some are picked by chance.
constexpr std::size_t kMostPlanes = 4;

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
    if (surface.count > 1 || surface.constituents[0].mapped_temperature_k > 0.0) {
      vertex.sought_mixed = static_cast<std::uint32_t>(record_.mixed.size());
      record_.mixed.push_back({surface, SurfaceLobe{}});
    } else {
      vertex.sought_emission = scene_.emission(surface, nullptr);
    }
  }
}

double PathTracer::mirror_chance() const {
  const std::size_t planes = emitter_mirrors_->count();
  return static_cast<double>(std::min(planes, kMostPlanes)) / static_cast<double>(planes);
}

/// A mirror shows an emitter where its image stands, so that the surface's image behind the mirror sees the emitter
/// itself: light is sought for that.
void PathTracer::seek_by_mirrors(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe, const Sides& sides,
                                 const geometry::SurfacePoint& hit, const PathKey& key, int depth, Scatter& event) {
  if (lobe.highest_transmittance > 0.0) return;
  const std::size_t planes = emitter_mirrors_->count(), rays = std::min(planes, kMostPlanes);
  const Receiver receiver{hit.position_m + hit.offset_m * sides.outward, sides.outward};
  for (std::size_t k = 0; k < rays; ++k) {
    const std::uint32_t pair = kMirrorSeekPairs + static_cast<std::uint32_t>(2 * kMostPlanes) * static_cast<std::uint32_t>(depth) +
                               2u * static_cast<std::uint32_t>(k);
    std::size_t picked = k;
    if (rays < planes) {
      const double place = sampling::sequence_point(key.sequence, key.index, pair + 1u).x;
      picked = std::min(planes - 1, static_cast<std::size_t>((static_cast<double>(k) + place) * static_cast<double>(planes) /
                                                             static_cast<double>(rays)));
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
    seek.light.surface.mixed = event.vertex.mixed;
    if (seek.light.surface.mixed == PathVertex::kNone)
      seek.light.surface.row = scene_.materials().reflectance(surface.constituents[0].material);
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
    if (!shows_mirror(surface) || emitter_mirrors_->plane_of(hit, surface.shading_normal.as_vector()) != seek.plane) continue;
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
    if (surface.count > 1 || surface.constituents[0].mapped_temperature_k > 0.0) {
      seek.light.emission_mixed = static_cast<std::uint32_t>(record_.mixed.size());
      record_.mixed.push_back({surface, SurfaceLobe{}});
    } else {
      seek.light.emission = scene_.emission(surface, nullptr);
    }
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
    factor.mixed = static_cast<std::uint32_t>(record_.mixed.size());
    SurfaceLobe lobe;
    lobe.kind = materials::ScatteringKind::mirror;
    lobe.scattering = &materials::scattering(lobe.kind);
    record_.mixed.push_back({surface, lobe});
  }
  return factor;
}

}  // namespace ifov::transport
