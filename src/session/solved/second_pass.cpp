#include "session/solved/second_pass.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "thermal/sky_longwave.h"

namespace ifov::session {
namespace {

constexpr int kRays = 12, kSkyPairsOfNeighbour = 8;
constexpr double kLeastOfView = 0.01;  // that is not sky

/// What a surface sends to all sides by row of the series, W m-2.
std::vector<thermal::FromBeside> sent_by(const Neighbourhood& about, const geometry::SurfacePoint& hit,
                                         std::uint64_t key) {
  const scene::Constituent main = about.scene.resolve_without_temperature(hit).constituents[0];
  const scene::SurfaceState& state = about.scene.states[main.state];
  const bool is_solved = state.solved > 0;
  const SolvedMaterial& solved =
      is_solved ? about.by_material.at(state.solved - 1) : about.by_material.begin()->second;
  const exposure::SolvedSurface surface(solved.classes, about.past, about.sun_radius_rad);
  const auto exposure = surface.exposure(hit, key, kSkyPairsOfNeighbour, 1);
  const thermal::SurfaceSolution solution =
      full_solution(solved, about.series, about.stand, surface.normal_at(hit), exposure);
  const double absorbed = solution.balance.skin().solar_absorptance;
  const double reflected = is_solved ? 1.0 - absorbed : about.stand.ground_reflectance;
  const double of_light = absorbed > 0.0 ? reflected / absorbed : 0.0;
  const double emissivity = is_solved ? solution.balance.skin().emissivity : 1.0;
  const double given_k = main.mapped_temperature_k > 0.0 ? main.mapped_temperature_k : state.temperature_k;
  std::vector<thermal::FromBeside> sent(about.series.rows.size());
  for (std::size_t row = 0; row < sent.size(); ++row) {
    const double surface_k = is_solved ? solution.surface_k(row) : given_k;
    const thermal::Fluxes fluxes = solution.balance.fluxes(
        about.series.begin_s + about.series.step_s * static_cast<double>(row), solution.surface_k(row));
    sent[row].sunlight_w_m2 = of_light * (fluxes.sun + fluxes.sky + fluxes.reflected);
    sent[row].longwave_w_m2 = emissivity * thermal::kStefanBoltzmann_w_m2_k4 * std::pow(surface_k, 4);
    if (is_solved && emissivity > 0.0)  // and what it reflects of the heat that comes to it
      sent[row].longwave_w_m2 +=
          (1.0 - emissivity) / emissivity * (fluxes.sky_longwave + fluxes.ground_longwave);
  }
  return sent;
}

}  // namespace

thermal::SurfaceSolution full_solution(const SolvedMaterial& solved, const thermal::OutdoorsSeries& series,
                                       thermal::Stand stand, math::Vec3 normal,
                                       const exposure::SolvedSurface::Exposure& exposure,
                                       std::vector<thermal::FromBeside> beside) {
  stand.tilt_rad = std::acos(std::clamp(normal.z, -1.0, 1.0));
  stand.azimuth_rad = std::atan2(normal.x, normal.y);
  stand.free_sky = exposure.free_sky;
  stand.height_m = exposure.height_m;
  std::vector<double> visibility(series.rows.size(), 0.0);
  for (std::size_t k = 0; k < exposure.visibility.size(); ++k)
    visibility[solved.classes->row_of_series(k)] = exposure.visibility[k];
  return thermal::solve_surface(solved.thermal.solid, solved.thermal.skin, stand, series,
                                solved.thermal.start, std::move(visibility), exposure.past_free_sky,
                                std::move(beside));
}

double second_pass_k(const Neighbourhood& about, const SolvedMaterial& solved,
                     const geometry::SurfacePoint& point, std::uint64_t key,
                     const exposure::SolvedSurface::Exposure& exposure, double first_pass_k) {
  const math::Vec3 normal =
      exposure::SolvedSurface(solved.classes, about.past, about.sun_radius_rad).normal_at(point);
  const double view = 1.0 - exposure.free_sky * 0.5 * (1.0 + normal.z);
  if (!(view > kLeastOfView)) return 0.0;
  const sampling::TangentFrame frame(normal);
  const math::Vec3 outward =
      point.front ? point.geometric_normal.as_vector() : -point.geometric_normal.as_vector();
  std::vector<math::Ray> rays;
  for (int k = 0; k < kRays; ++k) {
    const double x = sampling::unit_double(sampling::hash(key, k, 0)),
                 y = sampling::unit_double(sampling::hash(key, k, 1));
    const math::Vec3 along = frame.to_world(sampling::cosine_hemisphere({(k + x) / kRays, y}));
    if (math::dot(along, outward) > 0.0)
      rays.push_back({.origin_m = point.position_m + point.offset_m * outward, .direction = along});
  }
  std::vector<geometry::SurfacePoint> hits(rays.size());
  about.scene.world->intersect(rays, hits);
  std::vector<thermal::FromBeside> beside(about.series.rows.size());
  double count = 0.0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!hits[k].hit() && rays[k].direction.z > 0.0) continue;  // sky
    count += 1.0;
    if (hits[k].hit()) {
      const std::vector<thermal::FromBeside> sent = sent_by(about, hits[k], sampling::hash(key, k, 2));
      for (std::size_t row = 0; row < beside.size(); ++row) {
        beside[row].sunlight_w_m2 += sent[row].sunlight_w_m2;
        beside[row].longwave_w_m2 += sent[row].longwave_w_m2;
      }
      continue;
    }
    for (std::size_t row = 0; row < beside.size(); ++row) {
      const thermal::FromBeside ground = thermal::of_level_ground(about.series.rows[row], about.stand);
      beside[row].sunlight_w_m2 += ground.sunlight_w_m2;
      beside[row].longwave_w_m2 += ground.longwave_w_m2;
    }
  }
  if (!(count > 0.0)) return 0.0;
  for (thermal::FromBeside& row : beside) {
    row.sunlight_w_m2 *= view / count;
    row.longwave_w_m2 *= view / count;
  }
  return full_solution(solved, about.series, about.stand, normal, exposure, std::move(beside))
             .history.nodes.back()
             .surface_k -
         first_pass_k;
}

}  // namespace ifov::session
