#include "exposure/surfaces_of_times.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "exposure/exposed_point.h"
#include "exposure/past_suns.h"
#include "exposure/point_rays.h"
#include "exposure/shared_surfaces.h"
#include "exposure/solved_surface.h"
#include "geometry/surface_point.h"
#include "sampling/random.h"
#include "scene/scene.h"

namespace ifov::exposure {
namespace {

using thermal::ClassesOfTimes;

enum class Asked { sky, sun, beside, below, asked };

constexpr std::size_t kShareRows = 8;         // times
constexpr double kLeastBelowHorizon = 0.002;  // of the view

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

/// Of some times the most.
thermal::SurfaceClasses::AtStake at_stake(const ClassesOfTimes& classes, const thermal::Pose& pose) {
  constexpr std::size_t kSome = 4;
  thermal::SurfaceClasses::AtStake most;
  for (std::size_t t = 0; t < classes.times(); t += (classes.times() + kSome - 1) / kSome) {
    const auto one = classes.of_time(t).at_stake(classes.of_time(t).corners(pose));
    most.of_sky_k = std::max(most.of_sky_k, std::abs(one.of_sky_k));
  }
  return most;
}

}  // namespace

/// By ray and time: what it meets that is not sky; those to the sky first, then two to below the horizon.
struct SurfacesOfTimes::Beside {
  std::vector<Neighbours::Change> changes;
  std::size_t above = 0, below = 0;  ///< rays
};

SurfacesOfTimes::SurfacesOfTimes(const std::map<std::size_t, ByTime>& by_number, PastScene scene,
                                 double sun_radius_rad,
                                 std::vector<std::shared_ptr<const Neighbours>> neighbours)
    : neighbours_(std::move(neighbours)), scene_(std::move(scene)), times_(by_number.begin()->second.size()) {
  classes_.resize(by_number.rbegin()->first + 1);
  suns_.resize(classes_.size());
  for (const auto& [number, by_time] : by_number) {
    classes_[number] = std::make_unique<const ClassesOfTimes>(by_time);
    suns_[number] = std::make_unique<const PastSuns>(*classes_[number], sun_radius_rad);
  }
  if (neighbours_.empty()) return;
  const ByTime& any = by_number.begin()->second;
  std::vector<std::size_t> order(times_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return any[a]->end_s() < any[b]->end_s(); });
  for (std::size_t k = 0; k < times_; k += kShareRows)
    groups_.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(k),
                         order.begin() + static_cast<std::ptrdiff_t>(std::min(times_, k + kShareRows)));
  asked_.resize(classes_.size());
  for (const auto& [number, by_time] : by_number)
    for (const std::vector<std::size_t>& group : groups_) {
      asked_[number].emplace_back();
      for (const std::size_t time : group)
        asked_[number].back().push_back({by_time[time].get(), neighbours_[time].get()});
    }
}

SurfacesOfTimes::~SurfacesOfTimes() = default;

void SurfacesOfTimes::ask_beside(std::size_t number, const ExposedPoint& exposed, const thermal::Pose& pose,
                                 std::uint64_t key, std::span<const math::Vec3> directions,
                                 std::span<const geometry::SurfacePoint> met, const PointRays& rays,
                                 Beside& beside) const {
  static thread_local std::vector<math::Vec3> downward;
  static thread_local std::vector<Neighbours::Change> of_group;
  const thermal::SurfaceClasses& first = classes_[number]->of_time(0);
  const double above = first.open_share(pose.normal), below = first.skin().faces() - above;
  downward.clear();
  if (below >= kLeastBelowHorizon) exposed.ground_directions(sampling::hash(key, Asked::below), 1, downward);
  beside.above = directions.size();
  beside.below = downward.size();
  beside.changes.assign((beside.above + beside.below) * times_, {});
  const thermal::SurfaceClasses& any = classes_[number]->of_time(0);
  const double worth_k = any.worth_of_all_k(any.corners(pose));
  for (std::size_t ray = 0; ray < beside.above + beside.below; ++ray) {
    const bool is_above = ray < beside.above;
    if (is_above && !met[ray].hit()) continue;
    const double view =
        is_above ? above / static_cast<double>(beside.above) : below / static_cast<double>(beside.below);
    // Rays of little worth go on by chance, the same to all times, and count the more.
    const double chance = rays.chance_beside(view, worth_k), share = view / chance;
    if (chance < 1.0 && sampling::unit_double(sampling::hash(key, Asked::asked, ray)) >= chance) continue;
    const geometry::SurfacePoint hit =
        is_above ? met[ray] : neighbours_.front()->met(exposed, downward[ray - beside.above]);
    if (!hit.hit()) continue;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      of_group.resize(groups_[g].size());
      Neighbours::changes(asked_[number][g], pose, hit, sampling::hash(key, Asked::beside, ray, g),
                          {rays.depth, rays.chance_behind, exposed.position_m().z - pose.height_m}, of_group);
      for (std::size_t k = 0; k < of_group.size(); ++k)
        beside.changes[ray * times_ + groups_[g][k]] = {share * of_group[k].in_shade_k,
                                                        share * of_group[k].of_sun_k};
    }
  }
}

