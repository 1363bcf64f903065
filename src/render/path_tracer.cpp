#include "render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "materials/scattering.h"
#include "math/vec3.h"
#include "sampling/sequence.h"

namespace ifov::render {

namespace {

/// Surfaces a path scatters at before it may be ended by chance.
constexpr int kCertainScatterings = 3;

/// Paths advance in groups small enough that their rows stay in the second-level cache.
constexpr std::size_t kGroup = 256;

void add_scaled(float* __restrict sum, const float* __restrict a, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * s;
}
void add_product(float* __restrict sum, const float* __restrict a, const float* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * b[i];
}
void add_scaled_product(float* __restrict sum, const float* __restrict a, const float* __restrict b, float s,
                        std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * (b[i] * s);
}
void sum_of_scaled_product(float* __restrict sum, const float* __restrict first, const float* __restrict a,
                           const float* __restrict b, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] = first[i] + a[i] * (b[i] * s);
}
void scale(float* __restrict a, const float* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= b[i];
}
void scale(float* a, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= s;
}

}  // namespace

PathTracer::PathTracer(const SpectralScene& scene, TransportOptions options)
    : scene_(scene), options_(options), row_floats_(scene.stride()) {
  if (scene.scene().sun) disc_.emplace(scene.scene().sun->half_angle_rad);
}

void PathTracer::trace(std::span<const math::Ray> rays, std::span<const PathKey> keys,
                       radiometry::SpectrumBlock& radiance, std::span<geometry::SurfacePoint> first_hits,
                       sampling::RayCounts& counts) {
  radiance.reshape(rays.size(), scene_.node_count());
  scratch_.resize(1, scene_.node_count());
  counts.primary += rays.size();
  for (std::size_t first = 0; first < rays.size(); first += kGroup) {
    const std::size_t count = std::min(kGroup, rays.size() - first);
    throughput_.reshape(count, scene_.node_count());
    paths_.resize(count);
    for (std::size_t k = 0; k < count; ++k)
      paths_[k] = {rays[first + k], keys[first + k], static_cast<std::uint32_t>(first + k),
                   static_cast<std::uint32_t>(k), true};
    for (int depth = 0; !paths_.empty(); ++depth) {
      trace_segment(counts, depth);
      if (depth == 0) std::copy(hits_.begin(), hits_.end(), first_hits.begin() + static_cast<std::ptrdiff_t>(first));
      advance(depth, radiance, counts);
    }
  }
  if (scene_.has_view_path()) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
      float* row = radiance.row(k);
      scale(row, scene_.view_transmittance(), row_floats_);
      add_scaled(row, scene_.view_radiance(), 1.0f, row_floats_);
    }
  }
}

void PathTracer::trace_segment(sampling::RayCounts& counts, int depth) {
  rays_.resize(paths_.size());
  hits_.resize(paths_.size());
  for (std::size_t k = 0; k < paths_.size(); ++k) rays_[k] = paths_[k].ray;
  scene_.scene().world->intersect(rays_, hits_);
  if (depth > 0) counts.bounce += rays_.size();
}

void PathTracer::advance(int depth, radiometry::SpectrumBlock& radiance, sampling::RayCounts& counts) {
  scatters_.clear();
  shadow_rays_.clear();
  for (std::size_t k = 0; k < paths_.size(); ++k) {
    const Path& path = paths_[k];
    float* sum = radiance.row(path.row);
    if (!hits_[k].hit()) {
      add_escaped(path, depth, sum);
      continue;
    }
    const scene::ResolvedSurface surface = scene_.scene().resolve(hits_[k]);
    const float* emission = scene_.emission(surface, scratch_.row(0));
    const std::size_t before = scatters_.size();
    if (scene_.highest_reflectance(surface.material) > 0.0 && depth != options_.maximum_scatterings)
      scatter(path, static_cast<std::uint32_t>(k), surface.material, depth);
    if (depth > 0)
      add_product(sum, throughput_.row(path.throughput), emission, row_floats_);
    else if (scatters_.size() > before && emission != scratch_.row(0))
      scatters_.back().emission = emission;  // written together with the sunlight
    else
      std::memcpy(sum, emission, row_floats_ * sizeof(float));
  }

  blocked_.resize(shadow_rays_.size());
  if (!shadow_rays_.empty()) scene_.scene().world->occluded(shadow_rays_, blocked_);
  counts.shadow += shadow_rays_.size();

  next_paths_.clear();
  for (const Scatter& event : scatters_) {
    const Path& path = paths_[event.path];
    const float* reflectance = scene_.reflectance(event.material);
    float* sum = radiance.row(path.row);
    float* throughput = throughput_.row(path.throughput);
    const bool sunlit = event.shadow != kNone && blocked_[event.shadow] == 0;
    const bool goes_on = event.bounce_weight > 0.0f;
    if (depth == 0) {
      if (event.emission != nullptr && sunlit)
        sum_of_scaled_product(sum, event.emission, reflectance, scene_.sun_irradiance(), event.sun_weight,
                              row_floats_);
      else if (event.emission != nullptr)
        std::memcpy(sum, event.emission, row_floats_ * sizeof(float));
      else if (sunlit)
        add_scaled_product(sum, reflectance, scene_.sun_irradiance(), event.sun_weight, row_floats_);
      if (!goes_on) continue;
      std::memcpy(throughput, reflectance, row_floats_ * sizeof(float));
    } else {
      if (!sunlit && !goes_on) continue;
      scale(throughput, reflectance, row_floats_);
      if (sunlit) add_scaled_product(sum, throughput, scene_.sun_irradiance(), event.sun_weight, row_floats_);
      if (!goes_on) continue;
    }
    if (event.bounce_weight != 1.0f) scale(throughput, event.bounce_weight, row_floats_);
    next_paths_.push_back({event.next, path.key, path.row, path.throughput, event.next_sees_sun});
  }
  paths_.swap(next_paths_);
}

