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
void add_scaled_product(float* __restrict sum, const float* __restrict a, const float* __restrict b,
                        const float* __restrict c, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * b[i] * (c[i] * s);
}
void scaled_product(float* __restrict out, const float* __restrict a, const float* __restrict b, float s,
                    std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = a[i] * (b[i] * s);
}
void sum_of_scaled_product(float* __restrict sum, const float* __restrict first, const float* __restrict a,
                           const float* __restrict b, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] = first[i] + a[i] * (b[i] * s);
}
/// Of four rows.
void sum_of_scaled(float* __restrict out, const float* const* rows, const float* weight, std::size_t n) {
  const float *__restrict a = rows[0], *__restrict b = rows[1], *__restrict c = rows[2], *__restrict d = rows[3];
  const float p = weight[0], q = weight[1], r = weight[2], s = weight[3];
  for (std::size_t i = 0; i < n; ++i) out[i] = (a[i] * p + b[i] * q) + (c[i] * r + d[i] * s);
}
void add_product_of_scaled(float* __restrict sum, const float* __restrict factor, const float* const* rows,
                           const float* weight, std::size_t n) {
  const float *__restrict a = rows[0], *__restrict b = rows[1], *__restrict c = rows[2], *__restrict d = rows[3];
  const float p = weight[0], q = weight[1], r = weight[2], s = weight[3];
  for (std::size_t i = 0; i < n; ++i) sum[i] += factor[i] * ((a[i] * p + b[i] * q) + (c[i] * r + d[i] * s));
}
void scale(float* __restrict a, const float* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= b[i];
}
void scale(float* __restrict a, const float* __restrict b, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= b[i] * s;
}
void set_product(float* __restrict out, const float* __restrict a, const float* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = a[i] * b[i];
}
/// Both at one surface: what its sunlight adds, and the throughput beyond it.
void add_and_scale(float* __restrict sum, float* __restrict throughput, const float* __restrict factor,
                   const float* __restrict sun, float sun_weight, float weight, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float passed = throughput[i] * factor[i];
    sum[i] += passed * (sun[i] * sun_weight);
    throughput[i] = passed * weight;
  }
}
void set_scaled(float* __restrict out, const float* __restrict a, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = a[i] * s;
}

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

/// What the random choice between shapes at a surface is keyed by, beside its path and depth.
constexpr std::uint64_t kShapeChoice = 0x7368617065ull;

/// Share of the directions that a level surface draws from the sky.
constexpr double kMostSkySamples = 0.6;

/// A shading normal is bent back until the viewer stands at least this far above its horizon (a cosine): nobody sees
/// a surface from behind.
constexpr double kLeastCosine = 1e-3;

math::Vec3 mirrored(math::Vec3 direction, math::Vec3 normal) {
  return direction - 2.0 * math::dot(direction, normal) * normal;
}

}  // namespace

/// The surface as seen along a path: normals on the viewer's side.
struct PathTracer::Sides {
  math::Vec3 outgoing;     // towards the viewer
  math::Vec3 outward;      // geometric normal
  math::Normal3 shading;
  bool bent = false;       // the two differ

