// What comes to a point from the surfaces about it, and what images make of that.
#include <gtest/gtest.h>

#include <cmath>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "sampling/random.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "session/solved/second_pass.h"
#include "thermal/faces/sky_longwave.h"

namespace ifov::session::test_beside {
namespace {

constexpr double kSunRadius_rad = 0.00465;

Session load(const DaysOfJune& weather, const char* hour, const std::string& materials,
             const std::string& objects) {
  LoadOptions options;
  options.unseen_temperatures = true;
  return Session::load(
      io::parse_document(format(
                             R"({{"ifov": 1, "time": "2026-06-21T{}:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "10 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}}, "materials": {{{}}}, "objects": [{}]}},
          "light": {{"sky": {{"temperature": "255 K"}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "0.5 m", "pixels": [16, 16]}}}},
            "channels": [{{"name": "thermal", "monochromatic": {{"at": "10 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "50 K"}}}}}})",
                             hour, weather.path(), materials, objects),
                         "beside.json"),
      nullptr, options);
}

geometry::SurfacePoint met_by(const Parts& parts, math::Point3 from, math::Vec3 along) {
  const math::Ray ray{.origin_m = from, .direction = along};
  geometry::SurfacePoint hit;
  parts.scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit;
}

/// What there is to ask about a point of a scene; keeps a reference to it.
struct About {
  explicit About(const Session& session)
      : parts(session.parts()),
        outdoors(outdoors_of_document(parts.document, *parts.weather)),
        by_material(solved_materials(parts.document, parts.scene, outdoors.mean_air_k)) {
    stand.terrain = outdoors.terrain;
  }
  Neighbourhood all(const SolvedMaterial& solved) const {
    return {parts.scene, solved.surface->scene(), by_material, outdoors.outdoors.series,
            stand,       kSunRadius_rad};
  }
  const Parts& parts;
  DocumentOutdoors outdoors;
  ByMaterial by_material;
  thermal::Stand stand;
};

/// Of a level surface, a long wall of the height h at the distance d fills (1 - cos(atan(h / d))) / 2 of the view.
TEST(WhatIsBeside, TwoLongWallsByTheirViewFactors) {
  constexpr double kHot_k = 330.0, kCold_k = 250.0, kAway_m = 2.0, kHigh_m = 3.0;
  constexpr int kRays = 6, kDraws = 100;
  const ClearDays weather("walls", 2.5);
  const Session session =
      load(weather, "02:00",
           R"("road": {"reflectance": {"library": "asphalt, road, weathered"}, "temperature": "solved"},
         "hot": {"emissivity": 1, "temperature": "330 K"}, "cold": {"emissivity": 1, "temperature": "250 K"})",
           format(
               R"({{"plane": {{}}, "material": "road"}},
             {{"box": {{"low": ["{0} m", "-900 m", "0 m"], "high": ["9 m", "900 m", "{1} m"]}}, "material": "hot"}},
             {{"box": {{"low": ["-9 m", "-900 m", "0 m"], "high": ["-{0} m", "900 m", "{1} m"]}}, "material": "cold"}})",
               kAway_m, kHigh_m));
  const About about(session);
  const SolvedMaterial& road = about.by_material.at(0);
  const geometry::SurfacePoint point = met_by(about.parts, {0.0, 0.0, 0.3}, {0.0, 0.0, -1.0});
  exposure::SolvedSurface::Exposure exposure = road.surface->exposure(point, 1, 2, 1);
  const double of_wall = 0.5 * (1.0 - std::cos(std::atan(kHigh_m / kAway_m)));
  exposure.free_sky = 1.0 - 2.0 * of_wall;
  const auto share_of_hot = [&](std::uint64_t key) {  // of what comes from walls, by the heat of both
    const double mean = beside_of(about.all(road), point, exposure, key, kRays, 0).back().longwave_w_m2 /
                        (2.0 * of_wall * thermal::kStefanBoltzmann_w_m2_k4);
    return (mean - std::pow(kCold_k, 4)) / (std::pow(kHot_k, 4) - std::pow(kCold_k, 4));
  };
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < kDraws; ++k) {
    const double share = share_of_hot(sampling::hash(3, k));
    sum += share / kDraws;
    squares += share * share / kDraws;
  }
  const double error = std::sqrt(std::max(0.0, squares - sum * sum) / kDraws);
  EXPECT_NEAR(sum, 0.5, 3.0 * error);
  EXPECT_LT(error, 0.02);
}

/// A camera that looks straight down sees no wall; what walls may be off by is known all the same: images hold their light by way of the road.
TEST(WhatIsBeside, HalfWidthsHoldWallsThatTheCameraDoesNotSee) {
  constexpr int kPoints = 12, kSkyPairs = 64, kRays = 96, kDraws = 800;
  const ClearDays weather("street", 1.0);
  const Session session =
      load(weather, "12:00",
           R"("road": {"reflectance": {"library": "asphalt, road, weathered"}, "temperature": "solved"},
         "roof": {"reflectance": 0.3, "temperature": "290 K"},
         "wall": {"reflectance": {"library": "brick, red"}, "temperature": "solved"})",
           R"({"plane": {}, "material": "road"},
         {"box": {"low": ["-40 m", "3 m", "0 m"], "high": ["40 m", "9 m", "8 m"]}, "material": "wall"},
         {"box": {"low": ["-40 m", "-9 m", "0 m"], "high": ["40 m", "-3 m", "8 m"]}, "material": "wall"},
         {"box": {"low": ["-40 m", "-9 m", "8 m"], "high": ["40 m", "-2.99 m", "8.1 m"]}, "material": "roof"},
         {"box": {"low": ["-40 m", "2.99 m", "8 m"], "high": ["40 m", "9 m", "8.1 m"]}, "material": "roof"})");
  const About about(session);
  constexpr std::uint32_t kWall = 2;
  const SolvedMaterial& wall = about.by_material.at(kWall);
  TemperatureErrors::OfMaterial error = about.parts.temperature_errors->by_material.at(kWall);
  EXPECT_EQ(error.seen, 0);
  EXPECT_EQ(error.beside, 0);
  ASSERT_GT(error.met_beside, 0);
  const double half_width_k = error.whole_half_width_k();
  error.met_beside_k = 0.0;
  int held = 0, held_by_classes = 0;
  for (int k = 0; k < kPoints; ++k) {
    const geometry::SurfacePoint point =
        met_by(about.parts, {-5.0 + 0.8 * k, 0.0, 0.4 + 0.6 * k}, {0.0, k % 2 == 0 ? 1.0 : -1.0, 0.0});
    const auto key = static_cast<std::uint64_t>(k);
    const auto exposure = wall.surface->exposure(point, key, kSkyPairs, 4);
    const auto beside = beside_of(about.all(wall), point, exposure, key, kRays, 1);
    const double full_k = full_solution(wall, about.outdoors.outdoors.series, about.stand,
                                        wall.surface->normal_at(point), exposure, beside)
                              .history.nodes.back()
                              .surface_k;
    const double off_k = wall.surface->temperature_k(point, exposure) +
                         wall.surface->beside_k(point, exposure, key, kDraws) - full_k;
    held += std::abs(off_k) <= half_width_k;
    held_by_classes += std::abs(off_k) <= error.whole_half_width_k();
  }
  EXPECT_GE(held, kPoints - 1) << half_width_k;
  EXPECT_LT(half_width_k, 1.5);
  EXPECT_LT(held_by_classes, kPoints / 2);  // a fault: what is about walls left out, as nobody sees them
}

/// In a narrow street of bright walls light goes on from wall to wall: against full solutions with three surfaces behind those that are met,
/// images have two. The fault: one.
TEST(WhatIsBeside, LightGoesOnFromWallToWall) {
  constexpr int kPoints = 6, kSkyPairs = 64, kRays = 16, kDraws = 1000;
  const ClearDays weather("bright", 1.0);
  const Session session =
      load(weather, "13:00",
           R"("road": {"reflectance": {"library": "asphalt, road, weathered"}, "temperature": "solved"},
         "wall": {"reflectance": {"library": "brick, red"}, "temperature": "solved",
                  "thermal": {"layers": [{"thickness": "20 cm", "library": "brick"}], "solar_absorptance": 0.1, "emissivity": 0.9}})",
           R"({"plane": {}, "material": "road"},
         {"box": {"low": ["1 m", "-40 m", "0 m"], "high": ["9 m", "40 m", "8 m"]}, "material": "wall"},
         {"box": {"low": ["-9 m", "-40 m", "0 m"], "high": ["-1 m", "40 m", "8 m"]}, "material": "wall"})");
  const About about(session);
  const SolvedMaterial& road = about.by_material.at(0);
  double off_k = 0.0, by_one_k = 0.0;
  for (int k = 0; k < kPoints; ++k) {
    const geometry::SurfacePoint point =
        met_by(about.parts, {-0.8 + 0.3 * k, 0.7 * k, 0.3}, {0.0, 0.0, -1.0});
    const auto key = static_cast<std::uint64_t>(k);
    const auto exposure = road.surface->exposure(point, key, kSkyPairs, 1);
    const auto beside = beside_of(about.all(road), point, exposure, key, kRays, 3);
    const double full_k = full_solution(road, about.outdoors.outdoors.series, about.stand,
                                        road.surface->normal_at(point), exposure, beside)
                              .history.nodes.back()
                              .surface_k;
    const double of_classes_k = road.surface->temperature_k(point, exposure) - full_k;
    off_k += (of_classes_k + road.surface->beside_k(point, exposure, key, kDraws)) / kPoints;
    by_one_k += (of_classes_k + road.surface->beside_k(point, exposure, key, kDraws, -1)) / kPoints;
  }
  EXPECT_NEAR(off_k, 0.0, 0.3);
  EXPECT_LT(by_one_k, off_k - 0.2);
}

}  // namespace
}  // namespace ifov::session::test_beside