void PathTracer::add_escaped(const Path& path, int depth, float* sum) {
  const scene::Scene& scene = scene_.scene();
  const math::Vec3 direction = path.ray.direction;
  const float* throughput = throughput_.row(path.throughput);
  const float* light = direction.z < 0.0 ? scene_.surroundings_radiance() : scene_.sky_radiance();
  if (depth == 0)
    std::memcpy(sum, light, row_floats_ * sizeof(float));
  else
    add_product(sum, throughput, light, row_floats_);
  if (path.sees_sun && scene.sun && scene.sun->half_angle_rad > 0.0 && direction.z > 0.0 &&
      math::length(math::cross(direction, scene.sun->direction)) < std::sin(scene.sun->half_angle_rad) &&
      math::dot(direction, scene.sun->direction) > 0.0) {
    const double sine = std::sin(scene.sun->half_angle_rad);
    const float per_irradiance = static_cast<float>(1.0 / (std::numbers::pi * sine * sine));
    if (depth == 0)
      add_scaled(sum, scene_.sun_irradiance(), per_irradiance, row_floats_);
    else
      add_scaled_product(sum, throughput, scene_.sun_irradiance(), per_irradiance, row_floats_);
  }
}

void PathTracer::scatter(const Path& path, std::uint32_t path_index, std::uint32_t material, int depth) {
  const scene::Scene& scene = scene_.scene();
  const geometry::SurfacePoint& hit = hits_[path_index];
  const materials::Scattering& scattering = materials::scattering(scene.materials[material].scattering);
  const math::Normal3 facing = hit.front ? hit.shading_normal : -hit.shading_normal;
  const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
  const math::Vec3 outgoing = -path.ray.direction;
  const std::uint32_t pair = 1u + 2u * static_cast<std::uint32_t>(depth);

  Scatter event;
  event.path = path_index;
  event.material = material;

  if (scene.sun && !scattering.is_delta()) {
    const sampling::Point2 u = sampling::sequence_point(path.key.sequence, path.key.index, pair);
    const sampling::LightSample light = sample_sun(*scene.sun, facing.as_vector(), u);
    if (light.weight_sr > 0.0 && math::dot(light.direction, outward) > 0.0) {
      const double f = scattering.evaluate(outgoing, light.direction, facing);
      if (f > 0.0) {
        event.sun_weight = static_cast<float>(f * light.weight_sr);
        event.shadow = static_cast<std::uint32_t>(shadow_rays_.size());
        shadow_rays_.push_back({hit.position_m + hit.offset_m * outward, light.direction});
      }
    }
  }

  if (depth + 1 != options_.maximum_scatterings) {
    const sampling::Point2 u = sampling::sequence_point(path.key.sequence, path.key.index, pair + 1u);
    const materials::ScatterSample sample = scattering.sample(outgoing, facing, u.x, u.y);
    if (sample.weight > 0.0 && math::dot(sample.incoming, outward) > 0.0) {
      double weight = sample.weight;
      bool survives = true;
      if (depth + 1 >= kCertainScatterings) {
        const double chance = std::min(1.0, scene_.highest_reflectance(material) * sample.weight);
        survives = sampling::unit_double(sampling::hash(path.key.sequence, path.key.index, depth)) < chance;
        weight /= chance;
      }
      if (survives) {
        event.bounce_weight = static_cast<float>(weight);
        event.next = {hit.position_m + hit.offset_m * outward, sample.incoming};
        event.next_sees_sun = scattering.is_delta();
      }
    }
  }
  if (event.shadow != kNone || event.bounce_weight > 0.0f) scatters_.push_back(event);
}

sampling::LightSample PathTracer::sample_sun(const scene::Sun& sun, math::Vec3 normal, sampling::Point2 u) const {
  // Weights are relative to the irradiance of a surface that faces the Sun.
  if (sun.half_angle_rad <= 0.0) return {sun.direction, std::max(0.0, math::dot(sun.direction, normal))};
  sampling::LightSample sample = disc_->sample(sun.direction, normal, u);
  const double sine = std::sin(sun.half_angle_rad);
  sample.weight_sr /= std::numbers::pi * sine * sine;
  return sample;
}

}  // namespace ifov::render
