#include "truth/pixel_temperature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sampling/field.h"
#include "sampling/hash.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/random.h"
#include "sensor/camera.h"

namespace ifov::truth {
namespace {

constexpr std::size_t kSquareSide = 8, kSquareRays = kSquareSide * kSquareSide, kStatistics = 6;
constexpr double kMeanConfidence = 0.95, kPerRay = static_cast<double>(kSquareRays) / (kSquareRays - 1);
constexpr std::uint64_t kPlaces = 0x706978656c746bull;

/// Of one ray's surface: weight by area of what has a temperature, and sums with it.
struct Warmth {
  double weight = 0.0, kelvin = 0.0, kelvin2 = 0.0;
  double lowest_k = std::numeric_limits<double>::infinity(), highest_k = 0.0;
};

Warmth warmth_of(const scene::Scene& scene, const geometry::SurfacePoint& hit, std::uint64_t draw) {
  Warmth of;
  if (!hit.hit()) return of;
  for (const scene::Constituent& part : scene.resolve(hit, draw)) {
    const double kelvin =
        part.mapped_temperature_k > 0.0 ? part.mapped_temperature_k : scene.states[part.state].temperature_k;
    if (!(kelvin > 0.0)) continue;
    of.weight += part.weight;
    of.kelvin += part.weight * kelvin;
    of.kelvin2 += part.weight * kelvin * kelvin;
    of.lowest_k = std::min(of.lowest_k, kelvin);
    of.highest_k = std::max(of.highest_k, kelvin);
  }
  return of;
}

/// Of the rays of one pixel.
void put_statistics(const std::vector<Warmth>& rays, float* values) {
  std::fill_n(values, kStatistics, std::numeric_limits<float>::quiet_NaN());
  Warmth all;
  for (const Warmth& ray : rays) {
    all.weight += ray.weight;
    all.kelvin += ray.kelvin;
    all.kelvin2 += ray.kelvin2;
    all.lowest_k = std::min(all.lowest_k, ray.lowest_k);
    all.highest_k = std::max(all.highest_k, ray.highest_k);
  }
  values[5] = static_cast<float>(all.weight / kSquareRays);
  if (!(all.weight > 0.0)) return;
  const double mean = all.kelvin / all.weight;
  // Of a ratio of sums over rays (Cochran 1977, section 2.11).
  double spread2 = 0.0, residues2 = 0.0;
  for (const Warmth& ray : rays) {
    const double residue = ray.kelvin - mean * ray.weight;
    residues2 += residue * residue;
    spread2 += ray.kelvin2 - 2.0 * mean * ray.kelvin + mean * mean * ray.weight;
  }
  const double error = std::sqrt(residues2 * kPerRay) / all.weight;
  values[0] = static_cast<float>(mean);
  values[1] = static_cast<float>(std::sqrt(std::max(spread2, 0.0) / all.weight));
  values[2] = static_cast<float>(all.lowest_k);
  values[3] = static_cast<float>(all.highest_k);
  values[4] = static_cast<float>(sampling::two_sided_student(kMeanConfidence, kSquareRays - 1) * error);
}

void collect_pixel_temperatures(const MiddleRays& rays, std::span<float> values) {
  std::vector<sampling::FocalPoint> points(kSquareRays);
  std::vector<math::Ray> sent(kSquareRays);
  std::vector<geometry::SurfacePoint> hits(kSquareRays);
  std::vector<Warmth> warmth(kSquareRays);
  for (std::size_t k = 0; k < rays.rays.size(); ++k) {
    const sampling::FocalPoint& middle = rays.points[k];
    const std::uint64_t key = sampling::hash(kPlaces, static_cast<std::int64_t>(middle.x_px),
                                             static_cast<std::int64_t>(middle.y_px));
    for (std::size_t cell = 0; cell < kSquareRays; ++cell) {
      const auto within = [&](std::size_t place, int axis) {
        const double at = sampling::unit_double(sampling::extend(key, cell, axis));
        return (static_cast<double>(place) + at) / static_cast<double>(kSquareSide) - 0.5;
      };
      points[cell] = middle;
      points[cell].x_px += within(cell % kSquareSide, 0);
      points[cell].y_px += within(cell / kSquareSide, 1);
    }
    rays.camera->rays(points, sent);
    rays.scene.world->intersect(sent, hits);
    for (std::size_t ray = 0; ray < hits.size(); ++ray) warmth[ray] = warmth_of(rays.scene, hits[ray], ray);
    put_statistics(warmth, &values[k * kStatistics]);
  }
}

}  // namespace

constinit const Collector kPixelTemperature{"pixel_temperature", kStatistics, collect_pixel_temperatures};

}  // namespace ifov::truth