std::unique_ptr<const SurfacesOfTimes> SurfacesOfTimes::of(std::span<const scene::Scene* const> by_time) {
  std::map<std::size_t, ByTime> by_number;
  const SolvedSurface* any = nullptr;
  std::vector<std::shared_ptr<const Neighbours>> neighbours;
  for (const scene::Scene* const& scene : by_time) {
    if (scene->world != by_time.front()->world || scene->solved.size() != by_time.front()->solved.size())
      return nullptr;
    for (std::size_t number = 0; number < scene->solved.size(); ++number) {
      const auto* surface = dynamic_cast<const SolvedSurface*>(scene->solved[number].get());
      if (surface == nullptr) continue;
      if (surface->scene().changes()) return nullptr;
      by_number[number].push_back(surface->shared_classes());
      if (any == nullptr) any = surface;
      if (neighbours.size() < static_cast<std::size_t>(&scene - by_time.data()) + 1)
        neighbours.push_back(surface->neighbours());
    }
  }
  if (any == nullptr) return nullptr;
  for (const auto& [number, classes] : by_number)
    if (classes.size() != by_time.size() || !ClassesOfTimes::serves(classes)) return nullptr;
  if (neighbours.size() != by_time.size() || neighbours.front() == nullptr) neighbours.clear();
  return std::make_unique<const SurfacesOfTimes>(by_number, any->scene(), any->sun_radius_rad(),
                                                 std::move(neighbours));
}

std::unique_ptr<const scene::TemperaturesOfTimes> share_surfaces(
    std::span<const scene::Scene* const> by_time) {
  return SurfacesOfTimes::of(by_time);
}

void SurfacesOfTimes::at(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t draw,
                         double share, std::span<scene::EstimatedTemperature> by_time) const {
  const ClassesOfTimes& classes = *classes_[number];
  const std::uint64_t key = sampling::hash(draw, bits_of(point.position_m.x), bits_of(point.position_m.y),
                                           bits_of(point.position_m.z), point.front);
  const double by_chance = sampling::unit_double(sampling::hash(key, Asked::asked));
  bool any = false;
  for (std::size_t t = 0; t < by_time.size(); ++t)
    any = any || by_chance < AskedByChance(classes.of_time(t), share).chance();
  if (any) estimate(number, point, key, share, by_time);
  for (std::size_t t = 0; t < by_time.size(); ++t) {
    const AskedByChance asked(classes.of_time(t), share);
    by_time[t] = by_chance < asked.chance() ? asked.counted(by_time[t]) : asked.else_taken();
  }
}

