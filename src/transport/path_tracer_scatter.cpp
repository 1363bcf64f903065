// What a path does at a surface: light sought from the Sun, and where it goes on.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/bsdf/narrow_lobes.h"
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/path_parts.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/sky/sky_sampler.h"
#include "transport/spectral_scene.h"
#include "transport/surface_lobe.h"

namespace ifov::transport {

namespace {

/// Surfaces a path scatters at before it may be ended by chance, and light of its beginning that it may still bring where that is
/// worth a try: few far paths that weigh much cost more in variance than they save.
constexpr int kCertainScatterings = 2;
constexpr double kWorth = 0.1;
/// From here on each surface ends as many paths as it absorbs, at least: in a white room none would end before.
constexpr int kManyScatterings = 8;

/// What the random choice between shapes at a surface is keyed by, beside its path and depth.
constexpr std::uint64_t kShapeChoice = 0x7368617065ull;

/// Share of the directions that a level surface draws from the sky; fewer where its integral takes the open sky's part
/// (TransportOptions::sky_shares), as what is met elsewhere then weighs less: 1 / (1 - share) at most.
constexpr double kMostSkySamples = 0.6, kSkySamplesBesideIntegral = 0.3;

}  // namespace

std::uint32_t PathTracer::add_mixed(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                    math::Vec3 outgoing) {
  record_.mixed.push_back({surface, lobe, outgoing, PathVertex::kNone});
  return static_cast<std::uint32_t>(record_.mixed.size() - 1);
}

PathVertex PathTracer::vertex_of(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                 math::Vec3 outgoing) {
  PathVertex vertex;
  if (!options_.no_spectra && !scene_.is_mixed(surface)) {
    vertex.emission = scene_.emission(surface, outgoing, nullptr);
    return vertex;
  }
  vertex.mixed = add_mixed(surface, lobe, outgoing);
  if (lobe.directional) {
    record_.mixed.back().events = static_cast<std::uint32_t>(record_.events.size());
    record_.events.emplace_back();
  }
  return vertex;
}

PathRecord::Events* PathTracer::events_of(const PathVertex& vertex) {
  if (vertex.mixed == PathVertex::kNone) return nullptr;
  const std::uint32_t events = record_.mixed[vertex.mixed].events;
  return events == PathVertex::kNone ? nullptr : &record_.events[events];
}

double PathTracer::continuation_grey(const SurfaceLobe& lobe, const PathVertex& vertex) {
  const PathRecord::Events* events = events_of(vertex);
  return events == nullptr ? 1.0 : lobe.grey(events->continuation.event);
}

bool PathTracer::forks(const Path& path, const geometry::SurfacePoint& hit,
                       const scene::ResolvedSurface& surface) const {
  // Further forks are worth their rays where both sides bring much of the light.
  constexpr int kMostForks = 3;
  constexpr double kLeastOfAll = 1e-5, kLeastFurther = 0.02;
  if (!path.direct || path.forks >= kMostForks || surface.count != 1 || options_.maximum_scatterings == 0)
    return false;
  SurfaceLobe lobe = surface_lobe(scene_, surface, 0.0);
  if (!lobe.directional || !lobe.bsdf->is_delta() || !lobe.bsdf->may_transmit()) return false;
  const Sides sides(path.ray, hit, surface.shading_normal);
  narrow_to_angle(scene_, surface, sides.view(lobe, false), lobe);
  return std::min(lobe.highest_reflectance, lobe.highest_transmittance) * static_cast<double>(path.share) >
         (path.forks == 0 ? kLeastOfAll : kLeastFurther);
}

std::uint32_t PathTracer::fork(std::uint32_t number) {
  const auto twin = static_cast<std::uint32_t>(record_.paths.size());
  PathRecord::Path path = record_.paths[number];
  path.first = path.last = PathVertex::kNone;
  path.unseen = path.sky_share = 0.0f;
  record_.paths.push_back(path);
  record_.paths[number].also = twin;
  for (std::uint32_t v = record_.paths[number].first; v != PathVertex::kNone; v = record_.vertices[v].next) {
    PathVertex vertex = record_.vertices[v];
    vertex.next = PathVertex::kNone;
    vertex.emission_weight = vertex.sun_weight = vertex.sought_weight = 0.0f;
    vertex.segment_shines = false;
    vertex.mirrored = PathVertex::kNone;
    record_.add(twin, vertex);
    if (scene_.polarized()) record_.directions.push_back(PathRecord::Directions(record_.directions[v]));
  }
  return twin;
}

double PathTracer::shape_choice(const PathKey& key, const scene::ResolvedSurface& surface, int depth) {
  return surface.count > 1
             ? sampling::unit_double(sampling::hash(key.sequence, key.index, depth, kShapeChoice))
             : 0.0;
}

void PathTracer::scatter(const Path& path, std::uint32_t path_index, const scene::ResolvedSurface& surface,
                         int depth, Branch branch, std::uint32_t number) {
  SurfaceLobe lobe = surface_lobe(scene_, surface, shape_choice(path.key, surface, depth));
  const geometry::SurfacePoint& hit = hits_[path_index];
  SurfaceEvent& event = events_.emplace_back();
  event.path = path_index;
  event.number = number;
  event.vertex = vertex_of(surface, lobe, -path.ray.direction);
  event.vertex.height_m = hit.position_m.z;
  if (path.left.seek_probability > 0.0) event.vertex.emission_weight = unsought(path, hit);
  if (path.medium != kNone) event.vertex.segment = add_segment(path.medium, hit.distance_m);
  if (branch == Branch::transmitted) {
    event.vertex.emission_weight = 0.0f;
    event.vertex.segment_shines = false;
  }
  if (scene_.polarized())
    directions_.push_back({-path.ray.direction, {}, surface.shading_normal.as_vector(), nullptr});
  if (depth == options_.maximum_scatterings || lobe.highest_reflectance + lobe.highest_transmittance <= 0.0)
    return;

  const Sides sides(path.ray, hit, surface.shading_normal);
  if (lobe.directional && lobe.bsdf->is_delta()) {
    narrow_to_angle(scene_, surface, sides.view(lobe, false), lobe);
    if (lobe.highest_reflectance + lobe.highest_transmittance <= 0.0) return;
  }
  if (scene_.polarized()) {
    directions_.back().normal = sides.shading.as_vector();
    if (lobe.bsdf->polarizes()) directions_.back().polarizing = lobe.bsdf;
  }
  if (path.sunlight < 1.0f && lobes_->sought(*lobe.bsdf)) event.sunlight = path.sunlight;
  const bool to_lobes = lobes_ != nullptr && look_for_lobes(path, lobe, sides, hit, depth);
  const std::uint32_t pair = 1u + 2u * static_cast<std::uint32_t>(depth);
  if (scene_.scene().sun && !lobe.bsdf->is_delta()) {
    const sampling::Point2 u = sampling::sequence_point(path.key.sequence, path.key.index, pair);
    send_to_sun(path, lobe, sides, hit, depth, u, event);
    if (!throwers_.empty()) send_to_unseen(path, lobe, sides, hit, depth);
    if (mirrors_ != nullptr) {
      send_to_images(path, surface, lobe, sides, hit, depth, u);
      send_to_rounds(path, surface, lobe, sides, hit, depth, u);
      send_from_media(path, lobe, sides, hit, depth, surface, u);
    }
  }
  PathVertex& vertex = event.vertex;
  if (emitters_ != nullptr && depth + 1 != options_.maximum_scatterings && !lobe.bsdf->is_delta())
    seek(lobe, sides, hit, path.key, depth, event);
  const bool by_mirrors = emitter_mirrors_ != nullptr &&
                          (options_.maximum_scatterings < 0 || depth + 2 <= options_.maximum_scatterings);
  if (by_mirrors && !lobe.bsdf->is_delta()) {
    seek_by_planes(surface, lobe, sides, hit, path.key, depth, event);
    seek_by_rounds(surface, lobe, sides, hit, path.key, depth, event);
  }
  const bool may_go_on = depth + 1 != options_.maximum_scatterings,
             goes_on = may_go_on && (whole_.empty() || whole_[path_index] != 0);
  if (goes_on &&
      continue_path(lobe, sides, hit, sampling::sequence_point(path.key.sequence, path.key.index, pair + 1u),
                    branch, event)) {
    const double highest =
        vertex.continuation_transmitted ? lobe.highest_transmittance : lobe.highest_reflectance;
    const double kept = highest * vertex.continuation_weight * continuation_grey(lobe, vertex);
    event.next_share = path.share * static_cast<float>(kept);
    if (depth + 1 >= kCertainScatterings) end_by_chance(path.key, depth, kept, event);
  }
  // Also of paths that end here, because the direction that was drawn from the sky lies below the surface.
  if (const float share = may_go_on ? open_sky_share(surface, lobe, sides, branch, depth) : 0.0f;
      share > 0.0f) {
    record_.paths[number].sky_share = share;
    record_.paths[number].first_normal = sides.outward;
    record_.paths[number].left_first = event.next.direction;
  }
  if (to_lobes && vertex.continuation_weight > 0.0f)
    event.next_sunlight = static_cast<float>(
        found_by_chance(lobe, sides, event.next.direction, vertex.continuation_transmitted));
  if (passages_ && vertex.continuation_weight > 0.0f) {
    const bool delta = lobe.bsdf->is_delta(), transmitted = vertex.continuation_transmitted;
    event.next_medium = transmitted ? medium_after(path.medium, lobe, surface) : path.medium;
    // Media within others, and sensors within one, are not followed: the pixel may lack, or hold, what a white surface shows.
    const materials::Passage passage = lobe.bsdf->passage();
    if (transmitted && ((passage == materials::Passage::into && path.medium != kNone) ||
                        (passage == materials::Passage::out_of && path.medium == kNone)))
      record_.paths[event.number].unseen +=
          path.share * static_cast<float>(lobe.highest_transmittance / std::numbers::pi);
    event.next_direct = path.direct && delta;
    event.next_forks = static_cast<std::uint8_t>(path.forks + (branch == Branch::by_chance ? 0 : 1));
    // A pane changes nothing of how emitters were sought straight.
    if (delta && transmitted && lobe.bsdf->passage() == materials::Passage::straight &&
        path.left.round == kNone && (!path.left.unfolded || path.left.by_pane)) {
      event.left = path.left;
      event.left.unfolded = event.left.by_pane = true;
      event.left.mirror_probability = 0.0;
      event.left.by_rounds = false;
    }
  }
  if (scene_.polarized()) directions_.back().incoming = event.next.direction;
  if (by_mirrors && vertex.continuation_weight > 0.0f) {
    if (!lobe.bsdf->is_delta()) {
      event.left.mirror_probability = lobe.highest_transmittance > 0.0 ? 0.0 : mirror_probability();
      event.left.by_rounds = !emitter_mirrors_->rounds().all().empty();
    } else if (!vertex.continuation_transmitted) {
      event.left = by_mirror(path.left, hit, surface);
    }
  }
  if (options_.separate_images != nullptr && depth == 0 && lobe.bsdf->is_delta() &&
      !vertex.continuation_transmitted)
    event.next_mirror = options_.separate_images->mirror_of(hit, surface.shading_normal.as_vector());
  if ((mirrors_ != nullptr || rare_lobes_ != nullptr) && vertex.continuation_weight > 0.0f)
    note_chain(path, lobe, sides, hit, event);
  take_factors(surface, vertex);
  if (to_lobes && goes_on) send_to_lobes(path, number, surface, lobe, sides, hit, depth, path_index);
}

void PathTracer::end_by_chance(const PathKey& key, int depth, double kept, SurfaceEvent& event) {
  const double worth = static_cast<double>(event.next_share) / kWorth;
  const auto probability =
      static_cast<float>(std::min(1.0, depth + 1 < kManyScatterings ? worth : std::min(kept, worth)));
  if (!(sampling::unit_double(sampling::hash(key.sequence, key.index, depth)) < probability)) {
    event.vertex.continuation_weight = 0.0f;
    return;
  }
  event.vertex.continuation_weight /= probability;
  event.next_share /= probability;
}

float PathTracer::open_sky_share(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                 const Sides& sides, Branch branch, int depth) const {
  const bool possible = depth == 0 && options_.sky_shares != nullptr && sky_ != nullptr &&
                        branch == Branch::by_chance && !sides.perturbed;
  if (!possible || lobe.highest_transmittance > 0.0 || !lobe.bsdf->is_lambertian()) return 0.0f;
  return (*options_.sky_shares)[surface.constituents[0].material];
}

void PathTracer::take_factors(const scene::ResolvedSurface& surface, PathVertex& vertex) const {
  if (vertex.mixed != PathVertex::kNone) return;
  const std::uint32_t material = surface.constituents[0].material;
  const auto factor = [&](bool transmitted) {
    return transmitted ? scene_.materials().transmittance(material)
                       : scene_.materials().reflectance(material);
  };
  vertex.sun_factor = factor(vertex.sun_transmitted);
  vertex.sought_factor = factor(vertex.sought_transmitted);
  vertex.continuation_factor = factor(vertex.continuation_transmitted);
}

double PathTracer::sunlight_share(const SurfaceLobe& lobe, const Sides& sides,
                                  const geometry::SurfacePoint& hit, int depth, math::Vec3 direction,
                                  bool transmitted) const {
  using Highlights = TransportOptions::Highlights;
  if (options_.highlights == Highlights::found || scene_.sun_lobes() == nullptr) return 1.0;
  const std::vector<std::uint32_t>* large = options_.large_lobes;
  const bool apart = depth == 0 && lobe.directional && scene_.sun_lobes()->by_shape(hit) &&
                     (large == nullptr || !std::binary_search(large->begin(), large->end(), hit.instance));
  const double highlight =
      apart ? SunLobes::seen_share(*lobe.bsdf, sides.event(lobe, transmitted, direction)) : 0.0;
  return options_.highlights == Highlights::alone ? highlight : 1.0 - highlight;
}

PathTracer::RareSunlight PathTracer::rare_sunlight(const Path& path, const SurfaceLobe& lobe,
                                                   const Sides& sides, const geometry::SurfacePoint& hit,
                                                   int depth, math::Vec3 direction, bool transmitted,
                                                   bool by_mirror) const {
  if (rare_lobes_ == nullptr || transmitted || !lobe.directional || !materials::throws_rarely(*lobe.bsdf))
    return {};
  const bool bends = rare_lobes_->bends(hit);
  if (depth == 0 && !by_mirror) {
    // Pixels resolve what is flat, shapes are searched for what is not; reliefs keep what paths find.
    if (!bends) return {};
    const std::vector<std::uint32_t>* unsure = options_.unsure_lobes;
    if (options_.highlights != TransportOptions::Highlights::found && rare_lobes_->by_shape(hit) &&
        (unsure == nullptr || !std::binary_search(unsure->begin(), unsure->end(), hit.instance)))
      return {};
  } else if (!bends && mirrors_ != nullptr && path.way.from_sensor && path.way.flat) {
    return {};
  }
  const materials::BsdfEvent event = sides.event(lobe, transmitted, direction);
  RareSunlight rare;
  if (options_.sought_only && (depth > 0 || by_mirror)) rare.share = SunLobes::share(*lobe.bsdf, event);
  // What is sent to what throws light tells of the first surface that is met from one without a narrow lobe.
  if (by_mirror || path.way.from_sensor || path.way.by_lobe || path.way.passed || path.way.reflections > 0)
    rare.widened = lobe.bsdf->widened_lobe(event, SunLobes::kWidenedSlope);
  return rare;
}

void PathTracer::leave_rare(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                            const geometry::SurfacePoint& hit, int depth, SunRay& light) {
  if (light.weight <= 0.0) return;
  const RareSunlight rare =
      rare_sunlight(path, lobe, sides, hit, depth, light.ray.direction, light.transmitted, true);
  record_.paths[path.number].unseen +=
      static_cast<float>(light.weight * rare.widened * lobe.highest_reflectance) *
      record_.paths[path.number].brightest;
  light.weight *= 1.0 - rare.share;
}

void PathTracer::send_to_sun(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                             const geometry::SurfacePoint& hit, int depth, sampling::Point2 u,
                             SurfaceEvent& event) {
  SunRay light = sun_ray(lobe, sides, hit, scene_.scene().sun->direction, u);
  if (light.weight <= 0.0) return;
  const RareSunlight rare =
      rare_sunlight(path, lobe, sides, hit, depth, light.ray.direction, light.transmitted, false);
  event.rare_sun = static_cast<float>(light.weight * rare.widened * lobe.highest_reflectance) *
                   record_.paths[event.number].brightest;
  light.weight *=
      sunlight_share(lobe, sides, hit, depth, light.ray.direction, light.transmitted) * (1.0 - rare.share);
  if (light.weight <= 0.0 && event.rare_sun <= 0.0f) return;
  if (PathRecord::Events* events = events_of(event.vertex))
    events->sun = arriving(lobe, sides, light.ray.direction, light.transmitted);
  event.vertex.sun_weight = static_cast<float>(light.weight) * event.sunlight;
  event.vertex.sun_transmitted = light.transmitted;
  event.sun_outside = light.transmitted && lobe.bsdf->passage() == materials::Passage::out_of;
  event.shadow = static_cast<std::uint32_t>(shadow_rays_.size());
  shadow_rays_.push_back(light.ray);
}

PathTracer::SunRay PathTracer::sun_ray(const SurfaceLobe& lobe, const Sides& sides,
                                       const geometry::SurfacePoint& hit, math::Vec3 towards_sun,
                                       sampling::Point2 u) const {
  const bool transmits = lobe.highest_transmittance > 0.0;
  const bool behind = transmits && math::dot(sides.outward, towards_sun) < 0.0;
  // In a medium sunlight comes bent.
  if (behind && lobe.bsdf->passage() == materials::Passage::into) return {};
  const math::Vec3 lit_side = behind ? -sides.shading.as_vector() : sides.shading.as_vector();
  const sampling::LightSample light = sample_sun(towards_sun, lit_side, transmits && !sides.perturbed, u);
  return light_ray(lobe, sides, hit, light.direction, light.weight_sr);
}

PathTracer::SunRay PathTracer::light_ray(const SurfaceLobe& lobe, const Sides& sides,
                                         const geometry::SurfacePoint& hit, math::Vec3 direction,
                                         double weight_sr) const {
  const double height = math::dot(direction, sides.outward);
  const bool transmitted = lobe.highest_transmittance > 0.0 && height < 0.0;
  if (weight_sr <= 0.0 || (transmitted ? height >= 0.0 : height <= 0.0)) return {};

  // Light that a bent normal would take from below the surface comes mirrored from above it.
  materials::BsdfEvent event = sides.event(lobe, transmitted, direction);
  double weight = weight_sr * lobe.bsdf->shape(event);
  if (sides.perturbed && !lobe.directional) {
    const double own = event.incoming_cosine();
    event.incoming = mirrored(direction, sides.outward);
    const double below = event.incoming_cosine();
    if (own > 0.0 && below > 0.0) weight += weight_sr * lobe.bsdf->shape(event) * below / own;
  }
  return {
      sides.leaving(hit.position_m + (transmitted ? -hit.offset_m : hit.offset_m) * sides.outward, direction),
      weight, transmitted};
}

LobeEvent PathTracer::arriving(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                               bool transmitted) {
  LobeEvent event = scattering(lobe, sides, direction, transmitted);
  event.image_weight = event.weight > 0.0f ? event.image_weight / event.weight : 0.0f;
  event.weight = 1.0f;
  return event;
}

LobeEvent PathTracer::scattering(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                                 bool transmitted) {
  LobeEvent event{sides.event(lobe, transmitted, direction), {}, 0.0f, 0.0f};
  event.weight = static_cast<float>(std::max(0.0, event.event.incoming_cosine()));
  if (!sides.perturbed) return event;
  materials::BsdfEvent other = event.event;
  event.image = other.incoming = mirrored(direction, sides.outward);
  event.image_weight = static_cast<float>(std::max(0.0, other.incoming_cosine()));
  return event;
}

double PathTracer::side_probability(const SurfaceLobe& lobe, const Sides& sides, bool transmitted) {
  if (lobe.highest_transmittance <= 0.0) return transmitted ? 0.0 : 1.0;
  const double through = lobe.bsdf->through_share(sides.view(lobe, false));
  const double reflected =
      through >= 0.0 ? 1.0 - through
                     : lobe.highest_reflectance / (lobe.highest_reflectance + lobe.highest_transmittance);
  return transmitted ? 1.0 - reflected : reflected;
}

bool PathTracer::continue_path(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                               sampling::Point2 u, Branch branch, SurfaceEvent& event) {
  // The side is chosen so that no node's weight outgrows the sum of the two highest factors.
  double probability = 1.0;
  bool transmitted = false;
  if (branch != Branch::by_chance) {
    transmitted = branch == Branch::transmitted;
  } else if (lobe.highest_transmittance > 0.0) {
    probability = side_probability(lobe, sides, false);
    transmitted = !(u.x < probability);
    u.x = transmitted ? (u.x - probability) / (1.0 - probability) : u.x / probability;
    if (transmitted) probability = 1.0 - probability;
  }
  const math::Vec3 outward = transmitted ? -sides.outward : sides.outward;
  const materials::BsdfEvent view = sides.view(lobe, transmitted);
  materials::BsdfSample sample = sample_continuation(*lobe.bsdf, view, sides.perturbed, u);
  if (PathRecord::Events* events = events_of(event.vertex)) {
    events->continuation.event = view;
    events->continuation.event.incoming = sample.incoming;
  }
  if (sides.perturbed && math::dot(sample.incoming, outward) < 0.0)
    sample.incoming = mirrored(sample.incoming, outward);
  if (!(sample.weight > 0.0) || !(math::dot(sample.incoming, outward) > 0.0)) return false;
  event.vertex.continuation_weight = static_cast<float>(sample.weight / probability);
  event.vertex.continuation_transmitted = transmitted;
  event.next = sides.leaving(hit.position_m + hit.offset_m * outward, sample.incoming);
  event.next_sees_sun = lobe.bsdf->is_delta();
  if (emitters_ != nullptr) leave(lobe, sides, transmitted, probability, event);
  return true;
}

/// Under a sky that is brighter here than there, some directions are drawn from the sky and all weigh by the
/// density of both (Veach and Guibas 1995, one sample, balance heuristic): those that see the sky weigh
/// almost alike.
materials::BsdfSample PathTracer::sample_continuation(const materials::Bsdf& bsdf,
                                                      const materials::BsdfEvent& view, bool perturbed,
                                                      sampling::Point2 u) const {
  const double share = sky_share(bsdf, view, perturbed);
  if (share == 0.0) return bsdf.sample(view, u.x, u.y);
  materials::BsdfSample sample;
  if (u.x < share)
    sample.incoming = sky_->sample({u.x / share, u.y});
  else
    sample = bsdf.sample(view, (u.x - share) / (1.0 - share), u.y);
  materials::BsdfEvent event = view;
  event.incoming = sample.incoming;
  const double cosine = event.incoming_cosine();
  sample.pdf = (1.0 - share) * bsdf.pdf(event) + share * sky_->density(sample.incoming);
  sample.weight = cosine > 0.0 && sample.pdf > 0.0 ? bsdf.shape(event) * cosine / sample.pdf : 0.0;
  return sample;
}

double PathTracer::sky_share(const materials::Bsdf& bsdf, const materials::BsdfEvent& view,
                             bool perturbed) const {
  const double height = view.side == materials::Side::reflected ? view.normal.z : -view.normal.z;
  if (sky_ == nullptr || perturbed || bsdf.is_delta() || height <= 0.0) return 0.0;
  return (options_.sky_shares != nullptr ? kSkySamplesBesideIntegral : kMostSkySamples) * height * height;
}

sampling::LightSample PathTracer::sample_sun(math::Vec3 towards_sun, math::Vec3 normal, bool either_side,
                                             sampling::Point2 u) const {
  // Weights are relative to the irradiance of a surface that faces the Sun.
  const scene::Sun& sun = *scene_.scene().sun;
  if (sun.half_angle_rad <= 0.0) return {towards_sun, std::max(0.0, math::dot(towards_sun, normal))};
  sampling::LightSample sample = disc_->sample(towards_sun, normal, u);
  const double sine = std::sin(sun.half_angle_rad);
  // Cut by the horizon, the disc is sampled whole: what is below lights the other side.
  if (either_side && !disc_->uncut(towards_sun, normal))
    sample.weight_sr = disc_->solid_angle_sr() * std::abs(math::dot(sample.direction, normal));
  sample.weight_sr /= std::numbers::pi * sine * sine;
  return sample;
}

}  // namespace ifov::transport