  Sides(math::Vec3 towards_viewer, const geometry::SurfacePoint& hit, math::Normal3 shading_normal)
      : outgoing(towards_viewer),
        outward((hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector()),
        shading(hit.front ? shading_normal : -shading_normal) {
    const math::Vec3 s = shading.as_vector();
    bent = s.x != outward.x || s.y != outward.y || s.z != outward.z;
    if (!bent) return;
    const double seen = math::dot(s, outgoing);
    if (seen < kLeastCosine) {
      const double along = std::max(1e-9, math::dot(outward, outgoing));
      shading = math::as_normal(math::normalized(s + (kLeastCosine - seen) / along * outward));
    }
  }
};

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
    const bool scatters = depth != options_.maximum_scatterings &&
                          scatter(path, static_cast<std::uint32_t>(k), surface, depth);
    if (depth > 0) {
      if (emission != nullptr) add_product(sum, throughput_.row(path.throughput), emission, row_floats_);
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
        if (sunlit) add_scaled_product(sum, event.sun_factor, sun, event.sun_weight, row_floats_);
      } else if (event.emission != nullptr && sunlit) {
        sum_of_scaled_product(sum, event.emission, event.sun_factor, sun, event.sun_weight, row_floats_);
      } else if (event.emission != nullptr) {
        std::memcpy(sum, event.emission, row_floats_ * sizeof(float));
      } else if (sunlit) {
        scaled_product(sum, event.sun_factor, sun, event.sun_weight, row_floats_);
      } else {
        std::memset(sum, 0, row_floats_ * sizeof(float));
      }
      if (!goes_on) continue;
      set_scaled(throughput, event.bounce_factor, event.bounce_weight, row_floats_);
    } else if (sunlit && goes_on && event.sun_factor == event.bounce_factor) {
      add_and_scale(sum, throughput, event.sun_factor, sun, event.sun_weight, event.bounce_weight, row_floats_);
    } else {
      if (sunlit) add_scaled_product(sum, throughput, event.sun_factor, sun, event.sun_weight, row_floats_);
      if (!goes_on) continue;
      scale(throughput, event.bounce_factor, event.bounce_weight, row_floats_);
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
      sum_of_scaled(sum, sky.row.data(), sky.weight.data(), row_floats_);
    else if (scene_.light_by_height()) {
      const float* share = scene_.sky_share(path.ray.origin_m.z, scratch_.row(0));
      float* light = scratch_.row(1);
      set_product(light, throughput, share, row_floats_);
      add_product_of_scaled(sum, light, sky.row.data(), sky.weight.data(), row_floats_);
    } else
      add_product_of_scaled(sum, throughput, sky.row.data(), sky.weight.data(), row_floats_);
  } else {
    const float* light = direction.z < 0.0 ? scene_.surroundings_radiance() : scene_.sky_radiance();
    if (depth == 0)
      std::memcpy(sum, light, row_floats_ * sizeof(float));
    else
      add_product(sum, throughput, light, row_floats_);
  }
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

bool PathTracer::scatter(const Path& path, std::uint32_t path_index, const scene::ResolvedSurface& surface, int depth) {
  double choice = 0.0;
  float* blend = nullptr;
  if (surface.count > 1) {
    if (blends_.rows() == 0) blends_.reshape(2 * kGroup, scene_.node_count());
    blend = blends_.row(2 * path_index);
    choice = sampling::unit_double(sampling::hash(path.key.sequence, path.key.index, depth, kShapeChoice));
  }
  const SurfaceRows rows = surface_rows(scene_, surface, choice, blend);
  if (rows.highest_reflectance + rows.highest_transmittance <= 0.0) return false;

  const geometry::SurfacePoint& hit = hits_[path_index];
  const Sides sides(-path.ray.direction, hit, surface.shading_normal);
  const std::uint32_t pair = 1u + 2u * static_cast<std::uint32_t>(depth);
  Scatter event;
  event.path = path_index;
  if (scene_.scene().sun && !rows.scattering->is_delta())
    send_to_sun(rows, sides, hit, sampling::sequence_point(path.key.sequence, path.key.index, pair), event);
  if (depth + 1 != options_.maximum_scatterings &&
      bounce(rows, sides, hit, sampling::sequence_point(path.key.sequence, path.key.index, pair + 1u), event) &&
      depth + 1 >= kCertainScatterings) {
    const double highest =
        event.bounce_factor == rows.reflectance ? rows.highest_reflectance : rows.highest_transmittance;
    const double chance = std::min(1.0, highest * event.bounce_weight);
    const bool survives =
        sampling::unit_double(sampling::hash(path.key.sequence, path.key.index, depth)) < chance;
    event.bounce_weight = survives ? static_cast<float>(event.bounce_weight / chance) : 0.0f;
  }
  if (event.shadow == kNone && !(event.bounce_weight > 0.0f)) return false;
  scatters_.push_back(event);
  return true;
}

void PathTracer::send_to_sun(const SurfaceRows& rows, const Sides& sides, const geometry::SurfacePoint& hit,
                             sampling::Point2 u, Scatter& event) {
  const bool transmits = rows.transmittance != nullptr;
  const math::Vec3 towards_sun = scene_.scene().sun->direction;
  const bool behind = transmits && math::dot(sides.outward, towards_sun) < 0.0;
  const math::Vec3 lit_side = behind ? -sides.shading.as_vector() : sides.shading.as_vector();
  const sampling::LightSample light = sample_sun(lit_side, transmits && !sides.bent, u);
  const double height = math::dot(light.direction, sides.outward);
  const bool through = transmits && height < 0.0;
  if (light.weight_sr <= 0.0 || (through ? height >= 0.0 : height <= 0.0)) return;

  // Light that a bent normal would take from below the surface comes mirrored from above it.
  const math::Vec3 normal = through ? -sides.shading.as_vector() : sides.shading.as_vector();
  const math::Vec3 viewer = through ? normal : sides.outgoing;  // what is let through looks alike from everywhere
  const math::Normal3 lobe = math::as_normal(normal);
  double weight = light.weight_sr * rows.scattering->evaluate(viewer, light.direction, lobe);
  if (sides.bent) {
    const math::Vec3 image = mirrored(light.direction, sides.outward);
    const double own = math::dot(normal, light.direction), below = math::dot(normal, image);
    if (own > 0.0 && below > 0.0)
      weight += light.weight_sr * rows.scattering->evaluate(viewer, image, lobe) * below / own;
  }
  if (weight <= 0.0) return;
  event.sun_weight = static_cast<float>(weight);
  event.sun_factor = through ? rows.transmittance : rows.reflectance;
  event.shadow = static_cast<std::uint32_t>(shadow_rays_.size());
  shadow_rays_.push_back(
      {hit.position_m + (through ? -hit.offset_m : hit.offset_m) * sides.outward, light.direction});
}

