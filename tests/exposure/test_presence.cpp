// Thermal shadows of what is gone, and none of what has just come: against one dimension solved alone, with the Sun and the sky
// let in at the minute, as a box that is written here hides them.
#include <gtest/gtest.h>

#include <cmath>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "studies/temperature/outlined_box.h"
#include "thermal/surface_solution.h"

namespace ifov::session::test_presence {
namespace {

constexpr studies::OutlinedBox kCar{2.2, 0.9, 1.5};  // along east and north

/// A car on asphalt at 15 h; `present`: of the car, with its key, or nothing.
Session load(const ClearDays& weather, const std::string& present, const char* step = "5 min") {
  return Session::load(
      io::parse_document(format(
                             R"({{"ifov": 1, "time": "2026-06-21T15:00:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "{}", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}},
            "materials": {{"road": {{"emissivity": 1, "temperature": "solved",
                "thermal": {{"layers": [{{"thickness": "10 cm", "library": "asphalt"}}, {{"thickness": "50 cm", "library": "dry soil"}}],
                            "back": {{"ground": {{"temperature": "12 degC"}}}}, "solar_absorptance": 0.9}}}},
              "paint": {{"emissivity": 0.9, "temperature": "300 K"}}}},
            "objects": [{{"plane": {{}}, "material": "road"}},
              {{"box": {{"low": ["-2.2 m", "-0.9 m", "0 m"], "high": ["2.2 m", "0.9 m", "1.5 m"]}}, "material": "paint"{}}}]}},
          "light": {{"sky": {{"none": {{}}}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "0.5 m", "pixels": [24, 16]}}}},
            "channels": [{{"name": "thermal", "top_hat": {{"from": "10 um", "to": "11 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "20 K"}}}}}})",
                             weather.path(), step, present),
                         "parked.json"),
      nullptr);
}

/// The road at a place, solved in full by itself over minutes, where the car stood from `from_min` to `to_min` before the end.
double alone_k(const Session& of, double x, double y, double from_min, double to_min) {
  const DocumentOutdoors about = outdoors_of_document(of.parts().document, *of.parts().weather);
  const ThermalMaterial road =
      *assemble_thermal(of.parts().document.sources, of.parts().document.scene.materials[0],
                        of.parts().scene.materials[0], 285.0);
  const thermal::OutdoorsSeries& series = about.outdoors.series;
  const double beside = kCar.free_sky(x, y);
  std::vector<double> sun(series.rows.size(), 1.0), sky(series.rows.size(), 1.0);
  for (std::size_t row = 0; row < series.rows.size(); ++row) {
    const double before_min = static_cast<double>(series.rows.size() - 1 - row) * series.step_s / 60.0;
    // A row at which it comes or goes is half of both.
    const double there = before_min < from_min && before_min > to_min     ? 1.0
                         : before_min == from_min || before_min == to_min ? 0.5
                                                                          : 0.0;
    if (kCar.is_in(x, y, studies::to_sun(series.rows[row]))) sun[row] = 1.0 - there;
    sky[row] = 1.0 - there * (1.0 - beside);
  }
  thermal::Stand stand;
  stand.terrain = about.terrain;
  return thermal::solve_surface(road.solid, road.skin, stand, series, road.start, sun, sky)
      .history.nodes.back()
      .surface_k;
}

geometry::SurfacePoint below(const scene::Scene& scene, double x, double y) {
  const math::Ray down{{x, y, 50.0}, {0.0, 0.0, -1.0}};
  geometry::SurfacePoint hit;
  scene.world->intersect({&down, 1}, {&hit, 1});
  return hit;
}

/// By what came and went alone: what stands about it counts as ground.
exposure::SolvedSurface road_alone(const Session& session) {
  return dynamic_cast<const exposure::SolvedSurface&>(*session.parts().scene.solved.at(0))
      .without_neighbours();
}

double mean_k(const scene::SolvedTemperature& of, const geometry::SurfacePoint& point, int draws) {
  double sum = 0.0;
  for (int k = 0; k < draws; ++k) sum += of.at(point, static_cast<std::uint64_t>(k)).kelvin / draws;
  return sum;
}

TEST(Presence, ACarThatLeftLeavesItsShadow) {
  const ClearDays weather("presence", 2.5);
  const Session minutes = load(weather, "", "1 min");
  double coldest = 1e9, warmest = 0.0;
  for (const auto& [left, left_min] : {std::pair{"14:50", 10.0}, {"14:30", 30.0}, {"13:00", 120.0}}) {
    const Session session =
        load(weather, format(R"(, "present": [["2026-06-21T06:10Z", "2026-06-21T{}Z"]])", left));
    const scene::Scene& scene = session.parts().scene;
    const exposure::SolvedSurface road = road_alone(session);
    // The same with nothing that ever stood there.
    const auto classes = std::shared_ptr<const thermal::SurfaceClasses>(&road.classes(), [](const auto*) {});
    const exposure::SolvedSurface never(classes, exposure::PastScene(*scene.world), 0.00465);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.3}, {-1.0, 1.3}}) {
      const geometry::SurfacePoint point = below(scene, x, y);
      ASSERT_NEAR(point.position_m.z, 0.0, 1e-9);  // the car is not in the picture
      const double expected_k = alone_k(minutes, x, y, 530.0, left_min);
      EXPECT_NEAR(mean_k(road, point, 8000), expected_k, 0.1) << left << " " << x << " " << y;
      EXPECT_GT(std::abs(mean_k(never, point, 50) - expected_k), 0.5) << left << " " << x << " " << y;
      coldest = std::min(coldest, expected_k);
      warmest = std::max(warmest, expected_k);
    }
  }
  EXPECT_GT(warmest - coldest, 5.0);
}

