#include "session/solved/second_pass.h"

#include <algorithm>
#include <cmath>

#include "exposure/exposed_point.h"
#include "exposure/neighbours.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "thermal/sky_longwave.h"

namespace ifov::session {
namespace {

constexpr int kSkyPairsOfNeighbour = 8;
constexpr int kDrawsOfRay = 48, kDrawsOfPoint = 48, kTriesOfRay = 40;
constexpr double kLeastOfView = 0.002;  // that is not sky
constexpr double kLeastHit = 0.025;     // of rays, below which the fewer meet something

/// What a surface sends to all sides by row of the series, W m-2.
std::vector<thermal::FromBeside> sent_by(const Neighbourhood& about, const geometry::SurfacePoint& hit,
                                         std::uint64_t key, int depth) {
  const scene::Constituent main = about.scene.resolve_without_temperature(hit).constituents[0];
  const scene::SurfaceState& state = about.scene.states[main.state];
  const bool is_solved = state.solved > 0;
  const SolvedMaterial& solved =
      is_solved ? about.by_material.at(state.solved - 1) : about.by_material.begin()->second;
  const exposure::SolvedSurface surface(solved.classes, about.past, about.sun_radius_rad);
  const auto exposure = surface.exposure(hit, key, kSkyPairsOfNeighbour, 1);
  const thermal::SurfaceSolution solution = full_solution(
      solved, about.series, about.stand, surface.normal_at(hit), exposure,
      depth > 0 ? beside_of(about, hit, exposure, sampling::hash(key, depth), about.rays_beyond, depth - 1)
                : std::vector<thermal::FromBeside>());
  const double absorbed = solution.balance.skin().solar_absorptance;
  const double reflected = is_solved ? 1.0 - absorbed : about.stand.ground_reflectance;
  const double of_light = absorbed > 0.0 ? reflected / absorbed : 0.0;
  const double emissivity = is_solved ? solution.balance.skin().emissivity : 1.0;
  const double given_k = main.mapped_temperature_k > 0.0 ? main.mapped_temperature_k : state.temperature_k;
  std::vector<thermal::FromBeside> sent(about.series.rows.size());
  for (std::size_t row = 0; row < sent.size(); ++row) {
    const double surface_k = is_solved       ? solution.surface_k(row)
                             : given_k > 0.0 ? given_k
                                             : about.series.rows[row].air.temperature_k;
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

/// Rays by their cosines to all but the sky; of the ground behind the horizon nothing is met.
struct Beside {
  double view = 0.0;  ///< share of all that is seen
  std::vector<math::Vec3> directions;
  std::vector<geometry::SurfacePoint> hits;
};
Beside rays_beside(const Neighbourhood& about, const geometry::SurfacePoint& point, math::Vec3 normal,
                   double free_sky, std::uint64_t key, int rays) {
  Beside found;
  found.view = 1.0 - free_sky * 0.5 * (1.0 + normal.z);
  if (!(found.view > kLeastOfView)) return found;
  const sampling::TangentFrame frame(normal);
  const math::Vec3 outward =
      point.front ? point.geometric_normal.as_vector() : -point.geometric_normal.as_vector();
  // Strata are gone through once, all of them: as many as let about that many rays meet something.
  const int strata = static_cast<int>(std::ceil(rays / std::max(found.view, kLeastHit)));
  for (int k = 0; k < strata || (found.hits.empty() && k < kTriesOfRay * strata); ++k) {
    const double x = sampling::unit_double(sampling::hash(key, k, 0)),
                 y = sampling::unit_double(sampling::hash(key, k, 1));
    const math::Vec3 along = frame.to_world(sampling::cosine_hemisphere({(k % strata + x) / strata, y}));
    if (!(math::dot(along, outward) > 0.0)) continue;
    const math::Ray ray{.origin_m = point.position_m + point.offset_m * outward, .direction = along};
    geometry::SurfacePoint hit;
    about.scene.world->intersect({&ray, 1}, {&hit, 1});
    if (!hit.hit() && along.z > 0.0) continue;
    found.directions.push_back(along);
    found.hits.push_back(hit);
  }
  return found;
}

std::vector<thermal::FromBeside> sum_of(const Neighbourhood& about, const Beside& beside,
                                        const exposure::SolvedSurface::Exposure& exposure, double open,
                                        std::uint64_t key, int depth) {
  std::vector<thermal::FromBeside> sum;
  if (beside.hits.empty()) return sum;
  sum.resize(about.series.rows.size());
  const auto count = static_cast<double>(beside.hits.size());
  for (std::size_t k = 0; k < beside.hits.size(); ++k) {
    std::vector<thermal::FromBeside> sent;
    if (beside.hits[k].hit()) sent = sent_by(about, beside.hits[k], sampling::hash(key, k, 2), depth);
    for (std::size_t row = 0; row < sum.size(); ++row) {
      const thermal::FromBeside one =
          sent.empty() ? thermal::of_level_ground(about.series.rows[row], about.stand) : sent[row];
      const double view =
          exposure.past_free_sky.empty() ? beside.view : 1.0 - exposure.past_free_sky[row] * open;
      sum[row].sunlight_w_m2 += view / count * one.sunlight_w_m2;
      sum[row].longwave_w_m2 += view / count * one.longwave_w_m2;
    }
  }
  return sum;
}

math::Vec3 outward_normal(const geometry::SurfacePoint& point) {
  const math::Vec3 normal = point.shading_normal.as_vector();
  return point.front ? normal : -normal;
}

constexpr int kRaysOn = 4;  // from each point that the camera sees

}  // namespace

std::vector<geometry::SurfacePoint> met_from(const scene::Scene& scene, const exposure::PastScene& past,
                                             std::span<const geometry::SurfacePoint> seen) {
  std::vector<math::Ray> rays;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (!seen[k].hit()) continue;
    const exposure::ExposedPoint from(past, seen[k]);
    const sampling::TangentFrame frame(from.normal());
    for (int n = 0; n < kRaysOn; ++n) {
      const auto number = [&](int of) { return sampling::unit_double(sampling::hash(k, n, of)); };
      const math::Vec3 along =
          frame.to_world(sampling::cosine_hemisphere({(n + number(0)) / kRaysOn, number(1)}));
      if (from.leaves(along)) rays.push_back(from.ray(along));
    }
  }
  std::vector<geometry::SurfacePoint> met(rays.size());
  scene.world->intersect(rays, met);
  return met;
}

ByMaterial solved_materials(const io::Document& document, const scene::Scene& scene, double deep_k) {
  ByMaterial by_material;
  for (std::uint32_t number = 0; number < scene.solved.size(); ++number)
    if (auto surface = std::dynamic_pointer_cast<const exposure::SolvedSurface>(scene.solved[number]))
      by_material[number] = {*assemble_thermal(document.sources, document.scene.materials[number],
                                               scene.materials[number], deep_k),
                             surface->shared_classes(), surface};
  return by_material;
}

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

std::vector<thermal::FromBeside> beside_of(const Neighbourhood& about, const geometry::SurfacePoint& point,
                                           const exposure::SolvedSurface::Exposure& exposure,
                                           std::uint64_t key, int rays, int depth) {
  const math::Vec3 normal = outward_normal(point);
  return sum_of(about, rays_beside(about, point, normal, exposure.free_sky, key, rays), exposure,
                0.5 * (1.0 + normal.z), key, depth);
}

BesideOff beside_off(const Neighbourhood& about, const exposure::SolvedSurface& surface,
                     const SolvedMaterial& solved, const geometry::SurfacePoint& point, std::uint64_t key,
                     const exposure::SolvedSurface::Exposure& exposure, double full_k, int rays) {
  constexpr int kDepth = 1;  // of both: what lies further behind is told by further_k
  BesideOff found;
  const math::Vec3 normal = outward_normal(point);
  const exposure::ExposedPoint exposed(about.past, point);
  const thermal::Pose pose(normal, exposure.height_m);
  const thermal::SurfaceClasses::Corners at = solved.classes->corners(pose);
  const double sun = surface.sun_share(point, exposure);
  for (std::size_t half = 0; half < found.off_k.size(); ++half) {
    const std::uint64_t own = sampling::hash(key, half);
    const Beside beside = rays_beside(about, point, normal, exposure.free_sky, own, rays);
    if (beside.hits.empty()) return found;
    double linear_k = 0.0;
    for (std::size_t k = 0; k < beside.hits.size(); ++k)
      for (int draw = 0; draw < kDrawsOfRay; ++draw) {
        const auto change = surface.neighbours()->change(
            exposed, *solved.classes, at, beside.directions[k], sampling::hash(own, k, draw),
            {kDepth, 1.0, exposed.position_m().z - pose.height_m});
        linear_k += (change.in_shade_k + sun * change.of_sun_k) / kDrawsOfRay;
      }
    linear_k *= beside.view / static_cast<double>(beside.hits.size());
    linear_k -= solved.classes->bend_of_gain(at) * linear_k * linear_k;
    const double there_k = full_solution(solved, about.series, about.stand, normal, exposure,
                                         sum_of(about, beside, exposure, 0.5 * (1.0 + normal.z), own, kDepth))
                               .history.nodes.back()
                               .surface_k;
    found.taken_k[half] = linear_k;
    found.off_k[half] = full_k + linear_k - there_k;
  }
  found.further_k = surface.beside_k(point, exposure, key, kDrawsOfPoint, 1) -
                    surface.beside_k(point, exposure, key, kDrawsOfPoint);
  return found;
}

}  // namespace ifov::session
