// Light that is sought from emitters by way of one mirror, flat or round.
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/world.h"
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/delta_events.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/mirror_paths.h"
#include "transport/path_parts.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

/// Dimension pairs of the choice of a point begin here, beyond those of any path's own and of emitters sought straight.
constexpr std::uint32_t kMirrorSeekPairs = 1u << 18, kRoundSeekPairs = 1u << 19;
/// Planes of mirrors, and round mirrors, by way of which a surface seeks; where there are more, some are picked by chance.
constexpr std::size_t kMostPlanes = 4, kMostRounds = 2;

}  // namespace

double PathTracer::mirror_probability() const {
  const std::size_t planes = emitter_mirrors_->count();
  return planes == 0 ? 0.0 : static_cast<double>(std::min(planes, kMostPlanes)) / static_cast<double>(planes);
}

/// A mirror shows an emitter where its image stands, so that the surface's image behind the mirror sees the emitter
/// itself: light is sought for that.
void PathTracer::seek_by_planes(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                const Sides& sides, const geometry::SurfacePoint& hit, const PathKey& key,
                                int depth, SurfaceEvent& event) {
  if (lobe.highest_transmittance > 0.0) return;
  const std::size_t planes = emitter_mirrors_->count(), rays = std::min(planes, kMostPlanes);
  const Receiver receiver{hit.position_m + hit.offset_m * sides.outward, sides.outward};
  for (std::size_t k = 0; k < rays; ++k) {
    const std::uint32_t pair =
        kMirrorSeekPairs + static_cast<std::uint32_t>(2 * kMostPlanes) * static_cast<std::uint32_t>(depth) +
        2u * static_cast<std::uint32_t>(k);
    std::size_t picked = k;
    if (rays < planes) {
      const double position = sampling::sequence_point(key.sequence, key.index, pair + 1u).x;
      picked = std::min(planes - 1,
                        static_cast<std::size_t>((static_cast<double>(k) + position) *
                                                 static_cast<double>(planes) / static_cast<double>(rays)));
    }
    MirrorSeek seek;
    seek.plane = static_cast<std::uint32_t>(picked);
    const Receiver image = emitter_mirrors_->behind(seek.plane, receiver);
    const Emitters::Aim aim = emitters_->aim(image, sampling::sequence_point(key.sequence, key.index, pair));
    if (!(aim.density > 0.0)) continue;
    seek.piece = aim;
    seek.onward = aim.direction;
    const math::Vec3 direction = emitter_mirrors_->mirrored(seek.plane, aim.direction);
    if (!(math::dot(direction, receiver.normal) > 0.0)) continue;
    const double density = aim.density * mirror_probability();
    if (!(density > continuation_density(lobe, sides, direction, false))) continue;
    seek.light.weight = static_cast<float>(scattered(lobe, sides, direction, false) / density);
    if (!(seek.light.weight > 0.0f)) continue;
    seek.event = static_cast<std::uint32_t>(events_.size() - 1);
    seek.ray = sides.leaving(receiver.at_m, direction);
    seek.light.surface =
        surface_factor(surface, event.vertex,
                       lobe.directional ? scattering(lobe, sides, direction, false) : LobeEvent{}, false);
    mirror_seeks_.push_back(seek);
  }
}

