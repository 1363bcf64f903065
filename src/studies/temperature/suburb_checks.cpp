#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/format.h"
#include "core/parallel.h"
#include "exposure/solved_surface.h"
#include "math/angle.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "studies/temperature/study_scenes.h"
#include "studies/temperature/temperature_checks.h"

namespace ifov::studies {
namespace {

constexpr int kSkyPairs = 128, kTimeRays = 512, kDrawsOfPoint = 16;
constexpr std::size_t kOneIn = 10;                      // points, with what is about them
constexpr double kSteepest_rad = 60.0 * math::kDegree;  // of the rays that look for points

/// A surface that is solved for, somewhere in the suburb, from above at up to 60 degrees: roads and roofs, walls too.
struct FoundPoint {
  geometry::SurfacePoint at;
  std::size_t material = 0;
};
std::vector<FoundPoint> random_points(const SolvedScene& scene, std::size_t count, std::uint64_t seed) {
  constexpr double kHalf_m = 30.0, kFar_m = 300.0;
  std::vector<FoundPoint> points;
  for (std::uint64_t k = 0; points.size() < count && k < 100 * count; ++k) {
    const auto number = [&](int n) { return sampling::unit_double(sampling::hash(seed, k, n)); };
    const double zenith = std::acos(std::lerp(1.0, std::cos(kSteepest_rad), number(2))),
                 turn = 2.0 * std::numbers::pi * number(3);
    const math::Vec3 up{std::sin(zenith) * std::cos(turn), std::sin(zenith) * std::sin(turn),
                        std::cos(zenith)};
    const math::Point3 ground{kHalf_m * (2.0 * number(0) - 1.0), kHalf_m * (2.0 * number(1) - 1.0), 0.0};
    const geometry::SurfacePoint hit = scene.met_by(ground + kFar_m * up, -up);
    const std::size_t material = scene.solved_material(hit);
    if (material != SolvedScene::kNone) points.push_back({hit, material});
  }
  return points;
}

double full_point_k(const SolvedScene& scene, const FoundPoint& point,
                    const exposure::SolvedSurface::Exposure& exposure) {
  const exposure::SolvedSurface& surface = *scene.surface(point.material);
  const math::Vec3 normal = surface.normal_at(point.at);
  thermal::Stand stand;
  stand.tilt_rad = std::acos(std::clamp(normal.z, -1.0, 1.0));
  stand.azimuth_rad = std::atan2(normal.x, normal.y);
  stand.free_sky = exposure.free_sky;
  stand.height_m = exposure.height_m;
  std::vector<double> visibility(scene.series().rows.size(), 0.0);
  for (std::size_t k = 0; k < exposure.visibility.size(); ++k)
    visibility[surface.classes().row_of_series(k)] = exposure.visibility[k];
  return scene.full_k(point.material, stand, std::move(visibility));
}

}  // namespace

SuburbPoints suburb_points(std::size_t points_an_hour, std::span<const char* const> hours,
                           bool wind_direction, const StudyOptions& options) {
  SuburbPoints found;
  double squares_k2 = 0.0, estimates_k = 0.0, estimate_squares_k2 = 0.0, covered = 0.0;
  double covered_by_image = 0.0, covered_by_half = 0.0;
  double besides = 0.0, beside_k2 = 0.0, beside_mean_k2 = 0.0, without_k2 = 0.0;
  for (std::size_t hour = 0; hour < hours.size(); ++hour) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    const std::string name = format("suburb_{}{}", std::string(hours[hour]).substr(0, 2),
                                    wind_direction ? "" : "_without_direction");
    const SolvedScenePtr kept = suburb_scene(hours[hour], wind_direction, name, options);
    const SolvedScene& scene = *kept;
    found.half_width_k.push_back(scene.half_width_k());
    const std::vector<FoundPoint> points = random_points(scene, points_an_hour, options.seed + hour);
    std::vector<double> full_k(points.size()), off_k(points.size()), estimate_k(points.size());
    std::vector<session::BesideOff> beside(points.size());
    parallel_for(static_cast<std::int64_t>(points.size()), options.threads, [&](std::int64_t index) {
      const auto k = static_cast<std::size_t>(index);
      const exposure::SolvedSurface& surface = *scene.surface(points[k].material);
      const int rows = static_cast<int>(std::max<std::size_t>(1, surface.classes().sunlit_rows()));
      const auto exposure = surface.exposure(points[k].at, sampling::hash(options.seed, index), kSkyPairs,
                                             std::max(1, (kTimeRays + rows - 1) / rows));
      full_k[k] = full_point_k(scene, points[k], exposure);
      off_k[k] = surface.temperature_k(points[k].at, exposure) - full_k[k];
      estimate_k[k] = mean_estimate_k(surface.without_neighbours(), points[k].at, kDrawsOfPoint,
                                      sampling::hash(options.seed, index) >> 24) -
                      full_k[k];
      if (k % kOneIn == 0)
        beside[k] = scene.beside_off(points[k].material, points[k].at, sampling::hash(options.seed, index, 1),
                                     exposure, full_k[k]);
    });
    for (std::size_t k = 0; k < points.size(); k += kOneIn) {
      const auto& [off, taken, further] = beside[k];
      const double mean_k = 0.5 * (off[0] + off[1]);
      besides += 1.0;
      // Products of two that scatter alone have no share of it.
      beside_k2 += off[0] * off[1];
      without_k2 += (off[0] - taken[0]) * (off[1] - taken[1]);
      found.beside_bias_k += mean_k;
      beside_mean_k2 += mean_k * mean_k;
      found.beside_covered += std::abs(off_k[k] + mean_k) <= scene.whole_half_width_k(points[k].material);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      squares_k2 += off_k[k] * off_k[k];
      found.bias_k += off_k[k];
      found.worst_k = std::max(found.worst_k, std::abs(off_k[k]));
      covered += std::abs(off_k[k]) <= scene.half_width_k(points[k].material);
      covered_by_image += std::abs(off_k[k]) <= scene.half_width_k();
      covered_by_half += std::abs(off_k[k]) <= 0.5 * scene.half_width_k(points[k].material);
      estimates_k += estimate_k[k];
      estimate_squares_k2 += estimate_k[k] * estimate_k[k];
    }
    found.points += points.size();
    found.full_k.insert(found.full_k.end(), full_k.begin(), full_k.end());
    found.off_k.insert(found.off_k.end(), off_k.begin(), off_k.end());
  }
  const auto count = static_cast<double>(found.points);
  found.rms_k = std::sqrt(squares_k2 / count);
  found.bias_k /= count;
  found.covered = covered / count;
  found.covered_by_image = covered_by_image / count;
  found.covered_by_half = covered_by_half / count;
  found.estimate_bias_k = estimates_k / count;
  found.estimate_error_k = std::sqrt(estimate_squares_k2 / count / count);
  found.beside_rms_k = std::sqrt(std::max(0.0, beside_k2) / besides);
  found.without_beside_rms_k = std::sqrt(std::max(0.0, without_k2) / besides);
  found.beside_bias_k /= besides;
  found.beside_error_k = std::sqrt(beside_mean_k2) / besides;
  found.beside_covered /= besides;
  return found;
}

