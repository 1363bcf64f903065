#include "exposure/surfaces_of_times.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "exposure/exposed_point.h"
#include "exposure/solved_surface.h"
#include "geometry/surface_point.h"
#include "sampling/random.h"
#include "scene/scene.h"

namespace ifov::exposure {
namespace {

using thermal::ClassesOfTimes;

enum class Asked { sky, sun };

struct Pairs {
  ClassesOfTimes::At at;
  std::vector<math::Vec3> directions;
  std::array<PastSuns::Set, 2> suns;  // their first and second rays
  std::vector<std::uint8_t> is_free;
  std::vector<float> kelvin, variance;   // by lane
  std::vector<float> weight_k, weights;  // by bin and lane; by ray and lane
  std::vector<float> bends, sums;        // by bin and lane; six by lane
};

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

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

/// Of a bin whose rays do not see the same: by lane f of the ray that sees the Sun, and of the other.
struct Disagreement {
  std::size_t bin;
  const float *lit, *dark;
};

/// By lane what pairs of gains take from each other. Of each bin there are two estimates of what was seen, e_1 = V_2 W + f_1 (V_1 - V_2)
/// and e_2 the other way round, and of what was hidden; both without bias, and W where the rays see the same. What one estimate says
/// was seen goes with what the other says was hidden: in other bins it does not depend on it, and in the same one it is f_1 V_1 f_2 (1 - V_2).
void add_bends(Pairs& pairs, std::span<const Disagreement> disagreements, std::size_t bins,
               std::size_t lanes) {
  pairs.sums.assign(6 * lanes, 0.0f);
  float* __restrict kelvin = pairs.kelvin.data();
  // Of both estimates together where bins agree, then the first pair's and the second's where they do not.
  float* __restrict seen = pairs.sums.data(), * __restrict hidden = seen + lanes;
  float* __restrict seen_1 = hidden + lanes, * __restrict hidden_1 = seen_1 + lanes;
  float* __restrict seen_2 = hidden_1 + lanes, * __restrict hidden_2 = seen_2 + lanes;
  auto next = disagreements.begin();
  for (std::size_t b = 0; b < bins; ++b) {
    const std::size_t first = pairs.at.first_lane(b);
    const float* __restrict bend = pairs.bends.data() + b * lanes;
    const float* __restrict weight = pairs.weight_k.data() + b * lanes;
    if (next == disagreements.end() || next->bin != b) {
      const bool sees = pairs.is_free[2 * b] != 0;
      float* __restrict mine = sees ? seen : hidden, * __restrict both = sees ? hidden : seen, * __restrict one = sees ? hidden_1 : seen_1, * __restrict other = sees ? hidden_2 : seen_2;
      for (std::size_t t = first; t < lanes; ++t) {
        kelvin[t] -= 0.25f * bend[t] * weight[t] * (2.0f * both[t] + one[t] + other[t]);
        mine[t] += weight[t];
      }
      continue;
    }
    const float* __restrict lit = next->lit, * __restrict dark = next->dark;
    for (std::size_t t = first; t < lanes; ++t) {
      const float lit_2 = weight[t] - dark[t], dark_2 = weight[t] - lit[t];
      const float of_first = lit[t] * (hidden[t] + hidden_1[t] + dark[t]) + dark[t] * (seen[t] + seen_1[t]);
      const float of_second = lit_2 * (hidden[t] + hidden_2[t]) + dark_2 * (seen[t] + seen_2[t]);
      kelvin[t] -= 0.25f * bend[t] * (of_first + of_second);
      seen_1[t] += lit[t];
      hidden_1[t] += dark[t];
      seen_2[t] += lit_2;
      hidden_2[t] += dark_2;
    }
    ++next;
  }
}

/// What the Sun is worth where some rays saw it and others did not.
void add_mixed(Pairs& pairs, std::size_t bins, std::size_t lanes) {
  pairs.weight_k.resize(bins * lanes);
  pairs.at.weights(pairs.weight_k);
  pairs.weights.resize(2 * bins * lanes);
  static thread_local std::vector<Disagreement> disagreements;
  disagreements.clear();
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
    float* const of_lit = pairs.weights.data() + 2 * b * lanes;
    float* const of_dark = of_lit + lanes;
    pairs.at.weigh(pairs.suns[first ? 0 : 1][b].moment, {of_lit, lanes});
    pairs.at.weigh(pairs.suns[first ? 1 : 0][b].moment, {of_dark, lanes});
    disagreements.push_back({b, of_lit, of_dark});
    for (std::size_t t = from; t < lanes; ++t) {
      const float lit = of_lit[t], dark = of_dark[t];
      kelvin[t] += 0.5f * weight[t] + 0.5f * (lit - dark);
      variance[t] += 0.25f * (lit * lit + dark * dark - weight[t] * weight[t]);
    }
  }
  pairs.bends.resize(bins * lanes);
  pairs.at.bends(pairs.weight_k, pairs.bends);
  add_bends(pairs, disagreements, bins, lanes);
}

}  // namespace

SurfacesOfTimes::SurfacesOfTimes(const std::map<std::size_t, ByTime>& by_number, PastScene scene,
                                 double sun_radius_rad)
    : scene_(std::move(scene)), times_(by_number.begin()->second.size()) {
  classes_.resize(by_number.rbegin()->first + 1);
  suns_.resize(classes_.size());
  for (const auto& [number, by_time] : by_number) {
    classes_[number] = std::make_unique<const ClassesOfTimes>(by_time);
    suns_[number] = std::make_unique<const PastSuns>(*classes_[number], sun_radius_rad);
  }
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
  pairs.suns = suns_[number]->draw(sampling::hash(key, Asked::sun));
  for (std::size_t b = 0; b < bins; ++b)
    for (const PastSuns::Set& set : pairs.suns) pairs.directions.push_back(set[b].direction());
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
