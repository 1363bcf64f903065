// Rays to curved surfaces whose narrow lobes throw sunlight on others, and their balance with what scattered rays find.
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/mirrors/lobe_targets.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/path_parts.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

/// Surfaces of a path that send such rays; later ones bring too little.
constexpr int kSendingSurfaces = 2;
/// Dimension pairs begin here, beyond those of any path's own and of the choice of emitters.
constexpr std::uint32_t kLobePairs = 1u << 17;

}  // namespace

bool PathTracer::look_for_lobes(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                                const geometry::SurfacePoint& hit, int depth) {
  if (depth >= kSendingSurfaces || path.medium != kNone || lobe.bsdf->is_delta() ||
      (options_.maximum_scatterings >= 0 && depth + 1 >= options_.maximum_scatterings))
    return false;
  lobe_view_->fill(lobes_->targets(), hit.position_m, sides.outward);
  return true;
}

double PathTracer::found_by_chance(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                                   bool transmitted) const {
  if (transmitted && lobe.bsdf->passage() != materials::Passage::none) return 1.0;
  const double sent = lobe_view_->density(direction);
  if (sent <= 0.0) return 1.0;
  const double found =
      side_probability(lobe, sides, transmitted) * continuation_density(lobe, sides, direction, transmitted);
  return found / (found + sent);
}

void PathTracer::send_to_lobes(const Path& path, std::uint32_t number, const scene::ResolvedSurface& surface,
                               const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                               int depth, std::uint32_t path_index) {
  const std::uint32_t pair = kLobePairs + 2u * static_cast<std::uint32_t>(depth);
  const math::Vec3 direction =
      lobe_view_->sample(sampling::sequence_point(path.key.sequence, path.key.index, pair + 1u).x,
                         sampling::sequence_point(path.key.sequence, path.key.index, pair));
  const bool transmitted = math::dot(direction, sides.outward) < 0.0;
  if (!((transmitted ? lobe.highest_transmittance : lobe.highest_reflectance) > 0.0)) return;
  if (transmitted && lobe.bsdf->passage() != materials::Passage::none) return;
  const double sent = lobe_view_->density(direction);
  const double found =
      side_probability(lobe, sides, transmitted) * continuation_density(lobe, sides, direction, transmitted);
  const double weight = scattered(lobe, sides, direction, transmitted) / (sent + found);
  if (!(weight > 0.0)) return;
  const std::uint32_t twin = fork(number);
  SurfaceEvent& event = events_.emplace_back();
  event.path = path_index;
  event.number = twin;
  event.vertex = vertex_of(surface, lobe, sides.outgoing);
  event.vertex.height_m = hit.position_m.z;
  event.vertex.emission_weight = 0.0f;
  event.vertex.continuation_weight = static_cast<float>(weight);
  event.vertex.continuation_transmitted = transmitted;
  if (PathRecord::Events* events = events_of(event.vertex))
    events->continuation = scattering(lobe, sides, direction, transmitted);
  take_factors(surface, event.vertex);
  const math::Vec3 outward = transmitted ? -sides.outward : sides.outward;
  event.next = sides.leaving(hit.position_m + hit.offset_m * outward, direction);
  event.next_chain.from_sensor = false;
  event.next_direct = false;
  event.next_medium = kNone;
  event.next_to_lobe = true;
  if (scene_.polarized()) {
    directions_.push_back({sides.outgoing, direction, sides.shading.as_vector(), nullptr});
    if (lobe.bsdf->polarizes()) directions_.back().polarizing = lobe.bsdf;
  }
}

void PathTracer::drop(const Path& path) {
  PathRecord::Path& record = record_.paths[path.number];
  record.first = record.last = PathVertex::kNone;
}

void PathTracer::meet_lobe(const Path& path, std::uint32_t path_index, int depth) {
  const geometry::SurfacePoint& hit = hits_[path_index];
  if (!hit.hit()) return drop(path);
  const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
  const SurfaceLobe lobe = surface_lobe(scene_, surface, shape_choice(path.key, surface, depth));
  if (lobe.bsdf == nullptr || !lobes_->sought(*lobe.bsdf) ||
      !(lobe.highest_reflectance + lobe.highest_transmittance > 0.0))
    return drop(path);
  const Sides sides(path.ray, hit, surface.shading_normal);
  SurfaceEvent& event = events_.emplace_back();
  event.path = path_index;
  event.number = path.number;
  event.vertex = vertex_of(surface, lobe, sides.outgoing);
  event.vertex.height_m = hit.position_m.z;
  event.vertex.emission_weight = 0.0f;
  if (scene_.polarized()) {
    directions_.push_back({sides.outgoing, {}, sides.shading.as_vector(), nullptr});
    if (lobe.bsdf->polarizes()) directions_.back().polarizing = lobe.bsdf;
  }
  const sampling::Point2 u = sampling::sequence_point(path.key.sequence, path.key.index,
                                                      1u + 2u * static_cast<std::uint32_t>(depth));
  send_to_sun(path, lobe, sides, hit, depth, u, event);
  if (mirrors_ != nullptr) {
    send_to_images(path, surface, lobe, sides, hit, depth, u);
    send_to_rounds(path, surface, lobe, sides, hit, depth, u);
  }
  // The path that goes on says what is not found.
  event.rare_sun = 0.0f;
  record_.paths[path.number].unseen = 0.0f;
  take_factors(surface, event.vertex);
}

}  // namespace ifov::transport
