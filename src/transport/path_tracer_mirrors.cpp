// Sunlight by way of mirrors: sought through the Sun's images in flat ones, and how much may come by other ways.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "materials/bsdf/narrow_lobes.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/delta_events.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/path_parts.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"
#include "transport/wide_sun.h"

namespace ifov::transport {

namespace {

/// Rays towards mirrors by way of which nothing is sought, from the first surface that scatters; others send one.
constexpr std::uint64_t kUnseenRays = 4;
/// What cannot bring more than this, in parts of the Sun's irradiance per steradian, is not sought.
constexpr double kNegligible = 1e-6;

/// Rays that a surface sends to the Sun's images in flat mirrors, and to those in round ones; where there are more
/// images, some are picked by chance.
constexpr std::size_t kMostImageRays = 8;

// What random choices are keyed by, beside their path and depth.
constexpr std::uint64_t kImageChoice = 0x696d616765ull, kUnseenChoice = 0x756e7365656eull,
                        kRoundChoice = 0x726f756e64ull;

double choice(const PathKey& key, int depth, std::uint64_t purpose, std::uint64_t number) {
  return sampling::unit_double(
      sampling::hash(key.sequence, key.index, static_cast<std::uint64_t>(depth) << 8 | number, purpose));
}

}  // namespace

void PathTracer::send_to_images(const Path& path, const scene::ResolvedSurface& surface,
                                const SurfaceLobe& lobe, const Sides& sides,
                                const geometry::SurfacePoint& hit, int depth, sampling::Point2 u) {
  if (images_.reflections() == 0) return;
  if (options_.maximum_scatterings >= 0 && depth + 1 >= options_.maximum_scatterings) return;
  const bool transmits = lobe.highest_transmittance > 0.0;
  const double slope = 1.01 * std::tan(scene_.scene().sun->half_angle_rad);
  const std::span<const SunImages::Image> images = images_.images();
  seen_images_.clear();
  for (std::uint32_t k = 0; k < images.size(); ++k)
    if ((transmits || math::dot(images[k].direction, sides.outward) > -slope) &&
        may_meet(images[k].bounds, hit.position_m, images[k].direction, slope))
      seen_images_.push_back(k);
  const std::size_t seen = seen_images_.size(), rays = std::min(seen, kMostImageRays);
  for (std::size_t k = 0; k < rays; ++k) {
    std::size_t picked = k;
    if (rays < seen) {
      const double position = (static_cast<double>(k) + choice(path.key, depth, kImageChoice, k)) *
                              static_cast<double>(seen) / static_cast<double>(rays);
      picked = std::min(seen - 1, static_cast<std::size_t>(position));
    }
    MirrorRay way;
    way.image = seen_images_[picked];
    SunRay light = sun_ray(lobe, sides, hit, images[way.image].direction, u);
    const double weight = static_cast<double>(seen) / static_cast<double>(rays);
    if (rare_lobes_ != nullptr) leave_rare(path, lobe, sides, hit, depth, light);
    send_by_mirrors(way, light, weight, surface, lobe, sides);
  }
}

void PathTracer::send_to_rounds(const Path& path, const scene::ResolvedSurface& surface,
                                const SurfaceLobe& lobe, const Sides& sides,
                                const geometry::SurfacePoint& hit, int depth, sampling::Point2 u) {
  const RoundMirrors& rounds = mirrors_->rounds();
  if (rounds.all().empty() || options_.mirror_reflections == 0) return;
  if (options_.maximum_scatterings >= 0 && depth + 1 >= options_.maximum_scatterings) return;
  const scene::Sun& sun = *scene_.scene().sun;
  // One point of the disc for all: its images differ.
  math::Vec3 towards_sun = sun.direction;
  double weight = 1.0;
  if (sun.half_angle_rad > 0.0) {
    const sampling::UniformCone disc(sun.half_angle_rad);
    const double sine = std::sin(sun.half_angle_rad);
    towards_sun = disc.sample(sun.direction, u);
    weight = disc.solid_angle_sr() / (std::numbers::pi * sine * sine);
  }
  const auto random = [&](std::size_t k) { return choice(path.key, depth, kRoundChoice, k); };
  rounds.pick(hit.position_m, kMostImageRays, random, [&](const RoundMirrors::Pick& pick) {
    const RoundMirror& round = rounds.all()[pick.round];
    const std::optional<RoundMirror::Image> image = round.image(hit.position_m, towards_sun);
    if (!image) return;
    const bool behind = math::dot(sides.outward, image->direction) < 0.0;
    const double cosine = (behind ? -1.0 : 1.0) * math::dot(sides.shading.as_vector(), image->direction);
    MirrorRay way;
    way.object = round.object();
    way.at = image->at;
    way.towards_sun = towards_sun;
    SunRay light = light_ray(lobe, sides, hit, image->direction, cosine * weight / image->spread());
    if (rare_lobes_ != nullptr) leave_rare(path, lobe, sides, hit, depth, light);
    send_by_mirrors(way, light, 1.0 / pick.expected, surface, lobe, sides);
  });
}

void PathTracer::send_by_mirrors(MirrorRay way, const SunRay& light, double weight,
                                 const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                                 const Sides& sides) {
  if (light.weight <= 0.0 || events_.back().sunlight <= 0.0f) return;
  way.event = static_cast<std::uint32_t>(events_.size() - 1);
  way.ray = light.ray;
  way.light.weight = static_cast<float>(light.weight * weight) * events_.back().sunlight;
  way.light.transmitted = light.transmitted;
  way.light.surface = surface_factor(
      surface, events_.back().vertex,
      lobe.directional ? arriving(lobe, sides, light.ray.direction, light.transmitted) : LobeEvent{},
      light.transmitted);
  mirror_rays_.push_back(way);
}

void PathTracer::trace_mirror_rays(sampling::RayCounts& counts) {
  mirror_tracer_->trace(
      mirror_rays_, counts,
      [&](MirrorRay& way, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface) {
        way.light.passes_at[way.light.count] = way.light.passes;
        way.light.mirrors[way.light.count++] = mirror_factor(surface, way.ray.direction, hit);
        way.light.height_m = hit.position_m.z;
      },
      [&](MirrorRay& way) {
        PathVertex& vertex = events_[way.event].vertex;
        way.light.next = vertex.mirrored;
        vertex.mirrored = static_cast<std::uint32_t>(record_.mirrored.size());
        record_.mirrored.push_back(way.light);
      },
      [&](const MirrorRay& way, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface,
          bool through) {
        return through && !passes_straight(scene_, surface)
                   ? 0.0
                   : highest_of_deltas(scene_, surface, delta_view(-way.ray.direction, hit, surface),
                                       through ? SurfaceLobe::Deltas::panes : SurfaceLobe::Deltas::mirrors);
      },
      [&](MirrorRay& way, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface) {
        way.light.passes = add_pass(surface, -way.ray.direction, hit, way.light.passes);
      });
}

void PathTracer::note_chain(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                            const geometry::SurfacePoint& hit, SurfaceEvent& event) {
  const double highest =
      event.vertex.continuation_transmitted ? lobe.highest_transmittance : lobe.highest_reflectance;
  Way& way = event.next_chain;
  if (!lobe.bsdf->is_delta()) {
    way = {};
    way.from_sensor = false;
    way.by_lobe = rare_lobes_ != nullptr && lobe.directional && materials::throws_rarely(*lobe.bsdf);
    way.in_medium = event.next_medium != kNone;
  } else if (event.vertex.continuation_transmitted) {
    note_passage(path, lobe, sides, hit, event);
  } else {
    way = path.way;
    // What is reflected within a medium, or came out of it bent, is not sought.
    way.broken = way.broken || way.in_medium;
    const std::uint32_t facing = mirrors_->facing_of(hit, sides.shading.as_vector());
    way.flat = way.flat && facing != SunMirrors::kNone;
    if (way.flat && way.reflections < way.facings.size())
      way.facings[way.reflections] = static_cast<std::uint16_t>(facing);
    if (way.reflections < 255) ++way.reflections;
    if (way.from_sensor) {
      const bool apart =
          options_.sought_only && way.reflections == 1 && !way.passed && mirrors_->glints_by_shape(hit);
      event.next_sees_sun = way.flat || !apart;
      way.unseen = !way.flat && !apart;
    } else {
      const bool sought =
          !way.broken &&
          (way.flat
               ? way.reflections <= images_.reflections() &&
                     images_.image_of({way.facings.data(), way.reflections}) != SunMirrors::kNone
               : way.reflections == 1 && options_.mirror_reflections > 0 && mirrors_->rounds().sought(hit));
      event.next_sees_sun = !sought && !options_.sought_only;
      // What bends and is met first is looked for by send_to_unseen.
      way.unseen = !sought && (way.unseen || way.flat || way.reflections > 1 || way.by_lobe);
    }
  }
  // What one boundary polarized another may send on up to twice as much of as of unpolarized light, but never more than arrives:
  // in a box of water light is reflected whole many times.
  const bool again = scene_.polarized() && lobe.bsdf->is_delta() && !lobe.bsdf->is_separable() &&
                     (path.way.reflections > 0 || path.way.passed);
  const double most = again ? std::max(highest, std::min(2.0 * highest, 1.0 / lobe.probability)) : highest;
  record_.paths[event.number].brightest *=
      static_cast<float>(most * continuation_grey(lobe, event.vertex)) * event.vertex.continuation_weight;
}

void PathTracer::send_to_unseen(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                                const geometry::SurfacePoint& hit, int depth) {
  const std::span<const Thrower> groups = throwers_;
  std::array<double, 2 * SunMirrors::kMostGroups> probability{};
  // A narrow lobe's own light is left to the path that goes on in it.
  const bool narrow = rare_lobes_ != nullptr && lobe.directional && materials::throws_rarely(*lobe.bsdf);
  double all = 0.0;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const double apart = math::length(groups[k].centre_m - hit.position_m), radius = groups[k].radius_m;
    probability[k] = apart > radius ? radius * radius / (apart * apart) : 1.0;
    all += probability[k];
  }
  if (all <= 0.0) return;
  const std::uint64_t rays = path.way.from_sensor ? kUnseenRays : 1;
  for (std::uint64_t k = 0; k < rays; ++k) {
    const auto random = [&](std::uint64_t number) {
      return choice(path.key, depth, kUnseenChoice, 3 * k + number);
    };
    double position = random(0) * all;
    std::size_t picked = 0;
    while (picked + 1 < groups.size() && position >= probability[picked]) position -= probability[picked++];
    const math::Vec3 towards = groups[picked].centre_m - hit.position_m;
    const double apart = math::length(towards), sine = groups[picked].radius_m / std::max(apart, 1e-300);
    const bool inside = sine >= 1.0;
    const sampling::UniformCone cone(inside ? 0.5 * std::numbers::pi : std::asin(sine));
    const math::Vec3 direction =
        cone.sample(inside ? sides.outward : towards / apart, {random(1), random(2)});
    const bool transmitted = math::dot(direction, sides.outward) < 0.0;
    const double highest = transmitted ? lobe.highest_transmittance : lobe.highest_reflectance;
    const math::Vec3 normal = transmitted ? -sides.shading.as_vector() : sides.shading.as_vector();
    const double cosine = math::dot(normal, direction);
    if (highest <= 0.0 || cosine <= 0.0) continue;
    const materials::BsdfEvent seen = sides.event(lobe, transmitted, direction);
    double weight = lobe.bsdf->shape(seen) * lobe.grey(seen) * cosine * cone.solid_angle_sr() * all /
                    probability[picked] * highest *
                    static_cast<double>(record_.paths[path.number].brightest) / static_cast<double>(rays);
    if (narrow) weight *= 1.0 - lobe.bsdf->lobe_share(seen);
    if (!(weight > kNegligible)) continue;
    const math::Vec3 outward = transmitted ? -sides.outward : sides.outward;
    unseen_rays_.push_back({static_cast<std::uint32_t>(events_.size() - 1), static_cast<float>(weight),
                            sides.leaving(hit.position_m + hit.offset_m * outward, direction)});
  }
}

