#include "exposure/surfaces_of_times.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "exposure/exposed_point.h"
#include "exposure/solved_surface.h"
#include "geometry/surface_point.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "scene/scene.h"

namespace ifov::exposure {
namespace {

using thermal::ClassesOfTimes;

enum class Asked { sky, sun };

struct Pairs {
  ClassesOfTimes::At at;
  std::vector<math::Vec3> directions;
  std::vector<ClassesOfTimes::Moment> moments;
  std::vector<std::uint8_t> is_free;
  std::vector<float> kelvin, variance;    // by lane
  std::vector<float> weight_k, weights;   // by bin and lane; by ray and lane
  std::vector<float> bends, lit, hidden;  // by bin and lane; by lane
};

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

// Two numbers in [0, 1) of one word: of a time within a step, and of a place on the Sun's disc, 32 bits tell more than enough.
double upper_half(std::uint64_t word) { return static_cast<double>(word >> 32) * 0x1p-32; }
double lower_half(std::uint64_t word) { return static_cast<double>(word & 0xffffffffu) * 0x1p-32; }

/// A direction to the Sun's disc, as if that were flat: within 1e-5 of uniform. `sun` has the length 1.
math::Vec3 within_disc(math::Vec3 sun, double radius_rad, std::uint64_t key) {
  double x, y;
  do {
    key = sampling::extend(key, 0);
    x = 2.0 * upper_half(key) - 1.0, y = 2.0 * lower_half(key) - 1.0;
  } while (x * x + y * y > 1.0);
  const sampling::TangentFrame frame(sun);
  const math::Vec3 beside = (radius_rad * x) * frame.first + (radius_rad * y) * frame.second;
  // Across the axis: the length is known, and its root but for 1e-9.
  return (1.0 - 0.5 * math::dot(beside, beside)) * (sun + beside);
}

/// By lane what pairs of gains take from each other, of the visibilities of rays `lit` and the hiding of rays `hidden` (0, 1: the
/// first, the second of each bin), each with w_k at its own time.
void add_bends(Pairs& pairs, std::size_t bins, std::size_t lanes, std::size_t lit, std::size_t hidden) {
  pairs.lit.assign(lanes, 0.0f);
  pairs.hidden.assign(lanes, 0.0f);
  float *__restrict kelvin = pairs.kelvin.data(), *__restrict before = pairs.lit.data(),
        *__restrict dark = pairs.hidden.data();
  bool any_lit = false, any_hidden = false;
  for (std::size_t b = 0; b < bins; ++b) {
    const std::size_t first = pairs.at.first_lane(b);
    const float* __restrict bend = pairs.bends.data() + b * lanes;
    const float* __restrict light = pairs.weights.data() + (2 * b + lit) * lanes;
    const float* __restrict shade = pairs.weights.data() + (2 * b + hidden) * lanes;
    const bool sees = pairs.is_free[2 * b + lit] != 0, hides = pairs.is_free[2 * b + hidden] == 0;
    if (sees && hides)
      for (std::size_t t = first; t < lanes; ++t)
        kelvin[t] -= 0.25f * bend[t] * (light[t] * (dark[t] + shade[t]) + shade[t] * before[t]);
    else if (sees && any_hidden)
      for (std::size_t t = first; t < lanes; ++t) kelvin[t] -= 0.25f * bend[t] * light[t] * dark[t];
    else if (hides && any_lit)
      for (std::size_t t = first; t < lanes; ++t) kelvin[t] -= 0.25f * bend[t] * shade[t] * before[t];
    if (sees)
      for (std::size_t t = first; t < lanes; ++t) before[t] += light[t];
    if (hides)
      for (std::size_t t = first; t < lanes; ++t) dark[t] += shade[t];
    any_lit = any_lit || sees;
    any_hidden = any_hidden || hides;
  }
}

/// A Sun behind the surface warms nothing. What is said of it is what is seen in the nearest bin whose Sun stands before it, which this
/// bin's rays do not depend on: where all are alike, nothing is uncertain.
void see_behind(Pairs& pairs, math::Vec3 normal) {
  const std::size_t bins = pairs.directions.size() / 2;
  const auto behind = [&](std::size_t ray) { return !(math::dot(pairs.directions[ray], normal) > 0.0); };
  std::size_t ray = 0;
  while (ray < 2 * bins && !behind(ray)) ++ray;
  if (ray == 2 * bins) return;
  static thread_local std::vector<std::uint8_t> seen;
  seen = pairs.is_free;
  const auto nearest = [&](std::size_t bin) -> std::uint8_t {
    for (std::size_t apart = 1; apart < bins; ++apart)
      for (const std::size_t other : {bin - apart, bin + apart})
        if (other < bins && !behind(2 * other)) return seen[2 * other];
    return 1;
  };
  for (; ray < 2 * bins; ++ray)
    if (behind(ray)) pairs.is_free[ray] = nearest(ray / 2);
}

/// What the Sun is worth where some rays saw it and others did not.
void add_mixed(Pairs& pairs, std::size_t bins, std::size_t lanes) {
  pairs.weight_k.resize(bins * lanes);
  pairs.at.weights(pairs.weight_k);
  pairs.weights.resize(2 * bins * lanes);
  for (std::size_t ray = 0; ray < 2 * bins; ++ray)
    pairs.at.weigh(pairs.moments[ray], {pairs.weights.data() + ray * lanes, lanes});
  for (std::size_t b = 0; b < bins; ++b) {
    const std::size_t from = pairs.at.first_lane(b);
    const bool first = pairs.is_free[2 * b] != 0, second = pairs.is_free[2 * b + 1] != 0;
    const float* __restrict weight = pairs.weight_k.data() + b * lanes;
    float* __restrict kelvin = pairs.kelvin.data(), * __restrict variance = pairs.variance.data();
    if (first == second) {
      if (first)
        for (std::size_t t = from; t < lanes; ++t) kelvin[t] += weight[t];
      continue;
    }
    const float* __restrict of_first = pairs.weights.data() + 2 * b * lanes;
    const float* __restrict of_second = of_first + lanes;
    const float sign = first ? 0.5f : -0.5f;
    for (std::size_t t = from; t < lanes; ++t) {
      const float one = of_first[t], other = of_second[t];
      kelvin[t] += 0.5f * weight[t] + sign * (one - other);
      variance[t] += 0.25f * (one * one + other * other - weight[t] * weight[t]);
    }
  }
  pairs.bends.resize(bins * lanes);
  pairs.at.bends(pairs.weight_k, pairs.bends);
  add_bends(pairs, bins, lanes, 0, 1);
  add_bends(pairs, bins, lanes, 1, 0);
}

}  // namespace

SurfacesOfTimes::SurfacesOfTimes(const std::map<std::size_t, ByTime>& by_number, PastScene scene,
                                 double sun_radius_rad)
    : scene_(std::move(scene)), sun_radius_rad_(sun_radius_rad), times_(by_number.begin()->second.size()) {
  classes_.resize(by_number.rbegin()->first + 1);
  for (const auto& [number, by_time] : by_number)
    classes_[number] = std::make_unique<const ClassesOfTimes>(by_time);
}

std::unique_ptr<const SurfacesOfTimes> SurfacesOfTimes::of(std::span<const scene::Scene* const> by_time) {
  std::map<std::size_t, ByTime> by_number;
  const SolvedSurface* any = nullptr;
  for (const scene::Scene* scene : by_time) {
    if (scene->world != by_time.front()->world || scene->solved.size() != by_time.front()->solved.size())
      return nullptr;
    for (std::size_t number = 0; number < scene->solved.size(); ++number) {
      const auto* surface = dynamic_cast<const SolvedSurface*>(scene->solved[number].get());
      if (surface == nullptr) continue;
      if (surface->scene().changes()) return nullptr;
      by_number[number].push_back(surface->shared_classes());
      if (any == nullptr) any = surface;
    }
  }
  if (any == nullptr) return nullptr;
  for (const auto& [number, classes] : by_number)
    if (classes.size() != by_time.size() || !ClassesOfTimes::serves(classes)) return nullptr;
  return std::make_unique<const SurfacesOfTimes>(by_number, any->scene(), any->sun_radius_rad());
}

void SurfacesOfTimes::at(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t draw,
                         std::span<scene::EstimatedTemperature> by_time) const {
  static thread_local Pairs pairs;
  const ClassesOfTimes& classes = *classes_[number];
  const std::size_t lanes = classes.lanes(), bins = classes.bins();
  const std::uint64_t key = sampling::hash(draw, bits_of(point.position_m.x), bits_of(point.position_m.y),
                                           bits_of(point.position_m.z), point.front);
  const ExposedPoint exposed(scene_, point);
  exposed.sky_directions(sampling::hash(key, Asked::sky), kSkyPairs, pairs.directions);
  double sky = 1.0, sky_variance = 0.0;
  if (const std::size_t count = pairs.directions.size(); count > 0) {
    pairs.is_free.resize(count);
    exposed.free(pairs.directions, {}, pairs.is_free);
    sky = 0.0;
    for (std::size_t k = 0; k + 1 < count; k += 2) {
      sky += static_cast<double>(pairs.is_free[k] + pairs.is_free[k + 1]) / static_cast<double>(count);
      if (pairs.is_free[k] != pairs.is_free[k + 1]) sky_variance += 1.0 / static_cast<double>(count * count);
    }
  }
  classes.at(exposed.pose(), sky, pairs.at);
  pairs.directions.clear();
  pairs.moments.clear();
  for (std::size_t k = 0; k < 2 * bins; ++k) {
    const std::uint64_t own = sampling::hash(key, Asked::sun, k);
    const ClassesOfTimes::Moment moment = classes.draw(k / 2, upper_half(own), lower_half(own));
    pairs.moments.push_back(moment);
    pairs.directions.push_back(within_disc(classes.towards_sun(moment), sun_radius_rad_, own));
  }
  pairs.is_free.resize(2 * bins);
  if (bins > 0) exposed.free(pairs.directions, {}, pairs.is_free);
  see_behind(pairs, exposed.normal());
  pairs.kelvin = pairs.at.shaded_k;
  pairs.variance.resize(lanes);
  for (std::size_t t = 0; t < lanes; ++t)
    pairs.variance[t] = static_cast<float>(sky_variance) * pairs.at.of_sky_k[t] * pairs.at.of_sky_k[t];
  const auto seen =
      static_cast<std::size_t>(std::count(pairs.is_free.begin(), pairs.is_free.end(), std::uint8_t{1}));
  if (seen > 0 && seen < 2 * bins)
    add_mixed(pairs, bins, lanes);
  else if (seen > 0)
    for (std::size_t t = 0; t < lanes; ++t) pairs.kelvin[t] += pairs.at.all_k[t];
  for (std::size_t t = 0; t < by_time.size(); ++t)
    by_time[t] = {static_cast<double>(pairs.kelvin[t]),
                  std::sqrt(std::max(0.0, static_cast<double>(pairs.variance[t])))};
}

}  // namespace ifov::exposure
