// Light that comes through panes and media: rays that look for it, and paths that go on.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "math/vec3.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/delta_events.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/path_parts.h"
#include "transport/path_sides.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"
#include "transport/wide_sun.h"

namespace ifov::transport {

namespace {

using materials::Passage;

/// Surfaces that a ray to the Sun may pass; less than this of the light is left out before.
constexpr int kMostPassed = 256;
constexpr double kLeastShare = 1e-6;

/// Directions that are one: parallel faces of a solid change none, but for rounding.
constexpr double kSameDirection = 2e-6;

/// Flat faces of media through which sunlight is sought from one surface within.
constexpr std::size_t kMostFaceRays = 8;
constexpr std::uint64_t kFaceChoice = 0x66616365ull;

/// What a whole surface is by the first of its constituents: boundaries of media do not stand side by side with others.
const materials::Bsdf& first_bsdf(const scene::Scene& scene, const scene::ResolvedSurface& surface) {
  return *scene.materials[surface.constituents[0].material].bsdf;
}

bool bounds_medium(const materials::Bsdf& bsdf) {
  return bsdf.passage() == Passage::into || bsdf.passage() == Passage::out_of;
}

}  // namespace

std::uint32_t PathTracer::add_pass(const scene::ResolvedSurface& surface, math::Vec3 away,
                                   const geometry::SurfacePoint& hit, std::uint32_t next) {
  PathRecord::Pass pass;
  pass.factor = delta_factor(surface, away, hit, SurfaceLobe::Deltas::panes);
  pass.next = next;
  record_.passes.push_back(pass);
  return static_cast<std::uint32_t>(record_.passes.size() - 1);
}

std::uint32_t PathTracer::add_segment(std::uint32_t medium, double length_m) {
  const scene::Constituent& of = media_[medium];
  if (scene_.absorption(of.material) == nullptr) return PathVertex::kNone;
  record_.segments.push_back({of, length_m});
  return static_cast<std::uint32_t>(record_.segments.size() - 1);
}

std::uint32_t PathTracer::medium_after(std::uint32_t before, const SurfaceLobe& lobe,
                                       const scene::ResolvedSurface& surface) {
  switch (lobe.bsdf->passage()) {
    case Passage::none:
    case Passage::straight: return before;
    case Passage::out_of: return kNone;
    case Passage::into: break;
  }
  for (const scene::Constituent& part : surface)
    if (scene_.scene().materials[part.material].bsdf.get() == lobe.bsdf) media_.push_back(part);
  return static_cast<std::uint32_t>(media_.size() - 1);
}

void PathTracer::note_passage(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                              const geometry::SurfacePoint& hit, SurfaceEvent& event) {
  Way& way = event.next_chain;
  way = path.way;
  way.passed = true;
  const Passage passage = lobe.bsdf->passage();
  if (passage == Passage::straight) {
    event.next_sees_sun = path.sees_sun;
    if (way.from_sensor && !path.sees_sun) {
      // A glint behind a pane is not found by its shape.
      event.next_sees_sun = true;
      way.unseen = true;
    }
    return;
  }
  const bool flat = mirrors_->facing_of(hit, sides.shading.as_vector()) != SunMirrors::kNone;
  if (passage == Passage::into) {
    way.broken = way.broken || !flat || way.reflections > 0;
    way.entered = true;
    way.in_medium = true;
    way.outside = path.ray.direction;
  } else {
    const bool parallel = math::length(event.next.direction - way.outside) < kSameDirection;
    way.broken = way.broken || !flat || way.reflections > 0 || (way.entered && !parallel);
    way.entered = way.in_medium = false;
  }
  if (!way.broken) {
    event.next_sees_sun = path.sees_sun;
    return;
  }
  way.flat = false;
  way.unseen = true;
  event.next_sees_sun = way.from_sensor || !options_.sought_only;
}

void PathTracer::pass_shadow_rays(sampling::RayCounts& counts) {
  for (std::uint32_t e = 0; e < events_.size(); ++e) {
    const SurfaceEvent& event = events_[e];
    if (event.shadow == kNone || blocked_[event.shadow] == 0) continue;
    PassingRay way;
    way.event = e;
    way.ray = shadow_rays_[event.shadow];
    way.towards = way.ray.direction;
    way.medium = event.sun_outside ? kNone : paths_[event.path].medium;
    passing_rays_.push_back(way);
  }
  if (!passing_rays_.empty()) trace_passing(counts);
}

/// Turns a ray to where it goes on behind a surface; false where that blocks it.
bool PathTracer::pass(PassingRay& way, const geometry::SurfacePoint& hit,
                      const scene::ResolvedSurface& surface) {
  if (way.medium != kNone) {
    const std::uint32_t segment = add_segment(way.medium, hit.distance_m);
    if (segment != PathVertex::kNone) {
      record_.passes.push_back({{}, segment, way.passes});
      way.passes = static_cast<std::uint32_t>(record_.passes.size() - 1);
    }
  }
  const math::Vec3 away = -way.ray.direction;
  materials::BsdfEvent view = delta_view(away, hit, surface);
  if (passes_straight(scene_, surface)) {
    way.share *= highest_of_deltas(scene_, surface, view, SurfaceLobe::Deltas::panes);
    if (!(way.share > kLeastShare)) return false;
    way.passes = add_pass(surface, away, hit, way.passes);
    way.ray = way.ray.onward(beyond_surface(hit), way.ray.direction);
    return true;
  }
  const materials::Bsdf& bsdf = first_bsdf(scene_.scene(), surface);
  if (surface.count != 1 || !bsdf.is_delta() || !bounds_medium(bsdf) || mirrors_ == nullptr ||
      mirrors_->facing_of(hit, surface.shading_normal.as_vector()) == SunMirrors::kNone)
    return false;
  view.side = materials::Side::transmitted;
  const materials::BsdfSample sample = bsdf.sample(view, 0.5, 0.5);
  SurfaceLobe lobe = surface_lobe(scene_, surface, 0.0);
  narrow_to_angle(scene_, surface, view, lobe);
  way.share *= lobe.highest_transmittance;
  if (!(sample.weight > 0.0) || !(way.share > kLeastShare)) return false;
  PathRecord::Pass passed;
  passed.factor.mixed = add_mixed(surface, lobe, {});
  passed.factor.event = static_cast<std::uint32_t>(record_.way_events.size());
  view.incoming = sample.incoming;
  LobeEvent kept;
  kept.event = view;
  record_.way_events.push_back(kept);
  passed.next = way.passes;
  record_.passes.push_back(passed);
  way.passes = static_cast<std::uint32_t>(record_.passes.size() - 1);
  way.medium = medium_after(way.medium, lobe, surface);
  way.ray = way.ray.onward(beyond_surface(hit), sample.incoming);
  return true;
}

void PathTracer::trace_passing(sampling::RayCounts& counts) {
  for (int hits = 0; hits < kMostPassed && !passing_rays_.empty(); ++hits) {
    rays_.resize(passing_rays_.size());
    seek_hits_.resize(passing_rays_.size());
    for (std::size_t k = 0; k < rays_.size(); ++k) rays_[k] = passing_rays_[k].ray;
    scene_.scene().world->intersect(rays_, seek_hits_);
    counts.shadow += rays_.size();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < passing_rays_.size(); ++k) {
      PassingRay& way = passing_rays_[k];
      const geometry::SurfacePoint& hit = seek_hits_[k];
      if (hit.hit()) {
        if (pass(way, hit, scene_.scene().resolve(hit))) passing_rays_[kept++] = way;
        continue;
      }
      if (way.medium != kNone || !(math::length(way.ray.direction - way.towards) < kSameDirection)) continue;
      SurfaceEvent& event = events_[way.event];
      if (way.light == kNone) {
        event.vertex.sun_passes = way.passes;
        blocked_[event.shadow] = 0;
      } else {
        PathRecord::Mirrored light = sunken_[way.light];
        light.passes = way.passes;
        light.height_m = way.ray.origin_m.z;
        light.next = event.vertex.mirrored;
        event.vertex.mirrored = static_cast<std::uint32_t>(record_.mirrored.size());
        record_.mirrored.push_back(light);
      }
    }
    passing_rays_.resize(kept);
  }
  passing_rays_.clear();
}

