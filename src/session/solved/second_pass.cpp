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
#include "session/assembly/whole/camera_grid.h"
#include "thermal/faces/sky_longwave.h"

namespace ifov::session {
namespace {

constexpr int kSkyPairsOfNeighbour = 8;
constexpr int kDrawsOfRay = 48, kDrawsOfPoint = 48, kTriesOfRay = 40;
constexpr double kLeastOfView = 0.002;  // that is not sky
constexpr double kLeastHit = 0.025;     // of rays, below which the fewer meet something

double open_share(math::Vec3 normal, bool two_faces) { return two_faces ? 1.0 : 0.5 * (1.0 + normal.z); }

/// What of a sheet of two faces the one sends that was met: light that came to it, and, through a leaf, to the other one.
std::vector<thermal::FromBeside> sent_by_face(const Neighbourhood& about, const SolvedMaterial& solved,
                                              const scene::Constituent& main, bool is_solved,
                                              const geometry::SurfacePoint& hit,
                                              const thermal::SurfaceSolution& solution, std::uint64_t key,
                                              int depth) {
  const thermal::Skin& both = solution.balance.skin();
  thermal::Skin one = both;
  one.two_faces = false;
  one.solar_absorptance = one.emissivity = 1.0;
  const double through = is_solved ? both.transmittance : 0.0;
  const double back = is_solved ? 1.0 - both.solar_absorptance - through : about.stand.ground_reflectance;
  const double emissivity = is_solved ? both.emissivity : 1.0;
  const double state_k = about.scene.states[main.state].temperature_k;
  const double given_k = main.mapped_temperature_k > 0.0 ? main.mapped_temperature_k : state_k;
  const exposure::SolvedSurface surface =
      exposure::SolvedSurface(solved.classes, about.past, about.sun_radius_rad).exposed_on(false);
  std::vector<thermal::FromBeside> sent(about.series.rows.size());
  for (const bool other : {false, true}) {
    if (other && !(through > 0.0)) break;
    geometry::SurfacePoint face = hit;
    if (other) face.front = !hit.front;
    const auto exposure = surface.exposure(face, sampling::hash(key, other), kSkyPairsOfNeighbour, 1);
    const std::uint64_t own = sampling::hash(key, depth, other);
    const thermal::SurfaceBalance balance =
        face_balance(solved, one, about.series, about.stand, surface.normal_at(face), exposure,
                     depth > 0 ? beside_of(about, face, exposure, own, about.rays_beyond, depth - 1)
                               : std::vector<thermal::FromBeside>());
    for (std::size_t row = 0; row < sent.size(); ++row) {
      const double surface_k = is_solved       ? solution.surface_k(row)
                               : given_k > 0.0 ? given_k
                                               : about.series.rows[row].air.temperature_k;
      const thermal::Fluxes fluxes =
          balance.fluxes(about.series.begin_s + about.series.step_s * static_cast<double>(row), surface_k);
      sent[row].sunlight_w_m2 += (other ? through : back) * (fluxes.sun + fluxes.sky + fluxes.reflected);
      if (other) continue;
      sent[row].longwave_w_m2 = emissivity * thermal::kStefanBoltzmann_w_m2_k4 * std::pow(surface_k, 4) +
                                (1.0 - emissivity) * (fluxes.sky_longwave + fluxes.ground_longwave);
    }
  }
  return sent;
}

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
  const thermal::SurfaceSolution solution =
      full_solution(solved, about.series, about.stand, surface.normal_at(hit), exposure,
                    depth > 0 ? beside_of(about, hit, exposure, sampling::hash(key, depth), about.rays_beyond,
                                          depth - 1, solved.classes->two_faces())
                              : std::vector<thermal::FromBeside>());
  if (solved.classes->two_faces())
    return sent_by_face(about, solved, main, is_solved, hit, solution, key, depth);
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
Beside rays_beside(const Neighbourhood& about, bool two_faces, const geometry::SurfacePoint& point,
                   math::Vec3 normal, double free_sky, std::uint64_t key, int rays) {
  Beside found;
  found.view = (two_faces ? 2.0 : 1.0) - free_sky * open_share(normal, two_faces);
  if (!(found.view > kLeastOfView)) return found;
  const sampling::TangentFrame of_side(normal), of_other(-normal);
  const exposure::ExposedPoint exposed(about.past, point, two_faces);
  // Strata are gone through once, all of them: as many as let about that many rays meet something.
  const int strata = static_cast<int>(std::ceil(rays / std::max(found.view, kLeastHit)));
  for (int k = 0; k < strata || (found.hits.empty() && k < kTriesOfRay * strata); ++k) {
    const double x = sampling::unit_double(sampling::hash(key, k, 0)),
                 y = sampling::unit_double(sampling::hash(key, k, 1));
    const sampling::Point2 place{(k % strata + x) / strata, y};
    const bool other = two_faces && sampling::unit_double(sampling::hash(key, k, 2)) < 0.5;
    const math::Vec3 along = (other ? of_other : of_side).to_world(sampling::cosine_hemisphere(place));
    if (!exposed.leaves(along)) continue;
    const math::Ray ray = exposed.ray(along);
    geometry::SurfacePoint hit;
    about.scene.world->intersect({&ray, 1}, {&hit, 1});
    if (!hit.hit() && along.z > 0.0) continue;
    found.directions.push_back(along);
    found.hits.push_back(hit);
  }
  return found;
}

std::vector<thermal::FromBeside> sum_of(const Neighbourhood& about, const Beside& beside,
                                        const exposure::SolvedSurface::Exposure& exposure, bool two_faces,
                                        math::Vec3 normal, std::uint64_t key, int depth) {
  std::vector<thermal::FromBeside> sum;
  const double open = open_share(normal, two_faces), all = two_faces ? 2.0 : 1.0;
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
          exposure.past_free_sky.empty() ? beside.view : all - exposure.past_free_sky[row] * open;
      sum[row].sunlight_w_m2 += view / count * one.sunlight_w_m2;
      sum[row].longwave_w_m2 += view / count * one.longwave_w_m2;
    }
  }
  return sum;
}

