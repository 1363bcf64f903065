// Temperatures at several times from rays that the times share: against each time's own, and against exact sums.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/solved_surface.h"
#include "exposure/surfaces_of_times.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/shared_scene.h"

namespace ifov::session::test_surfaces_of_times {
namespace {

std::string text_of(const DaysOfJune& weather, const std::string& time) {
  return format(
      R"({{"ifov": 1, "time": "2026-06-21T{}:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "10 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}},
            "materials": {{"road": {{"reflectance": {{"library": "asphalt, road, weathered"}}, "temperature": "solved"}},
              "metal": {{"emissivity": 0.9, "temperature": "solved",
                "thermal": {{"layers": [{{"thickness": "1 mm", "library": "steel"}}], "solar_absorptance": 0.7}}}},
              "sheet": {{"emissivity": 0.9, "temperature": "solved",
                "thermal": {{"layers": [{{"thickness": "1 mm", "library": "steel"}}], "solar_absorptance": 0.7, "back": {{"other_side": {{}}}}}}}}}},
            "objects": [{{"plane": {{}}, "material": "road"}},
              {{"box": {{"low": ["-2 m", "-1 m", "0 m"], "high": ["2 m", "1 m", "4 m"]}}, "material": "road"}},
              {{"box": {{"low": ["-2 m", "3 m", "0.4 m"], "high": ["2 m", "5 m", "0.5 m"]}}, "material": "metal"}},
              {{"disk": {{"center": ["4 m", "1 m", "1.5 m"], "normal": [1, -0.2, 0.3], "radius": "0.5 m"}}, "material": "sheet"}}]}},
          "light": {{"sky": {{"none": {{}}}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "0.5 m", "pixels": [24, 16]}}}},
            "channels": [{{"name": "thermal", "top_hat": {{"from": "10 um", "to": "11 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "6 K"}}}}}})",
      time, weather.path());
}

/// One scene at several times.
struct Times {
  explicit Times(std::vector<std::string> clock) : weather("of_times", 2.5) {
    SharedScene shared;
    LoadOptions options;
    options.shared = &shared;
    for (const std::string& time : clock) {
      sessions.push_back(
          Session::load(io::parse_document(text_of(weather, time), "times.json"), nullptr, options));
    }
    for (const Session& session : sessions) scenes.push_back(&session.parts().scene);
  }
  const exposure::SolvedSurface& surface(std::size_t time, std::size_t number) const {
    return dynamic_cast<const exposure::SolvedSurface&>(*scenes[time]->solved.at(number));
  }
  geometry::SurfacePoint hit(math::Point3 from, math::Vec3 along) const {
    const math::Ray ray{from, along};
    geometry::SurfacePoint met;
    scenes[0]->world->intersect({&ray, 1}, {&met, 1});
    return met;
  }
  ClearDays weather;
  std::vector<Session> sessions;
  std::vector<const scene::Scene*> scenes;
};

std::vector<std::string> half_hours(int first, int count) {
  std::vector<std::string> clock;
  for (int k = 0; k < count; ++k) clock.push_back(format("{:02d}:{:02d}", first + k / 2, 30 * (k % 2)));
  return clock;
}

TEST(SurfacesOfTimes, MeansAreThoseOfExactSums) {
  const Times times(half_hours(13, 12));
  const auto shared = exposure::SurfacesOfTimes::of(times.scenes);
  ASSERT_NE(shared, nullptr);
  ASSERT_EQ(shared->times(), 12u);
  struct Place {
    const char* name;
    std::size_t number, first;
    math::Point3 from;
    math::Vec3 along;
  };
  const math::Vec3 down{0.0, 0.0, -1.0};
  constexpr int kDraws = 20000, kBesideDraws = 8000;
  double farthest_k = 0.0, misplaced_k = 0.0;
  for (const Place& place :
       {Place{"open", 0, 0, {-9.0, -7.0, 9.0}, down}, Place{"north", 0, 1, {0.0, 1.8, 9.0}, down},
        Place{"east", 0, 0, {2.6, 0.2, 9.0}, down}, Place{"roof", 0, 1, {0.3, 0.2, 9.0}, down},
        Place{"wall", 0, 0, {0.4, -9.0, 1.3}, {0.0, 1.0, 0.0}},
        Place{"west wall", 0, 1, {-9.0, 0.1, 1.3}, {1.0, 0.0, 0.0}},
        Place{"metal", 1, 0, {0.2, 3.6, 9.0}, down},
        Place{"sheet, away from the Sun", 2, 1, {9.0, 1.1, 1.5}, {-1.0, 0.0, 0.0}}}) {
    const geometry::SurfacePoint point = times.hit(place.from, place.along);
    ASSERT_TRUE(point.hit()) << place.name;
    std::vector<double> mean_k(12, 0.0), squares_k2(12, 0.0), told_k2(12, 0.0);
    std::vector<scene::EstimatedTemperature> one(12);
    for (int draw = 0; draw < kDraws; ++draw) {
      shared->at(place.number, point, static_cast<std::uint64_t>(draw), 1.0, one);
      for (std::size_t t = 0; t < 12; ++t) {
        mean_k[t] += one[t].kelvin / kDraws;
        squares_k2[t] += one[t].kelvin * one[t].kelvin / kDraws;
        told_k2[t] += one[t].deviation_k * one[t].deviation_k / kDraws;
      }
    }
    for (std::size_t t = place.first; t < 12; t += 2) {  // exact sums take as long as all else here
      const exposure::SolvedSurface& own = times.surface(t, place.number);
      const auto exposure = own.exposure(point, 5, 10000, 1000);
      const double exact_k =
          own.temperature_k(point, exposure) + own.beside_k(point, exposure, 9, kBesideDraws);
      const double spread_k2 = std::max(0.0, squares_k2[t] - mean_k[t] * mean_k[t]);
      // What is about points scatters by a kelvin at most.
      const double error_k = std::hypot(std::sqrt(spread_k2 / kDraws), 1.0 / std::sqrt(kBesideDraws));
      EXPECT_NEAR(mean_k[t], exact_k, 0.03 + 4.0 * error_k) << place.name << " " << t;
      farthest_k = std::max(farthest_k, std::abs(mean_k[t] - exact_k));
      // What is told of the spread is its mean square; what the second-order term scatters by is not in it, as of one time alone.
      EXPECT_GT(told_k2[t], 0.85 * spread_k2 - 1e-4) << place.name << " " << t;
      EXPECT_LT(told_k2[t], 1.5 * spread_k2 + 1e-3) << place.name << " " << t;
      const exposure::SolvedSurface& other = times.surface((t + 1) % 12, place.number);
      misplaced_k =
          std::max(misplaced_k, std::abs(other.temperature_k(point, other.exposure(point, 5, 64, 4)) +
                                         other.beside_k(point, exposure, 9, 500) - mean_k[t]));
    }
  }
  EXPECT_GT(misplaced_k, 10.0 * farthest_k);  // the planted fault: a time taken for the next one
}

}  // namespace
}  // namespace ifov::session::test_surfaces_of_times