void PathTracer::send_from_media(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                                 const geometry::SurfacePoint& hit, int depth,
                                 const scene::ResolvedSurface& surface, sampling::Point2 u) {
  const Passage passage = lobe.bsdf->passage();
  const auto send = [&](std::uint32_t medium, MediumSides which) {
    send_from_medium(path, lobe, sides, hit, depth, surface, u, medium, which);
  };
  // A rough boundary has its medium on one side alone.
  if (passage == Passage::into)
    send(medium_after(path.medium, lobe, surface), MediumSides::behind);
  else if (path.medium != kNone)
    send(path.medium, passage == Passage::out_of ? MediumSides::before : MediumSides::both);
}

/// A flat boundary of normal N shows the Sun from within at d = s_t / n + N sqrt(1 - s_t^2 / n^2), s_t what of its direction lies
/// along the boundary (Snell); light that fills dw outside fills dw cos / (n^2 cos') within, where radiance is basic radiance.
void PathTracer::send_from_medium(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                                  const geometry::SurfacePoint& hit, int depth,
                                  const scene::ResolvedSurface& surface, sampling::Point2 u,
                                  std::uint32_t medium, MediumSides which) {
  if (options_.maximum_scatterings >= 0 && depth + 1 >= options_.maximum_scatterings) return;
  const scene::Sun& sun = *scene_.scene().sun;
  math::Vec3 towards_sun = sun.direction;
  double weight = 1.0;
  if (sun.half_angle_rad > 0.0) {
    const sampling::UniformCone disc(sun.half_angle_rad);
    const double sine = std::sin(sun.half_angle_rad);
    towards_sun = disc.sample(sun.direction, u);
    weight = disc.solid_angle_sr() / (std::numbers::pi * sine * sine);
  }
  const double index = scene_.scene().materials[media_[medium].material].bsdf->bending_index();
  struct Face {
    math::Vec3 direction;
    double spread;  // of solid angle
  };
  std::vector<Face> faces;
  const double slope = 1.01 * std::tan(sun.half_angle_rad);
  for (const SunMirrors::Facing& facing : mirrors_->facings()) {
    const double along = math::dot(facing.normal, towards_sun);
    const math::Vec3 normal = along < 0.0 ? -facing.normal : facing.normal;
    const double outside = std::abs(along);
    const math::Vec3 flat = (towards_sun - outside * normal) / index;
    const double within_square = 1.0 - math::dot(flat, flat);
    if (!(within_square > 0.0) || !(outside > 0.0)) continue;
    const double within = std::sqrt(within_square);
    const math::Vec3 direction = math::normalized(flat + within * normal);
    const bool is_behind = math::dot(sides.outward, direction) < 0.0;
    if (which != MediumSides::both && is_behind != (which == MediumSides::behind)) continue;
    if (!may_meet(facing.bounds, hit.position_m, direction, slope)) continue;
    faces.push_back({direction, outside / (index * index * within)});
  }
  const std::size_t rays = std::min(faces.size(), kMostFaceRays);
  for (std::size_t k = 0; k < rays; ++k) {
    std::size_t picked = k;
    if (rays < faces.size()) {
      const double position =
          (static_cast<double>(k) +
           sampling::unit_double(sampling::hash(path.key.sequence, path.key.index,
                                                static_cast<std::uint64_t>(depth) << 8 | k, kFaceChoice))) *
          static_cast<double>(faces.size()) / static_cast<double>(rays);
      picked = std::min(faces.size() - 1, static_cast<std::size_t>(position));
    }
    const Face& face = faces[picked];
    const bool behind = math::dot(sides.outward, face.direction) < 0.0;
    const double cosine = (behind ? -1.0 : 1.0) * math::dot(sides.shading.as_vector(), face.direction);
    const SunRay light = light_ray(lobe, sides, hit, face.direction, cosine * weight * face.spread);
    if (light.weight <= 0.0) continue;
    PassingRay way;
    way.event = static_cast<std::uint32_t>(events_.size() - 1);
    way.ray = light.ray;
    way.towards = towards_sun;
    way.medium = medium;
    way.light = static_cast<std::uint32_t>(sunken_.size());
    PathRecord::Mirrored& sunken = sunken_.emplace_back();
    sunken.weight =
        static_cast<float>(light.weight * static_cast<double>(faces.size()) / static_cast<double>(rays));
    sunken.transmitted = light.transmitted;
    sunken.surface = surface_factor(
        surface, events_.back().vertex,
        lobe.directional ? arriving(lobe, sides, light.ray.direction, light.transmitted) : LobeEvent{},
        light.transmitted);
    passing_rays_.push_back(way);
  }
}