/// In a round mirror an emitter's point has one image.
void PathTracer::seek_by_rounds(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                const Sides& sides, const geometry::SurfacePoint& hit, const PathKey& key,
                                int depth, SurfaceEvent& event) {
  const RoundMirrors& rounds = emitter_mirrors_->rounds();
  const std::uint32_t first =
      kRoundSeekPairs + static_cast<std::uint32_t>(2 * kMostRounds) * static_cast<std::uint32_t>(depth);
  const auto numbers = [&](std::size_t k) {
    return sampling::sequence_point(key.sequence, key.index, first + static_cast<std::uint32_t>(k));
  };
  const double reflected = lobe.highest_reflectance / (lobe.highest_reflectance + lobe.highest_transmittance);
  std::uint32_t number = kMostRounds;
  rounds.pick(
      hit.position_m, kMostRounds, [&](std::size_t k) { return numbers(k).x; },
      [&](const RoundMirrors::Pick& pick) {
        const RoundMirror& round = rounds.all()[pick.round];
        const Emitters::Point point = emitters_->point({round.middle_m(), {}}, numbers(number++));
        if (!(point.density > 0.0)) return;
        const std::optional<RoundMirror::Image> image = round.image_of(hit.position_m, point.at_m);
        if (!image) return;
        const double height = math::dot(image->direction, sides.outward);
        const bool transmitted = height < 0.0;
        if (height == 0.0 || (transmitted && !(lobe.highest_transmittance > 0.0))) return;
        const double facing = std::max(kGrazing, std::abs(math::dot(point.normal, image->onward)));
        const double density =
            pick.expected * point.density * image->area_m2(math::length(point.at_m - image->at)) / facing;
        if (!(density > (transmitted ? 1.0 - reflected : reflected) *
                            continuation_density(lobe, sides, image->direction, transmitted)))
          return;
        MirrorSeek seek;
        seek.light.weight =
            static_cast<float>(scattered(lobe, sides, image->direction, transmitted) / density);
        if (!(seek.light.weight > 0.0f)) return;
        seek.light.transmitted = transmitted;
        seek.piece = point;
        seek.round = static_cast<std::uint32_t>(pick.round);
        seek.at = image->at;
        seek.light_at = point.at_m;
        seek.event = static_cast<std::uint32_t>(events_.size() - 1);
        seek.ray = sides.leaving(
            hit.position_m + (transmitted ? -hit.offset_m : hit.offset_m) * sides.outward, image->direction);
        seek.light.surface = surface_factor(
            surface, event.vertex,
            lobe.directional ? scattering(lobe, sides, image->direction, transmitted) : LobeEvent{},
            transmitted);
        mirror_seeks_.push_back(seek);
      });
}

/// Turns the ray towards the emitter where it met the mirror that it was sent to.
bool PathTracer::reflects(MirrorSeek& seek, const geometry::SurfacePoint& hit,
                          const scene::ResolvedSurface& surface) {
  const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
  const math::Point3 from = hit.position_m + hit.offset_m * outward;
  if (seek.round == kNone) {
    if (emitter_mirrors_->plane_of(hit, surface.shading_normal.as_vector()) != seek.plane) return false;
    seek.ray = seek.ray.onward(from, seek.onward);
    return true;
  }
  const RoundMirrors& rounds = emitter_mirrors_->rounds();
  if (hit.instance != rounds.all()[seek.round].object() || !rounds.sought(hit) || !is_at(hit, seek.at))
    return false;
  seek.ray = seek.ray.onward(from, math::normalized(seek.light_at - from));
  return true;
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
    if (!shows_mirror(surface) || !reflects(seek, hit, surface)) continue;
    seek.light.passes_at[seek.light.count] = seek.light.passes;
    seek.light.mirrors[seek.light.count++] = mirror_factor(surface, seek.ray.direction, hit);
    mirror_seeks_[kept++] = seek;
  }
  mirror_seeks_.resize(kept);
  trace();
  for (std::size_t k = 0; k < mirror_seeks_.size(); ++k) {
    MirrorSeek& seek = mirror_seeks_[k];
    const geometry::SurfacePoint& hit = seek_hits_[k];
    if (!emitters_->is(seek.piece, hit) || (seek.round != kNone && !is_at(hit, seek.light_at))) continue;
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    seek.light.emitted = true;
    const math::Vec3 outgoing = -seek.ray.direction;
    if (scene_.is_mixed(surface))
      seek.light.emission_mixed = add_mixed(surface, SurfaceLobe{}, outgoing);
    else
      seek.light.emission = scene_.emission(surface, outgoing, nullptr);
    PathVertex& vertex = events_[seek.event].vertex;
    seek.light.next = vertex.mirrored;
    vertex.mirrored = static_cast<std::uint32_t>(record_.mirrored.size());
    record_.mirrored.push_back(seek.light);
  }
}