TEST(Presence, AVisitWithinTheLastStepHidesTheSky) {
  const ClearDays weather("presence", 2.5);
  const Session minutes = load(weather, "", "1 min");
  const Session session = load(weather, R"(, "present": [["2026-06-21T14:55:10Z", "2026-06-21T14:59:50Z"]])");
  const exposure::SolvedSurface road = road_alone(session);
  // Beside the car where it is in the Sun.
  for (const auto& [x, y] : {std::pair{0.0, -1.0}, {-2.3, 0.0}}) {
    const double visited_k = alone_k(minutes, x, y, 4.8, 0.2), never_k = alone_k(minutes, x, y, -1.0, -2.0);
    EXPECT_GT(visited_k - never_k, 0.25) << x << " " << y;
    EXPECT_NEAR(mean_k(road, below(session.parts().scene, x, y), 8000), visited_k, 0.13) << x << " " << y;
  }
}

TEST(Presence, ACarThatJustCameDidNotShadeBefore) {
  const ClearDays weather("presence", 2.5);
  const Session minutes = load(weather, "", "1 min");  // in which it always stood
  const Session session =
      load(weather, R"(, "present": [["2026-06-21T14:30Z", "2026-06-21T16:00:00+00:00"]])");
  for (const auto& [x, y] : {std::pair{0.5, 1.1}, {2.4, 0.5}}) {  // in its shadow of now
    const geometry::SurfacePoint point = below(session.parts().scene, x, y);
    const double expected_k = alone_k(minutes, x, y, 30.0, -1.0);
    EXPECT_NEAR(mean_k(road_alone(session), point, 8000), expected_k, 0.12) << x << " " << y;
    EXPECT_GT(std::abs(mean_k(*minutes.parts().scene.solved.at(0), point, 200) - expected_k), 0.5) << x;
  }
  // The car itself is in the picture.
  EXPECT_NEAR(below(session.parts().scene, 0.0, 0.0).position_m.z, kCar.top_m, 1e-9);
  EXPECT_EQ(session.parts().scene.departed, nullptr);
}

TEST(Presence, IntervalsOfErrorHoldWhereACarStood) {
  const ClearDays weather("presence", 2.5);
  const Session session = load(weather, R"(, "present": [["2026-06-21T06:10Z", "2026-06-21T14:30Z"]])");
  const scene::SolvedTemperature& road = *session.parts().scene.solved.at(0);
  // What single estimates say of themselves against how they scatter, under the car and where it shaded.
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {-0.5, 1.3}, {2.5, 0.0}}) {
    const geometry::SurfacePoint point = below(session.parts().scene, x, y);
    constexpr int kDraws = 4000;
    double sum = 0.0, squares = 0.0, variance = 0.0;
    for (std::uint64_t k = 0; k < kDraws; ++k) {
      const scene::EstimatedTemperature one = road.at(point, k);
      sum += one.kelvin / kDraws;
      squares += one.kelvin * one.kelvin / kDraws;
      variance += one.deviation_k * one.deviation_k / kDraws;
    }
    const double scatter = squares - sum * sum;
    EXPECT_GT(scatter, 0.01) << x;
    EXPECT_NEAR(variance / scatter, 1.0, 0.15) << x << " " << y;
  }
}

}  // namespace
}  // namespace ifov::session::test_presence