float PathTracer::refracted_light(math::Ray ray, geometry::SurfacePoint hit,
                                  sampling::RayCounts& counts) const {
  constexpr int kMostBends = 6;
  double share = 1.0;
  for (int bends = 0; bends < kMostBends; ++bends) {
    const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
    const materials::Bsdf& bsdf = first_bsdf(scene_.scene(), surface);
    if (surface.count != 1 || !bsdf.is_delta() || !bounds_medium(bsdf)) return 0.0f;
    materials::BsdfEvent view = delta_view(-ray.direction, hit, surface);
    SurfaceLobe lobe = surface_lobe(scene_, surface, 0.0);
    narrow_to_angle(scene_, surface, view, lobe);
    view.side = lobe.highest_transmittance > 0.0 ? materials::Side::transmitted : materials::Side::reflected;
    share *= std::max(lobe.highest_transmittance, view.side == materials::Side::reflected ? 1.0 : 0.0);
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    const math::Vec3 onward = bsdf.sample(view, 0.5, 0.5).incoming;
    const double side = view.side == materials::Side::transmitted ? -1.0 : 1.0;
    ray = ray.onward(hit.position_m + side * hit.offset_m * outward, onward);
    scene_.scene().world->intersect({&ray, 1}, {&hit, 1});
    ++counts.shadow;
    if (hit.hit()) continue;
    const float arrives = WideSun::radiance(scene_.scene(), ray.direction);
    if (arrives <= 0.0f) return 0.0f;
    const math::Ray to_sun = ray.onward(ray.origin_m, scene_.scene().sun->direction);
    std::uint8_t blocked = 0;
    // What is refracted may lie between there and the Sun itself: only other things hide it.
    scene_.scene().world->intersect({&to_sun, 1}, {&hit, 1});
    if (hit.hit()) blocked = !bounds_medium(first_bsdf(scene_.scene(), scene_.scene().resolve(hit)));
    ++counts.shadow;
    return blocked != 0 ? 0.0f : static_cast<float>(share) * arrives;
  }
  return 0.0f;
}