constexpr int kRaysOn = 4;  // from each point that the camera sees

constexpr int kAcross = 24;  // rays along each side of the image

}  // namespace

std::vector<geometry::SurfacePoint> seen_evenly(const scene::Scene& scene, const sensor::Camera& camera) {
  return hits_of_camera(*scene.world, camera, kAcross);
}

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

thermal::SurfaceBalance face_balance(const SolvedMaterial& solved, const thermal::Skin& skin,
                                     const thermal::OutdoorsSeries& series, thermal::Stand stand,
                                     math::Vec3 normal, const exposure::SolvedSurface::Exposure& exposure,
                                     std::vector<thermal::FromBeside> beside) {
  stand.tilt_rad = std::acos(std::clamp(normal.z, -1.0, 1.0));
  stand.azimuth_rad = std::atan2(normal.x, normal.y);
  stand.free_sky = exposure.free_sky;
  stand.height_m = exposure.height_m;
  std::vector<double> visibility(series.rows.size(), 0.0);
  for (std::size_t k = 0; k < exposure.visibility.size(); ++k)
    visibility[solved.classes->row_of_series(k)] = exposure.visibility[k];
  return {series, skin, stand, std::move(visibility), exposure.past_free_sky, std::move(beside)};
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
                                           std::uint64_t key, int rays, int depth, bool two_faces) {
  const math::Vec3 normal = exposure::ExposedPoint(about.past, point, two_faces).normal();
  return sum_of(about, rays_beside(about, two_faces, point, normal, exposure.free_sky, key, rays), exposure,
                two_faces, normal, key, depth);
}

BesideOff beside_off(const Neighbourhood& about, const exposure::SolvedSurface& surface,
                     const SolvedMaterial& solved, const geometry::SurfacePoint& point, std::uint64_t key,
                     const exposure::SolvedSurface::Exposure& exposure, double full_k, int rays) {
  constexpr int kDepth = 1;  // of both: what lies further behind is told by further_k
  BesideOff found;
  const exposure::ExposedPoint exposed(about.past, point, solved.classes->two_faces());
  const math::Vec3 normal = exposed.normal();
  const thermal::Pose pose(normal, exposure.height_m);
  const thermal::SurfaceClasses::Corners at = solved.classes->corners(pose);
  const double sun = surface.sun_share(point, exposure);
  for (std::size_t half = 0; half < found.off_k.size(); ++half) {
    const std::uint64_t own = sampling::hash(key, half);
    const Beside beside =
        rays_beside(about, solved.classes->two_faces(), point, normal, exposure.free_sky, own, rays);
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
    const double there_k =
        full_solution(solved, about.series, about.stand, normal, exposure,
                      sum_of(about, beside, exposure, solved.classes->two_faces(), normal, own, kDepth))
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
