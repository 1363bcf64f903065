#include "exposure/solved_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "exposure/exposed_point.h"
#include "geometry/surface_point.h"
#include "sampling/random.h"
#include "sampling/warp.h"

namespace ifov::exposure {
namespace {

enum class Draw { sky, sun };

struct Directions {
  std::vector<math::Vec3> directions;
  std::vector<std::uint8_t> is_free;
  std::vector<double> weight_k;
  std::array<std::size_t, 2 * SolvedSurface::kSunPairs> rows;
  std::array<double, 2 * SolvedSurface::kSunPairs> bend;
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

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace

SolvedSurface::SolvedSurface(std::shared_ptr<const thermal::SurfaceClasses> classes,
                             const geometry::World& world, double sun_radius_rad)
    : classes_(std::move(classes)), world_(world), sun_radius_rad_(sun_radius_rad) {}

/// To a place of the Sun's disc within a step of a row's time, as often as a gain that is linear between rows has it.
math::Vec3 SolvedSurface::toward_sun(std::size_t row, std::uint64_t key) const {
  const auto number = [&](int k) { return sampling::unit_double(sampling::hash(key, k)); };
  const math::Vec3 middle = classes_->sun_at(row, number(0) + number(1) - 1.0);
  return sampling::UniformCone(sun_radius_rad_).sample(middle, {number(2), number(3)});
}

scene::EstimatedTemperature SolvedSurface::at(const geometry::SurfacePoint& point, std::uint64_t draw) const {
  static thread_local Directions scratch;
  const std::uint64_t key = sampling::hash(draw, bits(point.position_m.x), bits(point.position_m.y),
                                           bits(point.position_m.z), point.front);
  const ExposedPoint exposed(world_, point);
  const math::Vec3 normal = exposed.normal();
  std::vector<math::Vec3>& directions = scratch.directions;
  exposed.sky_directions(sampling::hash(key, Draw::sky), kSkyPairs, directions);
  scratch.is_free.resize(std::max<std::size_t>(directions.size(), 2 * kSunPairs));
  PairMean sky{1.0, 0.0};
  if (!directions.empty()) {
    exposed.free(directions, scratch.is_free);
    sky = mean_of_pairs({scratch.is_free.data(), directions.size()});
  }

  std::vector<double>& sums_k = scratch.weight_k;
  sums_k.resize(classes_->sunlit_rows());
  const auto [shaded_k, of_sky_k] = classes_->shaded(normal, sky.mean, sums_k);
  double variance_k2 = sky.variance * of_sky_k * of_sky_k;
  std::partial_sum(sums_k.begin(), sums_k.end(), sums_k.begin());
  const double rise_k = sums_k.empty() ? 0.0 : sums_k.back();
  if (!(rise_k > 0.0)) return {shaded_k, std::sqrt(variance_k2)};
  directions.clear();
  for (int k = 0; k < 2 * kSunPairs; ++k) {
    const std::uint64_t own = sampling::hash(key, Draw::sun, k);
    const double place = rise_k * (k / 2 + sampling::unit_double(own)) / kSunPairs;
    const auto row = std::upper_bound(sums_k.begin(), sums_k.end() - 1, place) - sums_k.begin();
    scratch.rows[static_cast<std::size_t>(k)] = static_cast<std::size_t>(row);
    directions.push_back(toward_sun(static_cast<std::size_t>(row), own));
  }
  exposed.free(directions, scratch.is_free);
  const PairMean sun = mean_of_pairs({scratch.is_free.data(), directions.size()});
  variance_k2 += sun.variance * rise_k * rise_k;
  // The first and the second rays of all pairs are two estimates of their own: products of one's and the other's have no bias.
  classes_->bends(normal, scratch.rows, scratch.bend);
  std::array<double, 2> share{}, bent{};
  for (std::size_t k = 0; k < scratch.rows.size(); ++k)
    if (scratch.is_free[k] != 0) {
      share[k % 2] += 1.0 / kSunPairs;
      bent[k % 2] += scratch.bend[k] / kSunPairs;
    }
  const double second = 0.25 * (share[0] * bent[1] + share[1] * bent[0] - bent[0] - bent[1]);
  return {shaded_k + (sun.mean + second) * rise_k, std::sqrt(variance_k2)};
}

SolvedSurface::Exposure SolvedSurface::exposure(const geometry::SurfacePoint& point, std::uint64_t key,
                                                int sky_pairs, int sun_rays) const {
  const ExposedPoint exposed(world_, point);
  Exposure result;
  std::vector<math::Vec3> directions;
  exposed.sky_directions(sampling::hash(key, Draw::sky), sky_pairs, directions);
  std::vector<std::uint8_t> is_free(std::max(directions.size(), static_cast<std::size_t>(sun_rays)));
  if (!directions.empty()) {
    exposed.free(directions, is_free);
    result.free_sky = mean_of_pairs({is_free.data(), directions.size()}).mean;
  }
  for (std::size_t row = 0; row < classes_->sunlit_rows(); ++row) {
    directions.clear();
    for (int k = 0; k < sun_rays; ++k)
      directions.push_back(toward_sun(row, sampling::hash(key, Draw::sun, row, k)));
    exposed.free(directions, is_free);
    result.visibility.push_back(
        static_cast<double>(std::count(is_free.begin(), is_free.begin() + sun_rays, std::uint8_t{1})) /
        sun_rays);
  }
  return result;
}

double SolvedSurface::temperature_k(const geometry::SurfacePoint& point, const Exposure& exposure) const {
  std::vector<double> weight_k(classes_->sunlit_rows());
  const math::Vec3 normal = ExposedPoint(world_, point).normal();
  const double shaded_k = classes_->shaded(normal, exposure.free_sky, weight_k).kelvin;
  std::vector<std::size_t> rows(weight_k.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::vector<double> bend(rows.size());
  classes_->bends(normal, rows, bend);
  double all_k = 0.0, lit_k = 0.0, bent_k = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double part_k = weight_k[k] * exposure.visibility[k];
    all_k += weight_k[k];
    lit_k += part_k;
    bent_k += part_k * bend[k];
  }
  return shaded_k + lit_k + (all_k > 0.0 ? 0.5 * (lit_k / all_k - 1.0) * bent_k : 0.0);
}

}  // namespace ifov::exposure