void SurfacesOfTimes::estimate(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t key,
                               double share, std::span<scene::EstimatedTemperature> by_time) const {
  static thread_local Pairs pairs;
  static thread_local std::vector<geometry::SurfacePoint> met;
  const ClassesOfTimes& classes = *classes_[number];
  const std::size_t lanes = classes.lanes(), bins = classes.bins();
  const bool two_faces = classes_[number]->of_time(0).two_faces();
  const ExposedPoint exposed(scene_, point, two_faces);
  const thermal::Pose pose = exposed.pose();
  const thermal::SurfaceClasses::AtStake stake = at_stake(classes, pose);
  PointRays rays(stake, share);
  if (rays.in_full && stake.of_sky_k > PointRays::kLittle_k) rays.sky_pairs = PointRays::kSkyPairs;
  exposed.sky_directions(sampling::hash(key, Asked::sky), rays.sky_pairs, pairs.directions);
  double sky = 1.0, sky_variance = 0.0;
  met.clear();
  if (const std::size_t count = pairs.directions.size(); count > 0) {
    pairs.is_free.resize(count);
    if (neighbours_.empty()) {
      exposed.free(pairs.directions, {}, pairs.is_free);
    } else {
      for (std::size_t k = 0; k < count; ++k) {
        met.push_back(neighbours_.front()->met(exposed, pairs.directions[k]));
        pairs.is_free[k] = exposed.leaves(pairs.directions[k]) && !met[k].hit() ? 1 : 0;
      }
    }
    sky = 0.0;
    for (std::size_t k = 0; k + 1 < count; k += 2) {
      sky += static_cast<double>(pairs.is_free[k] + pairs.is_free[k + 1]) / static_cast<double>(count);
      if (pairs.is_free[k] != pairs.is_free[k + 1]) sky_variance += 1.0 / static_cast<double>(count * count);
    }
  }
  classes.at(pose, sky, pairs.at);
  static thread_local Beside beside;
  static thread_local std::vector<std::uint8_t> sky_free;
  if (!groups_.empty()) {
    sky_free.assign(pairs.is_free.begin(),
                    pairs.is_free.begin() + static_cast<std::ptrdiff_t>(pairs.directions.size()));
    ask_beside(number, exposed, pose, key, pairs.directions, met, rays, beside);
  }
  pairs.directions.clear();
  pairs.suns = suns_[number]->draw(sampling::hash(key, Asked::sun));
  for (std::size_t b = 0; b < bins; ++b)
    for (const PastSuns::Set& set : pairs.suns) pairs.directions.push_back(set[b].direction());
  pairs.is_free.resize(2 * bins);
  if (bins > 0) exposed.free(pairs.directions, {}, pairs.is_free);
  if (!two_faces) see_behind(pairs, exposed.normal());
  pairs.kelvin = pairs.at.shaded_k;
  pairs.variance.resize(lanes);
  const bool has_beside = !groups_.empty();
  for (std::size_t t = 0; t < lanes; ++t)
    pairs.variance[t] =
        has_beside ? 0.0f : static_cast<float>(sky_variance) * pairs.at.of_sky_k[t] * pairs.at.of_sky_k[t];
  const auto seen =
      static_cast<std::size_t>(std::count(pairs.is_free.begin(), pairs.is_free.end(), std::uint8_t{1}));
  if (seen > 0 && seen < 2 * bins)
    add_mixed(pairs, bins, lanes);
  else if (seen > 0)
    for (std::size_t t = 0; t < lanes; ++t) pairs.kelvin[t] += pairs.at.all_k[t];
  for (std::size_t t = 0; has_beside && t < by_time.size(); ++t) {
    const double all_k = static_cast<double>(pairs.at.all_k[t]),
                 sun =
                     all_k > 0.0 ? static_cast<double>(pairs.kelvin[t] - pairs.at.shaded_k[t]) / all_k : 0.0;
    std::array<double, 2> sum_k{};
    double variance_k2 = 0.0;
    for (std::size_t ray = 0; ray + 1 < beside.above + beside.below; ray += 2) {
      const auto of = [&](std::size_t one) {
        const Neighbours::Change& change = beside.changes[one * times_ + t];
        return change.in_shade_k + sun * change.of_sun_k;
      };
      double apart_k = of(ray) - of(ray + 1);
      if (ray < beside.above)
        apart_k += static_cast<double>(pairs.at.of_sky_k[t]) * (sky_free[ray] - sky_free[ray + 1]) /
                   static_cast<double>(beside.above);
      sum_k[0] += of(ray);
      sum_k[1] += of(ray + 1);
      variance_k2 += apart_k * apart_k;
    }
    double more_k = sum_k[0] + sum_k[1];
    if (more_k != 0.0)
      more_k -= 4.0 * sum_k[0] * sum_k[1] * classes.of_time(t).bend_of_gain(classes.of_time(t).corners(pose));
    pairs.kelvin[t] += static_cast<float>(more_k);
    pairs.variance[t] += static_cast<float>(variance_k2);
  }
  for (std::size_t t = 0; t < by_time.size(); ++t)
    by_time[t] = {static_cast<double>(pairs.kelvin[t]),
                  std::sqrt(std::max(0.0, static_cast<double>(pairs.variance[t])))};
}

}  // namespace ifov::exposure
