#include "render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "math/vec3.h"
#include "render/row_arithmetic.h"

namespace ifov::render {

namespace {

/// Light of a surface after the air before it, from 1 to 4 rows of the table.
void see_through(float* __restrict light, const ViewTable::Place& at, std::size_t n) {
  const auto *t = at.transmittance.data(), *l = at.radiance.data();
  const float* w = at.weight.data();
  switch (at.count) {
    case 2:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * (t[0][i] * w[0] + t[1][i] * w[1]) + (l[0][i] * w[0] + l[1][i] * w[1]);
      return;
    case 3:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * (t[0][i] * w[0] + t[1][i] * w[1] + t[2][i] * w[2]) +
                   (l[0][i] * w[0] + l[1][i] * w[1] + l[2][i] * w[2]);
      return;
    default:
      for (std::size_t i = 0; i < n; ++i)
        light[i] = light[i] * ((t[0][i] * w[0] + t[1][i] * w[1]) + (t[2][i] * w[2] + t[3][i] * w[3])) +
                   ((l[0][i] * w[0] + l[1][i] * w[1]) + (l[2][i] * w[2] + l[3][i] * w[3]));
  }
}

}  // namespace

PathTracer::PathTracer(const SpectralScene& scene, TransportOptions options)
    : scene_(scene), options_(options), row_floats_(scene.stride()) {
  if (scene.scene().sun) disc_.emplace(scene.scene().sun->half_angle_rad);
  if (scene.sky_dome() != nullptr && !scene.sky_dome()->sampler().empty()) sky_ = &scene.sky_dome()->sampler();
}

void PathTracer::trace(std::span<const math::Ray> rays, std::span<const PathKey> keys,
                       radiometry::SpectrumBlock& radiance, std::span<geometry::SurfacePoint> first_hits,
                       sampling::RayCounts& counts) {
  radiance.reshape(rays.size(), scene_.node_count());
  scratch_.resize(2, scene_.node_count());
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
  if (const ViewTable* table = scene_.view_table()) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const math::Vec3 towards_sensor = -rays[k].direction;
      if (!first_hits[k].hit() && towards_sensor.z <= 0.0) continue;  // the sky itself
      const ViewTable::Place place =
          table->at(towards_sensor, first_hits[k].hit() ? first_hits[k].position_m.z : 0.0);
      see_through(radiance.row(k), place, row_floats_);
    }
  } else if (scene_.has_view_path()) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
      float* row = radiance.row(k);
      rows::scale(row, scene_.view_transmittance(), row_floats_);
      rows::add_scaled(row, scene_.view_radiance(), 1.0f, row_floats_);
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
    const bool scatters = depth != options_.maximum_scatterings &&
                          scatter(path, static_cast<std::uint32_t>(k), surface, depth);
    if (depth > 0) {
      if (emission != nullptr) rows::add_product(sum, throughput_.row(path.throughput), emission, row_floats_);
    } else if (scatters && emission != scratch_.row(0)) {
      scatters_.back().emission = emission;  // written together with the sunlight
    } else if (emission != nullptr) {
      std::memcpy(sum, emission, row_floats_ * sizeof(float));
      if (scatters) scatters_.back().emission = sum;
    } else {
      std::memset(sum, 0, row_floats_ * sizeof(float));
    }
  }

  blocked_.resize(shadow_rays_.size());
  if (!shadow_rays_.empty()) scene_.scene().world->occluded(shadow_rays_, blocked_);
  counts.shadow += shadow_rays_.size();

  next_paths_.clear();
  for (const Scatter& event : scatters_) {
    const Path& path = paths_[event.path];
    float* sum = radiance.row(path.row);
    float* throughput = throughput_.row(path.throughput);
    const float* sun = scene_.sun_irradiance(hits_[event.path].position_m.z, scratch_.row(0));
    const bool sunlit = event.shadow != kNone && blocked_[event.shadow] == 0;
    const bool goes_on = event.bounce_weight > 0.0f;
    if (depth == 0) {
      if (event.emission == sum) {
        if (sunlit) rows::add_scaled_product(sum, event.sun_factor, sun, event.sun_weight, row_floats_);
      } else if (event.emission != nullptr && sunlit) {
        rows::sum_of_scaled_product(sum, event.emission, event.sun_factor, sun, event.sun_weight, row_floats_);
      } else if (event.emission != nullptr) {
        std::memcpy(sum, event.emission, row_floats_ * sizeof(float));
      } else if (sunlit) {
        rows::scaled_product(sum, event.sun_factor, sun, event.sun_weight, row_floats_);
      } else {
        std::memset(sum, 0, row_floats_ * sizeof(float));
      }
      if (!goes_on) continue;
      rows::set_scaled(throughput, event.bounce_factor, event.bounce_weight, row_floats_);
    } else if (sunlit && goes_on && event.sun_factor == event.bounce_factor) {
      rows::add_and_scale(sum, throughput, event.sun_factor, sun, event.sun_weight, event.bounce_weight, row_floats_);
    } else {
      if (sunlit) rows::add_scaled_product(sum, throughput, event.sun_factor, sun, event.sun_weight, row_floats_);
      if (!goes_on) continue;
      rows::scale(throughput, event.bounce_factor, event.bounce_weight, row_floats_);
    }
    next_paths_.push_back({event.next, path.key, path.row, path.throughput, event.next_sees_sun});
  }
  paths_.swap(next_paths_);
}

void PathTracer::add_escaped(const Path& path, int depth, float* sum) {
  const scene::Scene& scene = scene_.scene();
  const math::Vec3 direction = path.ray.direction;
  const float* throughput = throughput_.row(path.throughput);
  const SkyDome* dome = scene_.sky_dome();
  if (dome != nullptr && direction.z >= 0.0) {
    const SkyDome::Corners sky = dome->at(direction);
    if (depth == 0)
      rows::sum_of_scaled(sum, sky.row.data(), sky.weight.data(), row_floats_);
    else if (scene_.light_by_height()) {
      const float* share = scene_.sky_share(path.ray.origin_m.z, scratch_.row(0));
      float* light = scratch_.row(1);
      rows::set_product(light, throughput, share, row_floats_);
      rows::add_product_of_scaled(sum, light, sky.row.data(), sky.weight.data(), row_floats_);
    } else
      rows::add_product_of_scaled(sum, throughput, sky.row.data(), sky.weight.data(), row_floats_);
  } else {
    const float* light = direction.z < 0.0 ? scene_.surroundings_radiance() : scene_.sky_radiance();
    if (depth == 0)
      std::memcpy(sum, light, row_floats_ * sizeof(float));
    else
      rows::add_product(sum, throughput, light, row_floats_);
  }
  if (path.sees_sun && scene.sun && scene.sun->half_angle_rad > 0.0 && direction.z > 0.0 &&
      math::length(math::cross(direction, scene.sun->direction)) < std::sin(scene.sun->half_angle_rad) &&
      math::dot(direction, scene.sun->direction) > 0.0) {
    const double sine = std::sin(scene.sun->half_angle_rad);
    const float per_irradiance = static_cast<float>(1.0 / (std::numbers::pi * sine * sine));
    if (depth == 0)
      rows::add_scaled(sum, scene_.sun_irradiance(), per_irradiance, row_floats_);
    else
      rows::add_scaled_product(sum, throughput, scene_.sun_irradiance(), per_irradiance, row_floats_);
  }
}

}  // namespace ifov::render
