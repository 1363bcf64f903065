#include "exposure/solved_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "exposure/exposed_point.h"
#include "exposure/neighbours.h"
#include "exposure/point_rays.h"
#include "geometry/surface_point.h"
#include "sampling/random.h"
#include "sampling/warp.h"

namespace ifov::exposure {
namespace {

enum class Draw { sky, sun, past_sky, beside, below, asked, about };

constexpr double kLeastBelow = 0.002;  // of the view, that is below the horizon
struct Directions {
  std::vector<math::Vec3> directions;
  std::vector<geometry::SurfacePoint> met;
  std::vector<std::uint8_t> is_free, meets;
  std::vector<double> weight_k, per_pair, times_s;
  std::array<std::size_t, 2 * SolvedSurface::kSunPairs> rows;
};

/// Mean of pairs of answers and the variance of that, as the pairs tell it.
struct PairMean {
  double mean = 0.0, variance = 0.0;
};
PairMean mean_of_pairs(std::span<const std::uint8_t> answers) {
  const double pairs = 0.5 * static_cast<double>(answers.size());
  PairMean result;
  for (std::size_t k = 0; k + 1 < answers.size(); k += 2) {
    result.mean += 0.5 * (answers[k] + answers[k + 1]) / pairs;
    result.variance += answers[k] != answers[k + 1] ? 0.25 / (pairs * pairs) : 0.0;
  }
  return result;
}

static_assert(SolvedSurface::kSunPairs == PointRays::kSunPairs &&
              SolvedSurface::kSkyPairs == PointRays::kSkyPairs);

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace

SolvedSurface::SolvedSurface(std::shared_ptr<const thermal::SurfaceClasses> classes, PastScene scene,
                             double sun_radius_rad, std::shared_ptr<const Neighbours> neighbours)
    : classes_(std::move(classes)),
      scene_(std::move(scene)),
      neighbours_(std::move(neighbours)),
      sun_radius_rad_(sun_radius_rad),
      two_faces_(classes_->two_faces()) {
  if (!scene_.changes()) return;
  // The last row stands for all that follows it.
  for (std::size_t row = 0; row < classes_->rows(); ++row)
    if (scene_.is_otherwise_within(classes_->time_s(row, -1.0),
                                   row + 1 == classes_->rows() ? 0.0 : classes_->time_s(row, 1.0)))
      changed_rows_.push_back(row);
}

SolvedSurface SolvedSurface::spending(const Spent& spent) const {
  SolvedSurface other = *this;
  other.spent_ = spent;
  return other;
}

SolvedSurface SolvedSurface::exposed_on(bool two_faces) const {
  SolvedSurface other = *this;
  other.two_faces_ = two_faces;
  return other;
}

/// To a place of the Sun's disc within a step of a row's time, as often as a gain that is linear between rows has it.
SolvedSurface::PastRay SolvedSurface::toward_sun(std::size_t row, std::uint64_t key) const {
  const auto number = [&](int k) { return sampling::unit_double(sampling::hash(key, k)); };
  const double steps = number(0) + number(1) - 1.0;
  const math::Vec3 middle = classes_->sun_at(row, steps);
  return {sampling::UniformCone(sun_radius_rad_).sample(middle, {number(2), number(3)}),
          classes_->time_s(classes_->row_of_series(row), steps)};
}

scene::EstimatedTemperature SolvedSurface::at(const geometry::SurfacePoint& point, std::uint64_t draw,
                                              double share) const {
  const std::uint64_t key = sampling::hash(draw, bits(point.position_m.x), bits(point.position_m.y),
                                           bits(point.position_m.z), point.front);
  const AskedByChance asked(*classes_, share);
  if (asked.chance() < 1.0 && sampling::unit_double(sampling::hash(key, Draw::asked)) >= asked.chance())
    return asked.else_taken();
  // What is asked by chance already is not asked so twice.
  const bool in_images = share <= 1.0 && asked.chance() >= 1.0;
  return asked.counted(estimate(point, key, share, in_images ? spent_ : Spent{}));
}

scene::EstimatedTemperature SolvedSurface::estimate(const geometry::SurfacePoint& point, std::uint64_t key,
                                                    double share, const Spent& spent) const {
  static thread_local Directions scratch;
  const ExposedPoint exposed(scene_, point, two_faces_);
  const thermal::Pose pose = exposed.pose();
  const thermal::SurfaceClasses::Corners at = classes_->corners(pose);
  const PointRays rays(classes_->at_stake(at), share);
  std::vector<math::Vec3>& directions = scratch.directions;
  exposed.sky_directions(sampling::hash(key, Draw::sky), rays.sky_pairs, directions);
  scratch.is_free.resize(std::max<std::size_t>(directions.size(), 2 * kSunPairs));
  PairMean sky{1.0, 0.0};
  const double chance = neighbours_ != nullptr ? spent.chance_beside : 1.0;
  const bool asks_about = neighbours_ != nullptr &&
                          (chance >= 1.0 || sampling::unit_double(sampling::hash(key, Draw::about)) < chance);
  if (!directions.empty()) {
    if (asks_about)
      look(exposed, directions, scratch.met, scratch.is_free);
    else
      exposed.free(directions, {}, scratch.is_free);
    sky = mean_of_pairs({scratch.is_free.data(), directions.size()});
  }

  std::vector<double>& sums_k = scratch.weight_k;
  const std::size_t first_row = classes_->first_row(at);
  sums_k.resize(classes_->sunlit_rows() - first_row);
  const auto [shaded_k, of_sky_k] = classes_->shaded(at, pose.normal, sky.mean, sums_k);
  double variance_k2 = sky.variance * of_sky_k * of_sky_k;
  const std::size_t sky_rays = directions.size();
  Beside beside, guessed;
  if (asks_about) beside = this->beside(exposed, pose, at, key, directions, scratch.met, rays, spent);
  if (chance < 1.0) {
    scratch.meets.resize(sky_rays);
    for (std::size_t k = 0; k < sky_rays; ++k)
      scratch.meets[k] = scratch.is_free[k] == 0 && exposed.leaves(directions[k]) ? 1 : 0;
    guessed = this->guessed(exposed, scratch.meets, spent);
  }
  std::array<std::uint8_t, 2 * kSkyPairs> sky_free{};
  std::copy_n(scratch.is_free.begin(), sky_rays, sky_free.begin());
  PastSky past;
  if (!changed_rows_.empty() && !directions.empty()) {
    past = past_sky(exposed, pose, key, directions, scratch.is_free, of_sky_k);
    variance_k2 = past.variance_k2;
  }
  std::partial_sum(sums_k.begin(), sums_k.end(), sums_k.begin());
  const double rise_k = sums_k.empty() ? 0.0 : sums_k.back();
  // What the pairs of rays to what hides the sky tell goes with what they tell of the sky itself.
  const auto with = [&](const Beside& what, double kelvin, double sun_share) {
    const bool of_sky_too = sky_rays > 0 && past.variance_k2 == 0.0;
    double scatter_k2 = variance_k2;
    if (of_sky_too) scatter_k2 -= sky.variance * of_sky_k * of_sky_k;
    for (std::size_t k = 0; k < what.in_shade_k.size(); k += 2) {
      double apart_k = what.kelvin(k, sun_share) - what.kelvin(k + 1, sun_share);
      if (of_sky_too && k < sky_rays)
        apart_k += of_sky_k * (sky_free[k] - sky_free[k + 1]) / static_cast<double>(sky_rays);
      scatter_k2 += apart_k * apart_k;
    }
    return scene::EstimatedTemperature{kelvin + what.warms_k(*classes_, at, sun_share),
                                       std::sqrt(std::max(0.0, scatter_k2))};
  };
  const auto with_beside = [&](double kelvin, double sun_share) {
    if (neighbours_ == nullptr) return scene::EstimatedTemperature{kelvin, std::sqrt(variance_k2)};
    if (!asks_about) return with(guessed, kelvin, sun_share);
    scene::EstimatedTemperature found = with(beside, kelvin, sun_share);
    if (chance < 1.0) {
      const scene::EstimatedTemperature alone = with(guessed, kelvin, sun_share);
      found.else_k = alone.kelvin;
      found.else_deviation_k = alone.deviation_k;
      found.times = 1.0 / chance;
    }
    return found;
  };
  if (!(rise_k > 0.0)) return with_beside(shaded_k + past.in_shade_k, 0.0);
  directions.clear();
  scratch.times_s.clear();
  const int sun_pairs = std::min(rays.sun_pairs, spent.sun_pairs);
  const auto sun_rays = static_cast<std::size_t>(2 * sun_pairs);
  for (std::size_t k = 0; k < sun_rays; ++k) {
    const std::uint64_t own = sampling::hash(key, Draw::sun, k);
    const double place = rise_k * (static_cast<double>(k / 2) + sampling::unit_double(own)) / sun_pairs;
    const auto row = std::upper_bound(sums_k.begin(), sums_k.end() - 1, place) - sums_k.begin();
    scratch.rows[k] = static_cast<std::size_t>(row);
    const PastRay ray = toward_sun(first_row + static_cast<std::size_t>(row), own);
    directions.push_back(ray.direction);
    if (scene_.changes()) scratch.times_s.push_back(ray.time_s);
  }
  exposed.free(directions, scratch.times_s, scratch.is_free);
  const PairMean sun = mean_of_pairs({scratch.is_free.data(), directions.size()});
  variance_k2 += sun.variance * rise_k * rise_k;
  // The first and the second rays of all pairs are two estimates of their own: products of one's and the other's have no bias.
  double second = 0.0;
  if (sun.mean > 0.0 && sun.mean < 1.0) {
    scratch.per_pair.resize(sums_k.size());
    classes_->bends(at, sums_k, scratch.per_pair);
    for (std::size_t k = 0; k < sun_rays; ++k)
      for (std::size_t j = 1 - k % 2; j < sun_rays; j += 2)
        if (scratch.is_free[k] != 0 && scratch.is_free[j] == 0)
          second -= rise_k * scratch.per_pair[std::max(scratch.rows[j], scratch.rows[k])] /
                    static_cast<double>(sun_rays * sun_rays);
  }
  const double past_k = past.in_shade_k + 0.5 * sun.mean * past.of_sun_k;
  return with_beside(shaded_k + past_k + (sun.mean + second) * rise_k, sun.mean);
}

void SolvedSurface::look(const ExposedPoint& exposed, std::span<const math::Vec3> directions,
                         std::vector<geometry::SurfacePoint>& met, std::span<std::uint8_t> is_free) const {
  met.clear();
  if (neighbours_ == nullptr) return exposed.free(directions, {}, is_free);
  neighbours_->met(exposed, directions, met);
  for (std::size_t k = 0; k < directions.size(); ++k)
    is_free[k] = exposed.leaves(directions[k]) && !met[k].hit() ? 1 : 0;
}

double SolvedSurface::Beside::warms_k(const thermal::SurfaceClasses& classes,
                                      const thermal::SurfaceClasses::Corners& at, double sun_share) const {
  std::array<double, 2> sum_k{};
  for (std::size_t k = 0; k < in_shade_k.size(); ++k) sum_k[k % 2] += kelvin(k, sun_share);
  // The first and the second rays of all pairs are two estimates of half of it.
  return sum_k[0] + sum_k[1] - 4.0 * classes.bend_of_gain(at) * sum_k[0] * sum_k[1];
}

SolvedSurface::Beside SolvedSurface::beside(const ExposedPoint& exposed, const thermal::Pose& pose,
                                            const thermal::SurfaceClasses::Corners& at, std::uint64_t key,
                                            std::span<const math::Vec3> directions,
                                            std::span<const geometry::SurfacePoint> met,
                                            const PointRays& rays, const Spent& spent) const {
  Beside found;
  const double above = classes_->open_share(pose.normal), below = classes_->skin().faces() - above;
  const double worth_k = classes_->worth_of_all_k(at);
  const Neighbours::Behind behind{rays.depth, rays.chance_behind, exposed.position_m().z - pose.height_m};
  // A ray of little worth goes on by chance, and what it tells beyond what it is taken for counts the more.
  const auto add = [&](std::size_t number, Draw of, std::size_t k, double view, math::Vec3 direction,
                       const geometry::SurfacePoint* hit) {
    const Warmth& taken = of == Draw::beside ? spent.above : spent.below;
    found.in_shade_k[number] = view * taken.in_shade_k;
    found.of_sun_k[number] = view * taken.of_sun_k;
    const double chance = rays.chance_beside(view, worth_k);
    if (chance < 1.0 && sampling::unit_double(sampling::hash(key, of, k, Draw::asked)) >= chance) return;
    const std::uint64_t own = sampling::hash(key, of, k);
    const auto change = hit != nullptr
                            ? neighbours_->change(exposed, *classes_, at, direction, *hit, own, behind)
                            : neighbours_->change(exposed, *classes_, at, direction, own, behind);
    found.in_shade_k[number] += view / chance * (change.in_shade_k - taken.in_shade_k);
    found.of_sun_k[number] += view / chance * (change.of_sun_k - taken.of_sun_k);
  };
  for (std::size_t k = 0; k < directions.size(); ++k)
    if (met[k].hit())
      add(k, Draw::beside, k, above / static_cast<double>(directions.size()), directions[k], &met[k]);
  if (below < kLeastBelow) return found;
  static thread_local std::vector<math::Vec3> downward;
  exposed.ground_directions(sampling::hash(key, Draw::below), 1, downward);
  for (std::size_t k = 0; k < downward.size(); ++k)
    add(2 * kSkyPairs + k, Draw::below, k, 0.5 * below, downward[k], nullptr);
  return found;
}

SolvedSurface::Beside SolvedSurface::guessed(const ExposedPoint& exposed, std::span<const std::uint8_t> meets,
                                             const Spent& spent) const {
  Beside found;
  const double above = classes_->open_share(exposed.normal()), below = classes_->skin().faces() - above;
  const auto take = [&](std::size_t number, double view, const Warmth& taken) {
    found.in_shade_k[number] = view * taken.in_shade_k;
    found.of_sun_k[number] = view * taken.of_sun_k;
  };
  for (std::size_t k = 0; k < meets.size(); ++k)
    if (meets[k] != 0) take(k, above / static_cast<double>(meets.size()), spent.above);
  if (below >= kLeastBelow)
    for (const std::size_t k : {0, 1}) take(2 * kSkyPairs + k, 0.5 * below, spent.below);
  return found;
}

SolvedSurface::AskedAbout SolvedSurface::asked_about(const geometry::SurfacePoint& point,
                                                     std::uint64_t key) const {
  AskedAbout asked;
  if (neighbours_ == nullptr) return asked;
  const ExposedPoint exposed(scene_, point, two_faces_);
  const thermal::Pose pose = exposed.pose();
  const thermal::SurfaceClasses::Corners at = classes_->corners(pose);
  const Neighbours::Behind behind{Neighbours::kDepth, PointRays::kChanceBehind,
                                  exposed.position_m().z - pose.height_m};
  std::vector<math::Vec3> directions;
  const auto tells = [&](Draw of) {
    const auto change =
        neighbours_->change(exposed, *classes_, at, directions[0], sampling::hash(key, of), behind);
    return Warmth{change.in_shade_k, change.of_sun_k};
  };
  exposed.sky_directions(sampling::hash(key, Draw::sky), 1, directions);
  if (!directions.empty() && neighbours_->met(exposed, directions[0]).hit())
    asked.above = tells(Draw::beside);
  if (classes_->skin().faces() - classes_->open_share(pose.normal) < kLeastBelow) return asked;
  exposed.ground_directions(sampling::hash(key, Draw::below), 1, directions);
  asked.below = tells(Draw::below);
  return asked;
}

double SolvedSurface::sun_share(const geometry::SurfacePoint& point, const Exposure& exposure) const {
  std::vector<double> weight_k(classes_->sunlit_rows());
  classes_->shaded({normal_at(point), exposure.height_m}, exposure.free_sky, weight_k);
  double all_k = 0.0, lit_k = 0.0;
  for (std::size_t k = 0; k < weight_k.size(); ++k) {
    all_k += weight_k[k];
    lit_k += weight_k[k] * exposure.visibility[k];
  }
  return all_k > 0.0 ? lit_k / all_k : 0.0;
}

double SolvedSurface::beside_k(const geometry::SurfacePoint& point, const Exposure& exposure,
                               std::uint64_t key, int draws, int further) const {
  if (neighbours_ == nullptr) return 0.0;
  const ExposedPoint exposed(scene_, point, two_faces_);
  const thermal::Pose pose(exposed.normal(), exposure.height_m);
  const thermal::SurfaceClasses::Corners at = classes_->corners(pose);
  const double sun = sun_share(point, exposure);
  const PointRays all(Neighbours::kDepth + further);
  std::vector<geometry::SurfacePoint> met;
  std::vector<math::Vec3> directions;
  std::vector<std::uint8_t> is_free(2 * kSkyPairs);
  double sum_k = 0.0;
  for (int draw = 0; draw < draws; ++draw) {
    const std::uint64_t own = sampling::hash(key, draw);
    exposed.sky_directions(sampling::hash(own, Draw::sky), kSkyPairs, directions);
    look(exposed, directions, met, is_free);
    sum_k += beside(exposed, pose, at, own, directions, met, all, {}).warms_k(*classes_, at, sun);
  }
  return sum_k / draws;
}

bool SolvedSurface::sees_surfaces(const geometry::SurfacePoint& point, std::uint64_t key) const {
  constexpr int kPairs = 4;
  const ExposedPoint exposed(scene_, point, two_faces_);
  if (two_faces_ || 0.5 * (1.0 - exposed.normal().z) >= kLeastBelow) return true;
  std::vector<math::Vec3> directions;
  exposed.sky_directions(sampling::hash(key, Draw::sky), kPairs, directions);
  std::vector<std::uint8_t> is_free(directions.size());
  exposed.free(directions, {}, is_free);
  return std::find(is_free.begin(), is_free.end(), std::uint8_t{0}) != is_free.end();
}

SolvedSurface::PastSky SolvedSurface::past_sky(const ExposedPoint& exposed, const thermal::Pose& pose,
                                               std::uint64_t key, std::span<const math::Vec3> directions,
                                               std::span<const std::uint8_t> is_free, double of_sky_k) const {
  static thread_local std::vector<double> weight_k, bend_k, sums_k;
  weight_k.resize(classes_->rows());
  bend_k.resize(classes_->rows());
  classes_->past_sky(pose, weight_k, bend_k);
  sums_k.clear();
  for (const std::size_t row : changed_rows_)
    sums_k.push_back((sums_k.empty() ? 0.0 : sums_k.back()) + std::abs(weight_k[row]));
  const std::size_t count = directions.size();
  std::array<double, 2 * kSkyPairs> times_s, signs, bends;
  std::array<std::uint8_t, 2 * kSkyPairs> was_free;
  for (std::size_t k = 0; k < count; ++k) {
    const auto number = [&](int n) {
      return sampling::unit_double(sampling::hash(key, Draw::past_sky, k, n));
    };
    const auto found = std::upper_bound(sums_k.begin(), sums_k.end() - 1, number(0) * sums_k.back());
    const std::size_t row = changed_rows_[static_cast<std::size_t>(found - sums_k.begin())];
    times_s[k] = std::min(0.0, classes_->time_s(row, number(1) + number(2) - 1.0));
    signs[k] = weight_k[row] < 0.0 ? -1.0 : 1.0;
    bends[k] = weight_k[row] != 0.0 ? std::clamp(bend_k[row] / weight_k[row], -1.0, 1.0) : 0.0;
  }
  exposed.free(directions, {times_s.data(), count}, was_free);
  PastSky past;
  const double pairs = 0.5 * static_cast<double>(count);
  const auto change_k = [&](std::size_t k) { return signs[k] * sums_k.back() * (was_free[k] - is_free[k]); };
  // What was free of the sky and is hidden now had the Sun that the point had; what was hidden, mostly from the Sun too, had half of it.
  const auto bent_k = [&](std::size_t k) {
    return (was_free[k] > is_free[k] ? 2.0 : 1.0) * bends[k] * change_k(k);
  };
  for (std::size_t k = 0; k + 1 < count; k += 2) {
    past.in_shade_k += 0.5 * (change_k(k) + change_k(k + 1)) / pairs;
    past.of_sun_k += 0.5 * (bent_k(k) + bent_k(k + 1)) / pairs;
    const double apart_k = of_sky_k * (is_free[k] - is_free[k + 1]) + change_k(k) - change_k(k + 1);
    past.variance_k2 += 0.25 * apart_k * apart_k / (pairs * pairs);
  }
  return past;
}

std::vector<double> SolvedSurface::past_free_sky(const ExposedPoint& exposed,
                                                 std::span<const math::Vec3> directions) const {
  // Between changes nothing changes: one look at each time between them.
  const std::vector<double>& changes_s = scene_.changes_s();
  std::vector<double> shares, times_s(directions.size());
  std::vector<std::uint8_t> is_free(directions.size());
  for (std::size_t k = 0; k <= changes_s.size(); ++k) {
    const double time_s = k < changes_s.size() ? std::nextafter(changes_s[k], -1e12) : 0.0;
    std::fill(times_s.begin(), times_s.end(), time_s);
    exposed.free(directions, times_s, is_free);
    shares.push_back(static_cast<double>(std::count(is_free.begin(), is_free.end(), std::uint8_t{1})) /
                     static_cast<double>(directions.size()));
  }
  constexpr int kTimes = 32;  // about each row, by a triangle
  std::vector<double> by_row(classes_->rows(), shares.back());
  for (const std::size_t row : changed_rows_) {
    by_row[row] = 0.0;
    for (int k = 0; k < kTimes; ++k) {
      const double place = 2.0 * (k + 0.5) / kTimes;
      const double steps = place < 1.0 ? std::sqrt(place) - 1.0 : 1.0 - std::sqrt(2.0 - place);
      const double time_s = std::min(0.0, classes_->time_s(row, steps));
      const auto next = std::upper_bound(changes_s.begin(), changes_s.end(), time_s) - changes_s.begin();
      by_row[row] += shares[static_cast<std::size_t>(next)] / kTimes;
    }
  }
  return by_row;
}

SolvedSurface::Exposure SolvedSurface::exposure(const geometry::SurfacePoint& point, std::uint64_t key,
                                                int sky_pairs, int sun_rays) const {
  const ExposedPoint exposed(scene_, point, two_faces_);
  Exposure result;
  result.height_m = exposed.pose().height_m;
  std::vector<math::Vec3> directions;
  std::vector<double> times_s;
  exposed.sky_directions(sampling::hash(key, Draw::sky), sky_pairs, directions);
  std::vector<std::uint8_t> is_free(std::max(directions.size(), static_cast<std::size_t>(sun_rays)));
  if (!directions.empty()) {
    exposed.free(directions, {}, is_free);
    result.free_sky = mean_of_pairs({is_free.data(), directions.size()}).mean;
    if (!changed_rows_.empty()) result.past_free_sky = past_free_sky(exposed, directions);
  }
  for (std::size_t row = 0; row < classes_->sunlit_rows(); ++row) {
    directions.clear();
    times_s.clear();
    for (int k = 0; k < sun_rays; ++k) {
      const PastRay ray = toward_sun(row, sampling::hash(key, Draw::sun, row, k));
      directions.push_back(ray.direction);
      if (scene_.changes()) times_s.push_back(ray.time_s);
    }
    exposed.free(directions, times_s, is_free);
    result.visibility.push_back(
        static_cast<double>(std::count(is_free.begin(), is_free.begin() + sun_rays, std::uint8_t{1})) /
        sun_rays);
  }
  return result;
}

math::Vec3 SolvedSurface::normal_at(const geometry::SurfacePoint& point) const {
  return ExposedPoint(scene_, point, two_faces_).normal();
}

double SolvedSurface::temperature_k(const geometry::SurfacePoint& point, const Exposure& exposure) const {
  std::vector<double> weight_k(classes_->sunlit_rows());
  const thermal::Pose pose(normal_at(point), exposure.height_m);
  const double shaded_k = classes_->shaded(pose, exposure.free_sky, weight_k).kelvin;
  std::vector<double> per_pair(weight_k.size()), sums_k(weight_k.size());
  std::partial_sum(weight_k.begin(), weight_k.end(), sums_k.begin());
  classes_->bends(pose, sums_k, per_pair);
  double all_k = 0.0, lit_k = 0.0, bent_k = 0.0;
  for (std::size_t k = 0; k < weight_k.size(); ++k) {
    const double part_k = weight_k[k] * exposure.visibility[k], hidden_k = weight_k[k] - part_k;
    bent_k -= 0.5 * per_pair[k] * (part_k * (all_k - lit_k) + hidden_k * lit_k + part_k * hidden_k);
    all_k += weight_k[k];
    lit_k += part_k;
  }
  const double of_sun = all_k > 0.0 ? lit_k / all_k : 0.0;
  double past_k = 0.0;
  if (!exposure.past_free_sky.empty()) {
    std::vector<double> sky_k(exposure.past_free_sky.size()), sky_bend_k(sky_k.size());
    classes_->past_sky(pose, sky_k, sky_bend_k);
    for (std::size_t row = 0; row < sky_k.size(); ++row)
      past_k += (sky_k[row] +
                 (exposure.past_free_sky[row] > exposure.free_sky ? 1.0 : 0.5) * of_sun * sky_bend_k[row]) *
                (exposure.past_free_sky[row] - exposure.free_sky);
  }
  return shaded_k + past_k + lit_k + bent_k;
}

}  // namespace ifov::exposure