QueryCost query_cost(std::size_t queries, const StudyOptions& options) {
  constexpr std::size_t kPoints = 2000;
  QueryCost cost;
  cost.same = true;
  std::vector<std::uint64_t> first;
  for (const int threads : {2, 1, 7}) {
    const SolvedScenePtr kept = suburb_scene("14:00", true, "query", options);
    const SolvedScene& scene = *kept;
    const std::vector<FoundPoint> points = random_points(scene, kPoints, options.seed);
    const auto at = [&](std::size_t k, std::uint64_t draw) {
      const FoundPoint& point = points[k % points.size()];
      return scene.surface(point.material)->at(point.at, draw).kelvin;
    };
    std::vector<std::uint64_t> told(points.size());
    parallel_for(static_cast<std::int64_t>(told.size()), threads, [&](std::int64_t k) {
      told[static_cast<std::size_t>(k)] = std::bit_cast<std::uint64_t>(at(static_cast<std::size_t>(k), 5));
    });
    if (first.empty()) {
      first = told;
      constexpr std::int64_t kBatch = 1000;
      const auto start = std::chrono::steady_clock::now();
      std::atomic<double> sum = 0.0;
      parallel_for(static_cast<std::int64_t>(queries) / kBatch, threads, [&](std::int64_t batch) {
        double own = 0.0;
        for (std::int64_t k = batch * kBatch; k < (batch + 1) * kBatch; ++k)
          own += at(static_cast<std::size_t>(k), static_cast<std::uint64_t>(k));
        sum.store(own);
      });
      cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e6 /
                     static_cast<double>(queries);
    }
    cost.same = cost.same && told == first;
  }
  return cost;
}

}  // namespace ifov::studies