PathTracer::Departure PathTracer::by_mirror(const Departure& left, const geometry::SurfacePoint& hit,
                                            const scene::ResolvedSurface& surface) const {
  Departure next;
  if (left.mirror_probability > 0.0) {
    // The next segment is seen from behind the mirror.
    const std::uint32_t plane = emitter_mirrors_->plane_of(hit, surface.shading_normal.as_vector());
    if (plane != EmitterMirrors::kNone) {
      next.receiver = emitter_mirrors_->behind(plane, left.receiver);
      next.density = left.density;
      next.seek_probability = left.mirror_probability;
      next.unfolded = true;
      return next;
    }
  }
  if (!left.by_rounds) return next;
  const RoundMirrors& rounds = emitter_mirrors_->rounds();
  if (const std::optional<RoundMirrors::Met> met = rounds.met(left.receiver.at_m, hit)) {
    next.receiver = {rounds.all()[met->round].middle_m(), {}};
    next.density = left.density;
    next.seek_probability = rounds.expected(left.receiver.at_m, kMostRounds, met->round);
    next.round = static_cast<std::uint32_t>(met->round);
    std::copy_n(met->image.widens, 3, next.widens.begin());
  }
  return next;
}

bool PathTracer::shows_mirror(const scene::ResolvedSurface& surface) const {
  return std::any_of(surface.begin(), surface.end(),
                     [&](const scene::Constituent& part) { return is_mirror(scene_.scene(), part); });
}

PathRecord::Mirrored::Factor PathTracer::mirror_factor(const scene::ResolvedSurface& surface, math::Vec3 away,
                                                       const geometry::SurfacePoint& hit) {
  PathRecord::Mirrored::Factor factor;
  if (surface.count == 1 && !scene_.polarized() &&
      scene_.materials().directional(surface.constituents[0].material) == nullptr) {
    factor.spectrum = scene_.materials().reflectance(surface.constituents[0].material);
    return factor;
  }
  return delta_factor(surface, away, hit, SurfaceLobe::Deltas::mirrors);
}

PathRecord::Mirrored::Factor PathTracer::delta_factor(const scene::ResolvedSurface& surface, math::Vec3 away,
                                                      const geometry::SurfacePoint& hit,
                                                      SurfaceLobe::Deltas deltas) {
  PathRecord::Mirrored::Factor factor;
  SurfaceLobe lobe;
  lobe.deltas = deltas;
  factor.mixed = add_mixed(surface, lobe, {});
  LobeEvent event;
  event.event = delta_view(away, hit, surface);
  if (deltas == SurfaceLobe::Deltas::panes) event.event.side = materials::Side::transmitted;
  factor.event = static_cast<std::uint32_t>(record_.way_events.size());
  record_.way_events.push_back(event);
  return factor;
}

PathRecord::Mirrored::Factor PathTracer::surface_factor(const scene::ResolvedSurface& surface,
                                                        const PathVertex& vertex, const LobeEvent& event,
                                                        bool transmitted) {
  PathRecord::Mirrored::Factor factor;
  factor.mixed = vertex.mixed;
  if (vertex.mixed == PathVertex::kNone) {
    const std::uint32_t material = surface.constituents[0].material;
    factor.spectrum =
        transmitted ? scene_.materials().transmittance(material) : scene_.materials().reflectance(material);
  } else if (record_.mixed[vertex.mixed].lobe.directional) {
    factor.event = static_cast<std::uint32_t>(record_.way_events.size());
    record_.way_events.push_back(event);
  }
  return factor;
}

}  // namespace ifov::transport