double PathTracer::thrown_by_lobes(const scene::ResolvedSurface& surface, const math::Ray& ray,
                                   const geometry::SurfacePoint& hit) const {
  const Sides sides(ray, hit, surface.shading_normal);
  const math::Vec3 sun = scene_.scene().sun->direction;
  const double cosine = math::dot(sides.shading.as_vector(), sun);
  if (cosine <= 0.0 || math::dot(sides.outward, sun) <= 0.0) return 0.0;
  double thrown = 0.0;
  for (const scene::Constituent& part : surface) {
    const materials::Bsdf& bsdf = *scene_.scene().materials[part.material].bsdf;
    if (!materials::throws_rarely(bsdf)) continue;
    const materials::BsdfEvent event{sides.outgoing, sun, sides.shading, sides.tangent(),
                                     materials::Side::reflected};
    thrown +=
        part.weight * scene_.brightest(part.material) * bsdf.widened_lobe(event, SunLobes::kWidenedSlope);
  }
  return thrown * cosine;
}

void PathTracer::trace_unseen_rays(sampling::RayCounts& counts) {
  rays_.resize(unseen_rays_.size());
  hits_.resize(unseen_rays_.size());
  for (std::size_t k = 0; k < unseen_rays_.size(); ++k) rays_[k] = unseen_rays_[k].ray;
  scene_.scene().world->intersect(rays_, hits_);
  counts.shadow += rays_.size();
  rays_.clear();
  next_unseen_rays_.clear();
  for (std::size_t k = 0; k < unseen_rays_.size(); ++k) {
    UnseenRay& unseen = unseen_rays_[k];
    const geometry::SurfacePoint& hit = hits_[k];
    if (!hit.hit()) continue;
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    const math::Ray to_sun =
        unseen.ray.onward(hit.position_m + hit.offset_m * outward, scene_.scene().sun->direction);
    const double thrown = rare_lobes_ != nullptr ? thrown_by_lobes(surface, unseen.ray, hit) : 0.0;
    if (thrown > 0.0) {
      next_unseen_rays_.push_back(unseen);
      next_unseen_rays_.back().weight *= static_cast<float>(thrown);
      rays_.push_back(to_sun);
    }
    if (mirrors_ == nullptr) continue;
    if (scene_.materials().any_medium())
      record_.paths[paths_[events_[unseen.event].path].number].unseen +=
          unseen.weight * refracted_light(unseen.ray, hit, counts);
    double highest = 0.0;
    for (const scene::Constituent& part : surface)
      if (is_mirror(scene_.scene(), part)) highest += part.weight * scene_.brightest(part.material);
    const math::Vec3 normal = surface.shading_normal.as_vector();
    if (highest <= 0.0 || mirrors_->facing_of(hit, normal) != SunMirrors::kNone ||
        mirrors_->rounds().sought(hit))
      continue;
    const float arrives = WideSun::radiance(scene_.scene(), mirrored(unseen.ray.direction, normal));
    if (arrives <= 0.0f) continue;
    rays_.push_back(to_sun);
    unseen.weight *= static_cast<float>(highest) * arrives;
    next_unseen_rays_.push_back(unseen);
  }
  unseen_rays_.swap(next_unseen_rays_);
  hidden_.resize(rays_.size());
  if (!rays_.empty()) scene_.scene().world->occluded(rays_, hidden_);
  counts.shadow += rays_.size();
  for (std::size_t k = 0; k < unseen_rays_.size(); ++k)
    if (hidden_[k] == 0)
      record_.paths[paths_[events_[unseen_rays_[k].event].path].number].unseen += unseen_rays_[k].weight;
}

}  // namespace ifov::transport