void PathTracer::pass_seeks(sampling::RayCounts& counts) {
  if (!scene_.materials().any_pane()) return;
  std::vector<std::uint32_t> going(seek_rays_.size());
  std::vector<PassingRay> ways(seek_rays_.size());
  for (std::uint32_t k = 0; k < going.size(); ++k) going[k] = k, ways[k].ray = seek_rays_[k];
  for (SurfaceEvent& event : events_)
    if (event.seek != kNone) ways[event.seek].event = static_cast<std::uint32_t>(&event - events_.data());
  std::vector<geometry::SurfacePoint> hits = seek_hits_;
  for (int passed = 0; passed < kMostPassed && !going.empty(); ++passed) {
    std::size_t kept = 0;
    rays_.clear();
    for (std::size_t j = 0; j < going.size(); ++j) {
      const std::uint32_t k = going[j];
      const geometry::SurfacePoint& hit = hits[j];
      seek_hits_[k] = hit;
      if (!hit.hit() || emitters_->is(seeks_[k].aim, hit)) continue;
      const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
      if (!passes_straight(scene_, surface) || !pass(ways[k], hit, surface)) continue;
      events_[ways[k].event].vertex.sought_passes = ways[k].passes;
      rays_.push_back(ways[k].ray);
      going[kept++] = k;
    }
    going.resize(kept);
    hits.resize(kept);
    if (kept > 0) scene_.scene().world->intersect(rays_, hits);
    counts.shadow += kept;
  }
}

}  // namespace ifov::transport
