#include "transport/path_tracer.h"

#include <algorithm>

#include "geometry/world.h"
#include "math/vec3.h"
#include "scene/scene.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/lobe_targets.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/path_parts.h"
#include "transport/sky/sky_dome.h"
#include "transport/spectral_scene.h"
#include "transport/wide_sun.h"

namespace ifov::transport {
namespace {

/// Where a ray comes through z = 0; where it starts, if it does not.
math::Point3 on_the_ground(const math::Ray& ray) {
  const double length_m = ray.direction.z < 0.0 ? std::max(0.0, -ray.origin_m.z / ray.direction.z) : 0.0;
  return ray.origin_m + length_m * ray.direction;
}

}  // namespace

PathTracer::PathTracer(const SpectralScene& scene, TransportOptions options)
    : scene_(scene), options_(options) {
  if (scene.scene().sun) disc_.emplace(scene.scene().sun->half_angle_rad);
  if (options.seek_emitters && scene.emitters() != nullptr && scene.emitters()->count() > 0)
    emitters_ = scene.emitters();
  if (scene.sky_dome() != nullptr && !scene.sky_dome()->sampler().empty())
    sky_ = &scene.sky_dome()->sampler();
  if (emitters_ != nullptr && options.mirror_reflections > 0) emitter_mirrors_ = scene.emitter_mirrors();
  mirrors_ = scene.sun_mirrors();
  if (mirrors_ != nullptr) {
    images_ = SunImages(*mirrors_, scene.scene().sun->direction, options.mirror_reflections);
    mirror_tracer_ =
        std::make_unique<MirrorTracer>(scene.scene(), *mirrors_, images_, scene.materials().any_pane());
  }
  if (scene.sun_lobes() != nullptr && scene.sun_lobes()->any_throws_rarely()) {
    rare_lobes_ = scene.sun_lobes();
    for (const auto& ball : rare_lobes_->throwers()) throwers_.push_back({ball.centre_m, ball.radius_m});
  }
  if (scene.sun_lobes() != nullptr && options.seek_lobes && !scene.sun_lobes()->targets().empty() &&
      options.highlights != TransportOptions::Highlights::alone)
    lobes_ = scene.sun_lobes(), lobe_view_ = std::make_unique<LobeView>();
  if (mirrors_ != nullptr)
    for (const auto& ball : mirrors_->groups()) throwers_.push_back({ball.centre_m, ball.radius_m});
  passages_ = scene.materials().any_pane() || scene.materials().any_medium();
}

PathTracer::~PathTracer() = default;

const PathRecord& PathTracer::trace(std::span<const math::Ray> rays, std::span<const PathKey> keys,
                                    std::span<geometry::SurfacePoint> first_hits, sampling::RayCounts& counts,
                                    std::span<const std::uint8_t> whole) {
  counts.primary += rays.size();
  record_.start(rays.size());
  paths_.resize(rays.size());
  for (std::size_t k = 0; k < rays.size(); ++k)
    paths_[k] = {rays[k], keys[k], static_cast<std::uint32_t>(k), true, {}, {}};
  media_.clear();
  for (int depth = 0; !paths_.empty(); ++depth) {
    trace_segment(counts, depth);
    if (depth == 0) {
      std::copy(hits_.begin(), hits_.end(), first_hits.begin());
      for (std::size_t k = 0; k < rays.size(); ++k) {
        PathRecord::Path& path = record_.paths[k];
        path.towards_sensor = -rays[k].direction;
        path.sensor_height_m = rays[k].origin_m.z;
        path.met = hits_[k].hit();
        path.seen_height_m = path.met ? hits_[k].position_m.z : 0.0;
        const math::Point3 seen = path.met ? hits_[k].position_m : on_the_ground(rays[k]);
        path.seen_x_m = seen.x, path.seen_y_m = seen.y;
      }
    }
    whole_ = depth == 0 ? whole : std::span<const std::uint8_t>{};
    advance(depth, counts);
  }
  for (std::size_t k = 0; k < rays.size() && passages_; ++k)
    for (std::uint32_t also = record_.paths[k].also; also != PathVertex::kNone;
         also = record_.paths[also].also)
      record_.paths[k].unseen += record_.paths[also].unseen;
  return record_;
}

void PathTracer::trace_segment(sampling::RayCounts& counts, int depth) {
  rays_.resize(paths_.size());
  hits_.resize(paths_.size());
  for (std::size_t k = 0; k < paths_.size(); ++k) rays_[k] = paths_[k].ray;
  scene_.scene().world->intersect(rays_, hits_);
  if (depth > 0) counts.continuation += rays_.size();
}

void PathTracer::advance(int depth, sampling::RayCounts& counts) {
  events_.clear();
  directions_.clear();
  shadow_rays_.clear();
  seeks_.clear();
  seek_rays_.clear();
  mirror_seeks_.clear();
  mirror_rays_.clear();
  unseen_rays_.clear();
  passing_rays_.clear();
  sunken_.clear();
  for (std::size_t k = 0; k < paths_.size(); ++k) {
    if (paths_[k].to_lobe) {
      meet_lobe(paths_[k], static_cast<std::uint32_t>(k), depth);
    } else if (passes(paths_[k], hits_[k])) {
      pass(paths_[k], hits_[k]);
    } else if (hits_[k].hit()) {
      const PathKey& key = paths_[k].key;
      const scene::ResolvedSurface surface = scene_.scene().resolve(
          hits_[k], sampling::hash(key.sequence, key.index, depth), static_cast<double>(paths_[k].share));
      if (depth == 0) record_.paths[k].seen_material = surface.constituents[0].material;
      if (passages_ && forks(paths_[k], hits_[k], surface)) {
        const std::uint32_t number = paths_[k].number, twin = fork(number);
        scatter(paths_[k], static_cast<std::uint32_t>(k), surface, depth, Branch::reflected, number);
        scatter(paths_[k], static_cast<std::uint32_t>(k), surface, depth, Branch::transmitted, twin);
      } else {
        scatter(paths_[k], static_cast<std::uint32_t>(k), surface, depth, Branch::by_chance,
                paths_[k].number);
      }
    } else {
      escape(paths_[k], depth);
    }
  }

  blocked_.resize(shadow_rays_.size());
  if (!shadow_rays_.empty()) scene_.scene().world->occluded(shadow_rays_, blocked_);
  counts.shadow += shadow_rays_.size();
  if (passages_) pass_shadow_rays(counts);
  if (!unseen_rays_.empty()) trace_unseen_rays(counts);
  if (!mirror_rays_.empty()) trace_mirror_rays(counts);

  if (!seeks_.empty()) trace_seeks(counts);
  if (!mirror_seeks_.empty()) trace_mirror_seeks(counts);

  next_paths_.clear();
  next_paths_.swap(passing_);
  record_.directions.insert(record_.directions.end(), directions_.begin(), directions_.end());
  for (SurfaceEvent& event : events_) {
    const Path& path = paths_[event.path];
    if (depth == 0 && event.shadow != kNone && event.vertex.sun_passes == PathVertex::kNone)
      record_.paths[event.number].first_sun =
          blocked_[event.shadow] != 0 ? PathRecord::Path::SunSeen::hidden : PathRecord::Path::SunSeen::seen;
    if (event.shadow == kNone || blocked_[event.shadow] != 0) event.vertex.sun_weight = event.rare_sun = 0.0f;
    record_.paths[event.number].unseen += event.rare_sun;
    record_.add(event.number, event.vertex);
    if (event.vertex.continuation_weight > 0.0f)
      next_paths_.push_back({event.next, path.key, event.number, event.next_sees_sun, event.left,
                             event.next_chain, event.next_mirror, event.next_direct, event.next_forks,
                             event.next_share, event.next_medium, event.next_sunlight, event.next_to_lobe});
  }
  paths_.swap(next_paths_);
}

bool PathTracer::passes(const Path& path, const geometry::SurfacePoint& hit) const {
  return path.mirror != SeparateImages::kNone && options_.separate_images->holds(path.mirror, hit);
}

void PathTracer::pass(const Path& path, const geometry::SurfacePoint& hit) {
  const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
  passing_.push_back(path);
  passing_.back().ray = path.ray.onward(hit.position_m - hit.offset_m * outward, path.ray.direction);
}

void PathTracer::escape(const Path& path, int depth) {
  PathRecord::Path& record = record_.paths[path.number];
  record.escaped = true;
  record.escaped_sees_sun = path.sees_sun && !(options_.sun_apart && depth == 0);
  record.escaped_direction = path.ray.direction;
  record.escaped_from_m = path.ray.origin_m.z;
  if (path.way.unseen)
    record.unseen += record.brightest * WideSun::radiance(scene_.scene(), path.ray.direction);
}

}  // namespace ifov::transport
