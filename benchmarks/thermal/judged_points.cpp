#include "thermal/judged_points.h"

#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "honesty/random_stream.h"
#include "io/document/document.h"
#include "sampling/random.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "session/solved/second_pass.h"

namespace ifov::benchmarks {
namespace {

constexpr double kFar_m = 200.0, kSunRadius_rad = 0.00465;
constexpr int kTries = 200, kParts = 4;

struct Found {
  geometry::SurfacePoint at;
  std::uint32_t material = 0;
  bool from_above = false;
};

geometry::SurfacePoint met_by(const scene::Scene& scene, math::Point3 from, math::Vec3 along) {
  const math::Ray ray{.origin_m = from, .direction = along};
  geometry::SurfacePoint hit;
  scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit;
}

/// From above at up to 60 degrees, or from anywhere among the things in any direction: walls, and what faces down.
std::vector<Found> random_surfaces(const scene::Scene& scene, double reach_m, double top_m, int points,
                                   std::uint64_t seed) {
  RandomStream random(0x90127, seed);
  std::vector<Found> found;
  for (int k = 0; k < kTries * points && found.size() < static_cast<std::size_t>(points); ++k) {
    const bool from_above = found.size() % 2 == 0;
    const math::Point3 place{random.between(-reach_m, reach_m), random.between(-reach_m, reach_m),
                             random.between(0.05, top_m)};
    const double height = random.between(from_above ? 0.5 : -0.3, 1.0),
                 turn = random.between(0.0, 2.0 * std::numbers::pi),
                 level = std::sqrt(std::max(0.0, 1.0 - height * height));
    const math::Vec3 away{level * std::cos(turn), level * std::sin(turn), height};
    if (!from_above) {  // not inside of a solid
      const auto over = met_by(scene, place, {0.0, 0.0, 1.0});
      if (over.hit() && !over.front) continue;
    }
    const geometry::SurfacePoint hit =
        from_above ? met_by(scene, place + kFar_m * away, -away) : met_by(scene, place, away);
    if (!hit.hit()) continue;
    const std::uint32_t by =
        scene.states[scene.resolve_without_temperature(hit).constituents[0].state].solved;
    if (by > 0) found.push_back({hit, by - 1, from_above});
  }
  return found;
}

}  // namespace

double JudgedPoint::noise_k() const { return std::hypot(image_error_k, full_error_k); }

std::vector<JudgedPoint> judge_points(const std::string& text, const std::string& name, double reach_m,
                                      double top_m, int points, std::uint64_t seed,
                                      const ThermalEffort& effort, int threads) {
  session::LoadOptions options;
  options.threads = threads;
  options.unseen_temperatures = true;
  const session::Session session = session::Session::load(io::parse_document(text, name), nullptr, options);
  const session::Parts& parts = session.parts();
  const session::DocumentOutdoors about = session::outdoors_of_document(parts.document, *parts.weather);
  const session::ByMaterial by_material =
      session::solved_materials(parts.document, parts.scene, about.mean_air_k);
  thermal::Stand stand;
  stand.terrain = about.terrain;
  const std::vector<Found> found = random_surfaces(parts.scene, reach_m, top_m, points, seed);
  std::vector<JudgedPoint> judged(found.size());
  parallel_for(static_cast<std::int64_t>(found.size()), threads, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const std::uint64_t key = sampling::hash(seed, k);
    const geometry::SurfacePoint& at = found[k].at;
    const session::SolvedMaterial& solved = by_material.at(found[k].material);
    const exposure::SolvedSurface& surface = *solved.surface;
    auto exposure = surface.exposure(at, key, effort.sky_pairs, effort.sun_rays);
    const math::Vec3 normal = surface.normal_at(at);
    const session::Neighbourhood all{parts.scene,           surface.scene(), by_material,
                                     about.outdoors.series, stand,           kSunRadius_rad};
    const auto full_k = [&](std::vector<thermal::FromBeside> beside) {
      return session::full_solution(solved, about.outdoors.series, stand, normal, exposure, std::move(beside))
          .history.nodes.back()
          .surface_k;
    };
    const auto linear_k = [&](const std::vector<thermal::FromBeside>& beside) {
      if (beside.empty()) return 0.0;
      const auto& classes = *solved.classes;
      std::vector<double> in_shade(classes.bins()), of_sun(classes.bins());
      const thermal::Pose pose(normal, exposure.height_m);
      classes.worth(pose, in_shade, of_sun);
      const double sun = surface.sun_share(at, exposure),
                   view = classes.skin().faces() - exposure.free_sky * classes.open_share(normal);
      double sum_k = 0.0;
      for (std::size_t bin = 0; bin < classes.bins(); ++bin) {
        const auto rows = classes.rows_of_bin(bin);
        for (std::size_t row = rows.first + 1 - rows.count; row <= rows.first; ++row) {
          thermal::FromBeside one = beside[row];
          one.sunlight_w_m2 /= view, one.longwave_w_m2 /= view;
          sum_k += (in_shade[bin] + sun * of_sun[bin]) / static_cast<double>(rows.count) * view *
                   classes.more_than_ground_w_m2(one, row);
        }
      }
      return sum_k;
    };
    JudgedPoint& point = judged[k];
    point.x = at.position_m.x, point.y = at.position_m.y, point.z = at.position_m.z;
    point.material = parts.document.scene.materials[found[k].material].name;
    point.up = normal.z;
    point.from_above = found[k].from_above;
    point.free_sky = exposure.free_sky;
    point.sun_share = surface.sun_share(at, exposure);
    point.half_width_k = parts.temperature_errors->by_material.at(found[k].material).whole_half_width_k();
    double full_sum_k = 0.0, full_squares_k2 = 0.0;
    for (int part = 0; part < kParts; ++part) {
      const std::uint64_t own = sampling::hash(key, part);
      exposure = surface.exposure(at, own, effort.sky_pairs, effort.sun_rays);
      const auto beside = session::beside_of(all, at, exposure, own, effort.rays_beside, effort.depth,
                                             surface.classes().two_faces());
      point.linear_k += linear_k(beside) / kParts;
      const double part_k = full_k(beside), alone_k = full_k({});
      point.class_off_k += (surface.temperature_k(at, exposure) - alone_k) / kParts;
      point.beside_k += (part_k - alone_k) / kParts;
      if (part == 0) point.full_k = part_k;
      full_sum_k += part_k - point.full_k;
      full_squares_k2 += (part_k - point.full_k) * (part_k - point.full_k);
    }
    point.full_k += full_sum_k / kParts;
    point.full_error_k = std::sqrt(std::max(0.0, full_squares_k2 - full_sum_k * full_sum_k / kParts) /
                                   (kParts * (kParts - 1.0)));
    double sum_k = 0.0, squares_k2 = 0.0, told_k2 = 0.0;
    for (int draw = 0; draw < effort.draws; ++draw) {
      const scene::EstimatedTemperature one = surface.at(at, sampling::hash(key, draw, 7));
      sum_k += one.kelvin - point.full_k;
      squares_k2 += (one.kelvin - point.full_k) * (one.kelvin - point.full_k);
      told_k2 += one.deviation_k * one.deviation_k;
    }
    const double mean_k = sum_k / effort.draws;
    point.image_k = point.full_k + mean_k;
    point.image_error_k =
        std::sqrt(std::max(0.0, squares_k2 / effort.draws - mean_k * mean_k) / effort.draws);
    point.told_error_k = std::sqrt(told_k2 / effort.draws / effort.draws);
  });
  return judged;
}

}  // namespace ifov::benchmarks