bool PathTracer::bounce(const SurfaceRows& rows, const Sides& sides, const geometry::SurfacePoint& hit,
                        sampling::Point2 u, Scatter& event) const {
  // The side is chosen so that no node's weight outgrows the sum of the two highest factors.
  double chance = 1.0;
  bool through = false;
  if (rows.transmittance != nullptr) {
    chance = rows.highest_reflectance / (rows.highest_reflectance + rows.highest_transmittance);
    through = !(u.x < chance);
    u.x = through ? (u.x - chance) / (1.0 - chance) : u.x / chance;
    if (through) chance = 1.0 - chance;
  }
  const math::Vec3 outward = through ? -sides.outward : sides.outward;
  const math::Normal3 lobe = through ? -sides.shading : sides.shading;
  const math::Vec3 viewer = through ? lobe.as_vector() : sides.outgoing;
  materials::ScatterSample sample = sample_bounce(*rows.scattering, viewer, lobe, sides.bent, u);
  if (sides.bent && math::dot(sample.incoming, outward) < 0.0) sample.incoming = mirrored(sample.incoming, outward);
  if (!(sample.weight > 0.0) || !(math::dot(sample.incoming, outward) > 0.0)) return false;
  event.bounce_weight = static_cast<float>(sample.weight / chance);
  event.bounce_factor = through ? rows.transmittance : rows.reflectance;
  event.next = {hit.position_m + hit.offset_m * outward, sample.incoming};
  event.next_sees_sun = rows.scattering->is_delta();
  return true;
}

/// Under a sky that is brighter here than there, some directions are drawn from the sky and all weigh by the density of
/// both (Veach and Guibas 1995, one sample, balance heuristic): those that see the sky weigh almost alike.
materials::ScatterSample PathTracer::sample_bounce(const materials::Scattering& scattering, math::Vec3 viewer,
                                                   math::Normal3 lobe, bool bent, sampling::Point2 u) const {
  const double height = lobe.as_vector().z;
  const double share = sky_ == nullptr || bent || scattering.is_delta() || height <= 0.0
                           ? 0.0
                           : kMostSkySamples * height * height;
  if (share == 0.0) return scattering.sample(viewer, lobe, u.x, u.y);
  materials::ScatterSample sample;
  if (u.x < share)
    sample.incoming = sky_->sample({u.x / share, u.y});
  else
    sample = scattering.sample(viewer, lobe, (u.x - share) / (1.0 - share), u.y);
  const double cosine = math::dot(lobe.as_vector(), sample.incoming);
  sample.pdf =
      (1.0 - share) * scattering.pdf(viewer, sample.incoming, lobe) + share * sky_->density(sample.incoming);
  sample.weight = cosine > 0.0 && sample.pdf > 0.0
                      ? scattering.evaluate(viewer, sample.incoming, lobe) * cosine / sample.pdf
                      : 0.0;
  return sample;
}

sampling::LightSample PathTracer::sample_sun(math::Vec3 normal, bool either_side, sampling::Point2 u) const {
  // Weights are relative to the irradiance of a surface that faces the Sun.
  const scene::Sun& sun = *scene_.scene().sun;
  if (sun.half_angle_rad <= 0.0) return {sun.direction, std::max(0.0, math::dot(sun.direction, normal))};
  sampling::LightSample sample = disc_->sample(sun.direction, normal, u);
  const double sine = std::sin(sun.half_angle_rad);
  // Cut by the horizon, the disc is sampled whole: what is below lights the other side.
  if (either_side && !disc_->uncut(sun.direction, normal))
    sample.weight_sr = disc_->solid_angle_sr() * std::abs(math::dot(sample.direction, normal));
  sample.weight_sr /= std::numbers::pi * sine * sine;
  return sample;
}

}  // namespace ifov::render
