#include "transport/path_light.h"

#include <cmath>
#include <cstring>

#include "math/vec3.h"
#include "transport/mirrors/sun_disc.h"
#include "transport/sky/adjacent_ground.h"
#include "transport/sky/sky_dome.h"
#include "transport/spectral_scene.h"
#include "transport/spectrum_arithmetic.h"

namespace ifov::transport {

PathLight::PathLight(const SpectralScene& scene) : scene_(scene), n_(scene.stride()) {
  static_assert(kMoreWork == kWork + 1);  // which directional spectra are worked out in
  spectra_.resize(kSpectra, scene.node_count());
  sum_ = spectrum(kSum);
}

float* PathLight::radiance(const PathRecord& record, std::size_t k) {
  one(record, k);
  std::uint32_t also = record.paths[k].also;
  if (also == PathVertex::kNone) return spectrum(kSum);
  float* whole = spectrum(kWhole);
  std::memcpy(whole, spectrum(kSum), n_ * sizeof(float));
  for (; also != PathVertex::kNone; also = record.paths[also].also) {
    if (record.paths[also].empty()) continue;
    one(record, also);
    spectra::add_scaled(whole, spectrum(kSum), 1.0f, n_);
  }
  return whole;
}

void PathLight::one(const PathRecord& record, std::size_t k) {
  const PathRecord::Path& path = record.paths[k];
  if (path.first == PathVertex::kNone) {
    std::memset(spectrum(kSum), 0, n_ * sizeof(float));
  } else {
    add_first(record, record.vertices[path.first]);
  }
  later(record, path);
}

void PathLight::later(const PathRecord& record, const PathRecord::Path& path, OpenSky open_sky) {
  if (path.sky_share > 0.0f) add_open_sky(record, path, record.vertices[path.first], open_sky);
  if (path.first != PathVertex::kNone)
    for (std::uint32_t k = record.vertices[path.first].next; k != PathVertex::kNone;
         k = record.vertices[k].next) {
      come_to(record, record.vertices[k]);
      add_later(record, record.vertices[k]);
    }
  if (path.escaped) add_escaped(path);
}

PathLight::Levels PathLight::levels(const PathRecord& record, std::size_t k, bool whole) {
  const PathRecord::Path& path = record.paths[k];
  float *direct = spectrum(kDirect), *sum = spectrum(kSum);
  const bool met = path.first != PathVertex::kNone;
  if (met) {
    add_first(record, record.vertices[path.first], whole);
    if (path.sky_share > 0.0f) add_open_sky(record, path, record.vertices[path.first], OpenSky::integral);
  } else {
    one(record, k);
  }
  if (!whole) return {sum, nullptr};
  std::memcpy(direct, sum, n_ * sizeof(float));
  std::memset(sum, 0, n_ * sizeof(float));
  if (met) later(record, path, OpenSky::drawn);
  if (path.also == PathVertex::kNone) return {direct, sum};
  float* rest = spectrum(kWhole);
  std::memcpy(rest, sum, n_ * sizeof(float));
  for (std::uint32_t also = path.also; also != PathVertex::kNone; also = record.paths[also].also) {
    if (record.paths[also].empty()) continue;
    one(record, also);
    spectra::add_scaled(rest, sum, 1.0f, n_);
  }
  return {direct, rest};
}

const float* PathLight::left_by(const PathRecord::Segment& segment) {
  const float* __restrict per_m = scene_.absorption(segment.medium.material);
  float* __restrict left = spectrum(kSegment);
  const float length = static_cast<float>(segment.length_m);
  for (std::size_t i = 0; i < n_; ++i) left[i] = std::exp(-per_m[i] * length);
  return left;
}

void PathLight::come_through(const PathRecord::Segment& segment, bool shines) {
  const float* __restrict left = left_by(segment);
  float* __restrict throughput = spectrum(kThroughput), * __restrict sum = sum_;
  const float* black = shines ? scene_.black(segment.medium, spectrum(kBlack)) : nullptr;
  if (black != nullptr)
    for (std::size_t i = 0; i < n_; ++i) sum[i] += throughput[i] * (1.0f - left[i]) * black[i];
  for (std::size_t i = 0; i < n_; ++i) throughput[i] *= left[i];
}

const float* PathLight::factor(const PathRecord& record, const PathRecord::Mirrored::Factor& factor,
                               bool transmitted) {
  if (factor.spectrum != nullptr) return factor.spectrum;
  const PathRecord::Mixed& mixed = record.mixed[factor.mixed];
  const LobeEvent* event = factor.event == PathVertex::kNone ? nullptr : &record.way_events[factor.event];
  return lobe_factor(scene_, mixed.surface, mixed.lobe, transmitted, event, spectrum(kDimmed),
                     spectrum(kWork));
}

void PathLight::dim(const PathRecord& record, std::uint32_t passes, float* light) {
  for (std::uint32_t k = passes; k != PathVertex::kNone; k = record.passes[k].next) {
    const PathRecord::Pass& pass = record.passes[k];
    const float* left = pass.segment != PathVertex::kNone ? left_by(record.segments[pass.segment])
                                                          : factor(record, pass.factor, true);
    for (std::size_t i = 0; i < n_; ++i) light[i] *= left[i];
  }
}

const float* PathLight::sunlight(const PathRecord& record, const PathVertex& vertex) {
  const float* sun = scene_.sun_irradiance(vertex.height_m, spectrum(kSun));
  if (vertex.sun_passes == PathVertex::kNone) return sun;
  float* dimmed = spectrum(kSunlight);
  std::memcpy(dimmed, sun, n_ * sizeof(float));
  dim(record, vertex.sun_passes, dimmed);
  return dimmed;
}

float* PathLight::first_sunlight(const PathRecord& record, std::size_t k) {
  float* sum = spectrum(kSum);
  const std::uint32_t first = record.paths[k].first;
  if (first == PathVertex::kNone || record.vertices[first].sun_weight <= 0.0f) {
    std::memset(sum, 0, n_ * sizeof(float));
    return sum;
  }
  const PathVertex& vertex = record.vertices[first];
  spectra::scaled_product(sum, sun_factor(record, vertex), sunlight(record, vertex), vertex.sun_weight, n_);
  return sum;
}

void PathLight::add_first(const PathRecord& record, const PathVertex& vertex, bool goes_on) {
  float *sum = sum_, *throughput = spectrum(kThroughput);
  const float* emitted = vertex.emission_weight > 0.0f ? emission(record, vertex) : nullptr;
  const float* factor = nullptr;
  if (vertex.sun_weight > 0.0f) {
    factor = sun_factor(record, vertex);
    const float* sun = sunlight(record, vertex);
    if (emitted != nullptr)
      spectra::sum_of_scaled_product(sum, emitted, factor, sun, vertex.sun_weight, n_);
    else
      spectra::scaled_product(sum, factor, sun, vertex.sun_weight, n_);
  } else if (emitted != nullptr) {
    std::memcpy(sum, emitted, n_ * sizeof(float));
  } else {
    std::memset(sum, 0, n_ * sizeof(float));
  }
  if (vertex.sought_weight > 0.0f) add_sought(record, vertex, nullptr);
  if (vertex.mirrored != PathVertex::kNone) add_mirrored(record, vertex, nullptr);
  if (goes_on && vertex.continuation_weight > 0.0f)
    spectra::set_scaled(throughput, continuation_factor(record, vertex, factor), vertex.continuation_weight,
                        n_);
}

void PathLight::add_open_sky(const PathRecord& record, std::size_t k, float* to) {
  const PathRecord::Path& path = record.paths[k];
  if (path.sky_share <= 0.0f) return;
  sum_ = to;
  add_open_sky(record, path, record.vertices[path.first]);
  sum_ = spectrum(kSum);
}

const float* PathLight::open_sky(math::Vec3 normal) {
  float* open = spectrum(kOpenSky);
  const math::Vec3& known = open_sky_normal_;
  if (normal.x == known.x && normal.y == known.y && normal.z == known.z) return open;
  const SkyIrradiance::Corners corners = scene_.sky_dome()->irradiance(normal);
  spectra::sum_of_scaled(open, corners.spectrum.data(), corners.weight.data(), n_);
  open_sky_normal_ = normal;
  return open;
}

void PathLight::add_open_sky(const PathRecord& record, const PathRecord::Path& path, const PathVertex& vertex,
                             OpenSky which) {
  float *sum = sum_, *difference = spectrum(kDimmed), *drawn = spectrum(kWork);
  const bool is_drawn = vertex.continuation_weight > 0.0f && path.left_first.z >= 0.0;
  if (which == OpenSky::drawn) {
    if (!is_drawn) return;
    std::memset(difference, 0, n_ * sizeof(float));
  } else {
    std::memcpy(difference, open_sky(path.first_normal), n_ * sizeof(float));
  }
  if (is_drawn && which != OpenSky::integral) {
    const SkyDome::Corners sky = scene_.sky_dome()->at(path.left_first);
    spectra::sum_of_scaled(drawn, sky.spectrum.data(), sky.weight.data(), n_);
    spectra::add_scaled(difference, drawn, -vertex.continuation_weight, n_);
  }
  if (scene_.light_by_height()) {
    const float* left = scene_.sky_share(vertex.height_m, spectrum(kSkyShare));
    for (std::size_t i = 0; i < n_; ++i) difference[i] *= left[i];
  }
  brighten(path, difference);
  spectra::add_scaled_product(sum, continuation_factor(record, vertex, nullptr), difference, path.sky_share,
                              n_);
}

void PathLight::add_later(const PathRecord& record, const PathVertex& vertex) {
  float *sum = sum_, *throughput = spectrum(kThroughput);
  if (vertex.emission_weight == 1.0f) {
    if (const float* emitted = emission(record, vertex)) spectra::add_product(sum, throughput, emitted, n_);
  } else if (vertex.emission_weight > 0.0f) {
    if (const float* emitted = emission(record, vertex))
      spectra::add_scaled_product(sum, throughput, emitted, vertex.emission_weight, n_);
  }
  if (vertex.sought_weight > 0.0f) add_sought(record, vertex, throughput);
  if (vertex.mirrored != PathVertex::kNone) add_mirrored(record, vertex, throughput);
  const bool goes_on = vertex.continuation_weight > 0.0f;
  const float* factor = nullptr;
  if (vertex.sun_weight > 0.0f) {
    factor = sun_factor(record, vertex);
    const float* sun = sunlight(record, vertex);
    if (goes_on && vertex.sun_transmitted == vertex.continuation_transmitted &&
        !is_directional(record, vertex)) {
      spectra::add_and_scale(sum, throughput, factor, sun, vertex.sun_weight, vertex.continuation_weight, n_);
      return;
    }
    spectra::add_scaled_product(sum, throughput, factor, sun, vertex.sun_weight, n_);
  }
  if (goes_on)
    spectra::scale(throughput, continuation_factor(record, vertex, factor), vertex.continuation_weight, n_);
}

/// `throughput` null: 1.
void PathLight::add_sought(const PathRecord& record, const PathVertex& vertex, const float* throughput) {
  const float* factor = vertex.sought_factor;
  if (vertex.mixed != PathVertex::kNone) {
    const PathRecord::Mixed& mixed = record.mixed[vertex.mixed];
    factor = lobe_factor(scene_, mixed.surface, mixed.lobe, vertex.sought_transmitted,
                         mixed.events == PathVertex::kNone ? nullptr : &record.events[mixed.events].sought,
                         spectrum(kSoughtFactor), spectrum(kWork));
  }
  const float* emitted = vertex.sought_emission;
  if (vertex.sought_mixed != PathVertex::kNone) emitted = emission(record.mixed[vertex.sought_mixed]);
  if (emitted == nullptr) return;
  if (vertex.sought_passes != PathVertex::kNone) {
    float* dimmed = spectrum(kSoughtLight);
    std::memcpy(dimmed, emitted, n_ * sizeof(float));
    dim(record, vertex.sought_passes, dimmed);
    emitted = dimmed;
  }
  if (throughput != nullptr)
    spectra::add_scaled_product(sum_, throughput, factor, emitted, vertex.sought_weight, n_);
  else
    spectra::add_scaled_product(sum_, factor, emitted, vertex.sought_weight, n_);
}

const float* PathLight::emission(const PathRecord& record, const PathVertex& vertex) {
  if (vertex.mixed == PathVertex::kNone) return vertex.emission;
  return emission(record.mixed[vertex.mixed]);
}

const float* PathLight::emission(const PathRecord::Mixed& mixed) {
  static_assert(kEmissionPart == kEmission + 1 &&
                kEmissionWork == kEmission + 2);  // which spectra are worked out in
  return scene_.emission(mixed.surface, mixed.outgoing, spectrum(kEmission));
}

const float* PathLight::sun_factor(const PathRecord& record, const PathVertex& vertex) {
  if (vertex.mixed == PathVertex::kNone) return vertex.sun_factor;
  const PathRecord::Mixed& mixed = record.mixed[vertex.mixed];
  return lobe_factor(scene_, mixed.surface, mixed.lobe, vertex.sun_transmitted,
                     mixed.events == PathVertex::kNone ? nullptr : &record.events[mixed.events].sun,
                     spectrum(kSunFactor), spectrum(kWork));
}

const float* PathLight::continuation_factor(const PathRecord& record, const PathVertex& vertex,
                                            const float* sun) {
  if (vertex.mixed == PathVertex::kNone) return vertex.continuation_factor;
  const PathRecord::Mixed& mixed = record.mixed[vertex.mixed];
  const bool directional = mixed.events != PathVertex::kNone;
  if (sun != nullptr && vertex.sun_transmitted == vertex.continuation_transmitted && !directional) return sun;
  return lobe_factor(scene_, mixed.surface, mixed.lobe, vertex.continuation_transmitted,
                     directional ? &record.events[mixed.events].continuation : nullptr,
                     spectrum(kContinuationFactor), spectrum(kWork));
}

void PathLight::add_mirrored(const PathRecord& record, const PathVertex& vertex, const float* throughput) {
  float* way = spectrum(kMirrored);
  const auto times = [&](const PathRecord::Mirrored::Factor& one, bool transmitted) {
    const float* values = factor(record, one, transmitted);
    for (std::size_t i = 0; i < n_; ++i) way[i] *= values[i];
  };
  for (std::uint32_t k = vertex.mirrored; k != PathVertex::kNone; k = record.mirrored[k].next) {
    const PathRecord::Mirrored& light = record.mirrored[k];
    const float* source = nullptr;
    if (!light.emitted)
      source = scene_.sun_irradiance(light.height_m, spectrum(kSkyShare));
    else
      source = light.emission_mixed == PathVertex::kNone ? light.emission
                                                         : emission(record.mixed[light.emission_mixed]);
    if (source == nullptr) continue;
    spectra::set_scaled(way, source, light.weight, n_);
    times(light.surface, light.transmitted);
    for (std::size_t m = 0; m < light.count; ++m) times(light.mirrors[m], false);
    dim(record, light.passes, way);
    if (throughput != nullptr)
      spectra::add_product(sum_, throughput, way, n_);
    else
      spectra::add_scaled(sum_, way, 1.0f, n_);
  }
}

void PathLight::brighten(const PathRecord::Path& path, float* light) const {
  if (const AdjacentGround* adjacent = scene_.adjacent_ground())
    adjacent->brighten(path.seen_x_m, path.seen_y_m, light);
}

void PathLight::add_escaped(const PathRecord::Path& path) {
  add_sky(path);
  add_disc(path);
}

void PathLight::add_sky(const PathRecord::Path& path) {
  const bool direct = path.first == PathVertex::kNone;
  const math::Vec3 direction = path.escaped_direction;
  float *sum = sum_, *throughput = spectrum(kThroughput);
  const SkyDome* dome = scene_.sky_dome();
  if (dome != nullptr && direction.z >= 0.0) {
    const SkyDome::Corners sky = dome->at(direction);
    if (direct) {
      spectra::sum_of_scaled(sum, sky.spectrum.data(), sky.weight.data(), n_);
    } else if (scene_.light_by_height()) {
      const float* share = scene_.sky_share(path.escaped_from_m, spectrum(kSkyShare));
      spectra::set_product(spectrum(kDimmed), throughput, share, n_);
      brighten(path, spectrum(kDimmed));
      spectra::add_product_of_scaled(sum, spectrum(kDimmed), sky.spectrum.data(), sky.weight.data(), n_);
    } else if (scene_.adjacent_ground() != nullptr) {
      std::memcpy(spectrum(kDimmed), throughput, n_ * sizeof(float));
      brighten(path, spectrum(kDimmed));
      spectra::add_product_of_scaled(sum, spectrum(kDimmed), sky.spectrum.data(), sky.weight.data(), n_);
    } else {
      spectra::add_product_of_scaled(sum, throughput, sky.spectrum.data(), sky.weight.data(), n_);
    }
  } else {
    const float* light = direction.z < 0.0 ? scene_.surroundings_radiance(direction, spectrum(kDimmed))
                                           : scene_.sky_radiance();
    if (direct)
      std::memcpy(sum, light, n_ * sizeof(float));
    else
      spectra::add_product(sum, throughput, light, n_);
  }
}

void PathLight::add_disc(const PathRecord::Path& path) {
  if (!path.escaped_sees_sun) return;
  const auto per_irradiance = static_cast<float>(sun_disc_radiance(scene_.scene(), path.escaped_direction));
  if (!(per_irradiance > 0.0f)) return;
  if (path.first == PathVertex::kNone)
    spectra::add_scaled(sum_, scene_.sun_irradiance(), per_irradiance, n_);
  else
    spectra::add_scaled_product(sum_, spectrum(kThroughput), scene_.sun_irradiance(), per_irradiance, n_);
}

}  // namespace ifov::transport
