#include "render/field/seen_through.h"

#include <cmath>

#include "geometry/world.h"
#include "materials/bsdf/node_bsdf.h"
#include "sampling/hash.h"
#include "scene/scene.h"
#include "transport/delta_events.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Surfaces that are looked through, one behind another.
constexpr int kMostPassed = 8;
/// Mirrors of them.
constexpr std::uint8_t kMostReflections = 2;
/// Of light: less shows nothing.
constexpr double kFaint = 1e-3, kFaintImage = 0.02;

}  // namespace

SeenThrough::SeenThrough(const transport::SpectralScene& scene)
    : scene_(scene),
      passages_(scene.materials().any_pane() || scene.materials().any_medium()),
      mirrors_(scene.scene().mirror_assignments()),
      any_(passages_ || !mirrors_.empty()) {
  const auto& sun = scene.scene().sun;
  if (!sun || !(sun->half_angle_rad > 0.0)) return;
  towards_sun_ = sun->direction;
  cosine_of_sun_ = std::cos(sun->half_angle_rad);
}

bool SeenThrough::glints(math::Vec3 direction, const geometry::SurfacePoint& hit) const {
  if (hit.bend != geometry::Bend::none && hit.bend != geometry::Bend::facet) return false;
  const math::Vec3 normal = hit.geometric_normal.as_vector();
  return meets_sun(direction - 2.0 * math::dot(direction, normal) * normal);
}

bool SeenThrough::shows_sun(Way way, const geometry::SurfacePoint& hit) const {
  return cosine_of_sun_ <= 1.0 &&
         (way == Way::flat_mirror || (way == Way::bent_mirror && hit.bend == geometry::Bend::facet));
}

SeenThrough::Way SeenThrough::turn(math::Ray& ray, const geometry::SurfacePoint& hit,
                                   bool only_straight) const {
  const bool mirrors = !only_straight && !mirrors_.empty() && mirrors_[hit.material];
  if (!passages_ && !mirrors) return Way::none;
  const scene::ResolvedSurface surface = scene_.scene().resolve_without_temperature(hit);
  materials::BsdfEvent view = transport::delta_view(-ray.direction, hit, surface);
  for (const scene::Constituent& part : surface) {
    const materials::NodeBsdf* model = scene_.materials().directional(part.material);
    const materials::Bsdf& bsdf = *scene_.scene().materials[part.material].bsdf;
    if (!bsdf.is_delta()) continue;
    const bool mirror = bsdf.passage() == materials::Passage::none;
    if (mirror ? !mirrors : model == nullptr) continue;
    if (only_straight && bsdf.passage() != materials::Passage::straight) continue;
    view.side = mirror ? materials::Side::reflected : materials::Side::transmitted;
    const double share =
        model != nullptr ? model->highest_share(view, view.side) : scene_.brightest(part.material);
    if (!(part.weight * share > (mirror ? kFaintImage : kFaint))) continue;
    const materials::BsdfSample sample = bsdf.sample(view, 0.5, 0.5);
    if (!(sample.weight > 0.0)) continue;
    if (!mirror) {
      ray = ray.onward(transport::beyond_surface(hit), sample.incoming);
      return Way::through;
    }
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    if (!(math::dot(sample.incoming, outward) > 0.0)) continue;
    ray = ray.onward(hit.position_m + hit.offset_m * outward, sample.incoming);
    const bool flat =
        hit.bend == geometry::Bend::none && !scene_.scene().assignments[hit.material].bends_normals();
    return flat ? Way::flat_mirror : Way::bent_mirror;
  }
  return Way::none;
}

