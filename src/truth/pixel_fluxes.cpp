#include "truth/pixel_fluxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "sampling/field.h"
#include "sampling/hash.h"
#include "sampling/random.h"
#include "scene/heat_fluxes.h"
#include "scene/solved_temperature.h"
#include "sensor/camera.h"

namespace ifov::truth {
namespace {

constexpr std::size_t kCellSide = 4, kFluxRays = kCellSide * kCellSide, kFluxes = 10,
                      kFluxBands = 2 * kFluxes + 1;
constexpr double kOfRays = static_cast<double>(kFluxRays) / (kFluxRays - 1);
constexpr std::uint64_t kFluxPlaces = 0x666c7578657373ull;

/// Of one ray: weight by area of what has a solved temperature, and sums with it.
struct Gains {
  double weight = 0.0;
  std::array<double, kFluxes> w_m2{};
};

Gains gains_of(const scene::Scene& scene, const geometry::SurfacePoint& hit, std::uint64_t draw) {
  Gains of;
  if (!hit.hit()) return of;
  for (const scene::Constituent& part : scene.resolve_without_temperature(hit)) {
    const std::uint32_t by = scene.states[part.state].solved;
    if (by == 0) continue;
    const std::optional<scene::HeatFluxes> found = scene.solved[by - 1]->fluxes(hit, draw);
    if (!found) continue;
    const std::array<double, kFluxes> all{
        found->sun,     found->sky,        found->reflected, found->sky_longwave, found->scene_longwave,
        found->emitted, found->convection, found->latent,    found->power,        found->conduction};
    of.weight += part.weight;
    for (std::size_t k = 0; k < kFluxes; ++k) of.w_m2[k] += part.weight * all[k];
  }
  return of;
}

void put_gains(const std::vector<Gains>& rays, float* values) {
  std::fill_n(values, kFluxBands, std::numeric_limits<float>::quiet_NaN());
  double weight = 0.0;
  for (const Gains& ray : rays) weight += ray.weight;
  values[2 * kFluxes] = static_cast<float>(weight / kFluxRays);
  if (!(weight > 0.0)) return;
  for (std::size_t k = 0; k < kFluxes; ++k) {
    double sum = 0.0, residues2 = 0.0;
    for (const Gains& ray : rays) sum += ray.w_m2[k];
    const double mean = sum / weight;
    // Of a ratio of sums over rays (Cochran 1977, section 2.11).
    for (const Gains& ray : rays) {
      const double residue = ray.w_m2[k] - mean * ray.weight;
      residues2 += residue * residue;
    }
    values[k] = static_cast<float>(mean);
    values[kFluxes + k] = static_cast<float>(std::sqrt(residues2 * kOfRays) / weight);
  }
}

void collect_pixel_fluxes(const MiddleRays& rays, std::span<float> values) {
  std::vector<sampling::FocalPoint> points(kFluxRays);
  std::vector<math::Ray> sent(kFluxRays);
  std::vector<geometry::SurfacePoint> hits(kFluxRays);
  std::vector<Gains> gains(kFluxRays);
  for (std::size_t k = 0; k < rays.rays.size(); ++k) {
    const sampling::FocalPoint& middle = rays.points[k];
    const std::uint64_t key = sampling::hash(kFluxPlaces, static_cast<std::int64_t>(middle.x_px),
                                             static_cast<std::int64_t>(middle.y_px));
    for (std::size_t cell = 0; cell < kFluxRays; ++cell) {
      const auto within = [&](std::size_t place, int axis) {
        const double at = sampling::unit_double(sampling::extend(key, cell, axis));
        return (static_cast<double>(place) + at) / static_cast<double>(kCellSide) - 0.5;
      };
      points[cell] = middle;
      points[cell].x_px += within(cell % kCellSide, 0);
      points[cell].y_px += within(cell / kCellSide, 1);
    }
    rays.camera->rays(points, sent);
    rays.scene.world->intersect(sent, hits);
    for (std::size_t ray = 0; ray < hits.size(); ++ray)
      gains[ray] = gains_of(rays.scene, hits[ray], sampling::hash(key, ray));
    put_gains(gains, &values[k * kFluxBands]);
  }
}

}  // namespace

constinit const Collector kPixelFluxes{"fluxes", kFluxBands, collect_pixel_fluxes};

}  // namespace ifov::truth