void SeenThrough::follow(std::span<math::Ray> rays, std::span<geometry::SurfacePoint> hits,
                         std::span<std::uint64_t> states, sampling::RayCounts& counts) {
  going_.clear();
  reflections_.assign(rays.size(), 0);
  for (std::uint32_t k = 0; k < rays.size(); ++k) {
    states[k] = 0;
    if (hits[k].hit()) going_.push_back(k);
  }
  for (int passed = 0; passed < kMostPassed && !going_.empty(); ++passed) {
    next_.clear();
    ways_.clear();
    glints_.clear();
    rays_.clear();
    for (const std::uint32_t k : going_) {
      math::Ray onward = rays[k];
      const Way way = turn(onward, hits[k], false);
      if (way == Way::none) continue;
      if (way != Way::through && reflections_[k]++ >= kMostReflections) {
        if (shows_sun(way, hits[k])) beyond_.push_back({k, reflections_[k], onward});
        continue;
      }
      next_.push_back(k);
      ways_.push_back(way);
      glints_.push_back(way == Way::through && glints(rays[k].direction, hits[k]));
      rays_.push_back(onward);
    }
    hits_.resize(rays_.size());
    if (!rays_.empty()) scene_.scene().world->intersect(rays_, hits_);
    counts.primary += rays_.size();
    going_.clear();
    for (std::size_t j = 0; j < next_.size(); ++j) {
      const std::uint32_t k = next_[j];
      if (ways_[j] == Way::bent_mirror) {
        // Glints on what is round or smooth are found by its shape (Glints).
        const bool sun = !hits_[j].hit() && shows_sun(ways_[j], hits[k]) && meets_sun(rays_[j].direction);
        if (hits_[j].hit() && shows_sun(ways_[j], hits[k])) beyond_.push_back({k, reflections_[k], rays_[j]});
        states[k] = hits_[j].hit() ? (sampling::hash(states[k], 5u) | kUnevenState) | 1
                                   : (sampling::hash(states[k], sun ? 8u : 4u) & ~kUnevenState) | 1;
        continue;
      }
      rays[k] = rays_[j];
      hits[k] = hits_[j];
      std::uint64_t met = 1;
      if (hits[k].hit()) {
        const std::uint32_t material =
            scene_.scene().resolve_without_temperature(hits[k]).constituents[0].material;
        met = sampling::hash(hits[k].instance, hits[k].patch, material, hits[k].front ? 3u : 2u);
        going_.push_back(k);
      }
      if (glints_[j]) met = sampling::hash(met, 6u);
      if (!hits[k].hit() && meets_sun(rays[k].direction)) met = sampling::hash(met, 7u);
      states[k] = (sampling::hash(states[k], met) & ~kUnevenState) | 1;
    }
  }
  if (!beyond_.empty()) look_for_sun(states, counts);
}

void SeenThrough::look_for_sun(std::span<std::uint64_t> states, sampling::RayCounts& counts) {
  for (int passed = 0; passed < kMostPassed && !beyond_.empty(); ++passed) {
    rays_.clear();
    for (const Beyond& one : beyond_) rays_.push_back(one.onward);
    hits_.resize(rays_.size());
    scene_.scene().world->intersect(rays_, hits_);
    counts.primary += rays_.size();
    std::size_t kept = 0;
    for (std::size_t j = 0; j < rays_.size(); ++j) {
      Beyond one = beyond_[j];
      if (!hits_[j].hit()) {
        if (meets_sun(one.onward.direction))
          states[one.ray] = (sampling::hash(states[one.ray], 9u) & ~kUnevenState) | 1;
        continue;
      }
      const Way way = turn(one.onward, hits_[j], false);
      if (way == Way::none) continue;
      if (way != Way::through && (!shows_sun(way, hits_[j]) || ++one.reflections > kMostReflectionsOfSun))
        continue;
      beyond_[kept++] = one;
    }
    beyond_.resize(kept);
  }
  beyond_.clear();
}

void SeenThrough::list_ways(math::Ray ray, const geometry::World& world, geometry::SurfacePoint& hit,
                            std::vector<math::Ray>& ways, sampling::RayCounts& counts) const {
  std::uint8_t reflections = 0;
  for (int passed = 0; passed < kMostPassed && hit.hit(); ++passed) {
    const Way way = turn(ray, hit, false);
    if (way == Way::none || (way != Way::through && reflections++ >= kMostReflections)) return;
    world.intersect({&ray, 1}, {&hit, 1});
    ++counts.primary;
    ways.push_back(ray);
    if (hit.hit()) ways.back().t_max_m = hit.distance_m;
  }
}

std::uint64_t SeenThrough::passed(math::Ray ray, sampling::RayCounts& counts) {
  if (!scene_.materials().any_pane()) return 0;
  std::uint64_t state = 0;
  for (int passed = 0; passed <= kMostPassed; ++passed) {
    geometry::SurfacePoint hit;
    scene_.scene().world->intersect({&ray, 1}, {&hit, 1});
    ++counts.shadow;
    if (!hit.hit()) return state;
    if (turn(ray, hit, true) == Way::none) return 0;
    state =
        sampling::hash(state, scene_.scene().resolve_without_temperature(hit).constituents[0].material) | 1;
  }
  return 0;
}

}  // namespace ifov::render
