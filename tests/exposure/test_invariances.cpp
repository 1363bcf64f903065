// What temperatures do not depend on: which way north lies, how large all is together; and what nothing may change that is all of one warmth.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/neighbours.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "session/solved/second_pass.h"

namespace ifov::session::test_invariances {
namespace {

constexpr double kPi = std::numbers::pi, kSunRadius_rad = 0.00465;

Session load(const DaysOfJune& weather, const char* time, const char* spin_up, const std::string& materials,
             const std::string& objects) {
  return Session::load(
      io::parse_document(format(
                             R"({{"ifov": 1, "time": "2026-06-21T{}:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "{}", "step": "20 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}}, "materials": {{{}}}, "objects": [{}]}},
          "light": {{"sky": {{"temperature": "255 K"}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [4, 4]}}}},
            "channels": [{{"name": "thermal", "monochromatic": {{"at": "10 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "50 K"}}}}}})",
                             time, weather.path(), spin_up, materials, objects),
                         "invariances.json"),
      nullptr);
}

const std::string kMaterials =
    R"("road": {"reflectance": {"library": "asphalt, road, weathered"}, "temperature": "solved"},
       "brick": {"reflectance": {"library": "brick, red"}, "temperature": "solved"})";

/// A road between an L of two walls, turned about the origin and scaled.
std::string corner(double turn_deg, double size, double walls = 1.0) {
  return format(R"({{"plane": {{}}, "material": "road"}},
      {{"box": {{"low": ["{0} m", "{1} m", "0 m"], "high": ["{2} m", "{3} m", "{4} m"]}}, "material": "brick", "transform": {{"rotate": {{"angle": "{5} deg"}}}}}},
      {{"box": {{"low": ["{6} m", "{1} m", "0 m"], "high": ["{0} m", "{3} m", "{4} m"]}}, "material": "brick", "transform": {{"rotate": {{"angle": "{5} deg"}}}}}})",
                -1.0 * size, 1.0 * size, 3.0 * size, 1.5 * size, 1.8 * size * walls, turn_deg, -1.4 * size);
}

/// The surfaces of a document of these materials under a sky whose north lies elsewhere.
struct Turned {
  Turned(const Session& session, double turn_rad, bool wind_too) : scene(session.parts().scene) {
    const Parts& parts = session.parts();
    const DocumentOutdoors about = outdoors_of_document(parts.document, *parts.weather);
    auto series = std::make_shared<thermal::OutdoorsSeries>(about.outdoors.series);
    for (thermal::Outdoors& row : series->rows) {
      row.wind_from_rad = 1.0;
      row.sun_azimuth_rad -= turn_rad;
      if (wind_too) row.wind_from_rad -= turn_rad;
    }
    thermal::Stand stand;
    stand.terrain = about.terrain;
    exposure::Neighbours::ByNumber classes(scene.solved.size());
    const exposure::PastScene past(*scene.world);
    for (const auto& [material, solved] : solved_materials(parts.document, scene, about.mean_air_k))
      classes[material] = std::make_shared<const thermal::SurfaceClasses>(
          series,
          thermal::ClassSurface{solved.thermal.solid, solved.thermal.skin, stand, solved.thermal.start}, 1,
          false, past.highest_m(), true);
    const auto neighbours =
        std::make_shared<const exposure::Neighbours>(scene::Scene(scene), classes, kSunRadius_rad);
    for (const auto& one : classes) surfaces.emplace_back(one, past, kSunRadius_rad, neighbours);
  }
  const scene::Scene& scene;
  std::vector<exposure::SolvedSurface> surfaces;
};

geometry::SurfacePoint met_by(const scene::Scene& scene, math::Point3 from, math::Vec3 along) {
  const math::Ray ray{.origin_m = from, .direction = along};
  geometry::SurfacePoint hit;
  scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit;
}

struct Mean {
  double kelvin = 0.0, error_k = 0.0;
};
Mean mean_of(const scene::SolvedTemperature& of, const geometry::SurfacePoint& point) {
  constexpr int kDraws = 4000;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t k = 0; k < kDraws; ++k) {
    const double off_k = of.at(point, k).kelvin - 300.0;
    sum += off_k / kDraws;
    squares += off_k * off_k / kDraws;
  }
  return {300.0 + sum, std::sqrt(std::max(0.0, squares - sum * sum) / kDraws)};
}

double in_errors(const Mean& a, const Mean& b) {
  return std::abs(a.kelvin - b.kelvin) / std::hypot(a.error_k, b.error_k);
}

struct Look {
  math::Point3 from;
  math::Vec3 along;
  std::size_t number;
};
/// On the road in the corner and before it, and on both walls.
std::vector<Look> looks(double turn_rad, double size) {
  const auto turned = [&](math::Vec3 v) {
    return math::Vec3{std::cos(turn_rad) * v.x - std::sin(turn_rad) * v.y,
                      std::sin(turn_rad) * v.x + std::cos(turn_rad) * v.y, v.z};
  };
  std::vector<Look> all;
  for (const auto& [from, along, number] :
       {std::tuple{math::Vec3{0.3, 0.6, 1.0}, math::Vec3{0.0, 0.0, -1.0}, std::size_t{0}},
        {math::Vec3{0.5, 2.2, 1.0}, math::Vec3{0.0, 0.0, -1.0}, std::size_t{0}},
        {math::Vec3{1.1, 0.2, 0.7}, math::Vec3{0.0, 1.0, 0.0}, std::size_t{1}},
        {math::Vec3{0.4, 2.9, 0.5}, math::Vec3{0.0, -1.0, 0.0}, std::size_t{1}}})
    all.push_back({math::Point3{} + size * turned(from), turned(along), number});
  return all;
}

// A quarter turn and one that the grid of directions knows, walls and Sun and wind together: the same temperatures. The planted fault turns all but the wind.
TEST(Invariances, ASceneTurnedWithItsSkyStaysAsWarm) {
  const ClearDays weather("turned", 2.5);
  const Session plain = load(weather, "15:00", "1 d", kMaterials, corner(0.0, 1.0));
  const Turned of_plain(plain, 0.0, true);
  for (const double turn_deg : {60.0, 90.0}) {
    const double turn_rad = turn_deg * kPi / 180.0;
    const Session other = load(weather, "15:00", "1 d", kMaterials, corner(turn_deg, 1.0));
    const Turned of_other(other, turn_rad, true), faulty(other, turn_rad, false);
    double off = 0.0;
    const std::vector<Look> here = looks(0.0, 1.0), there = looks(turn_rad, 1.0);
    for (std::size_t k = 0; k < here.size(); ++k) {
      const auto point = met_by(of_plain.scene, here[k].from, here[k].along);
      const auto turned = met_by(of_other.scene, there[k].from, there[k].along);
      ASSERT_TRUE(point.hit() && turned.hit()) << k;
      ASSERT_NEAR(point.distance_m, turned.distance_m, 1e-6);
      const Mean expected = mean_of(of_plain.surfaces[here[k].number], point);
      EXPECT_LT(in_errors(mean_of(of_other.surfaces[here[k].number], turned), expected), 4.0)
          << k << " " << turn_deg;
      off = std::max(off, in_errors(mean_of(faulty.surfaces[here[k].number], turned), expected));
    }
    EXPECT_GT(off, 6.0);
  }
}

// Below the height that the wind is measured from nothing has a size of its own. The planted fault leaves the walls' height as it was.
TEST(Invariances, ASceneOfAnotherSizeStaysAsWarm) {
  const ClearDays weather("scaled", 2.5);
  const Session plain = load(weather, "15:00", "1 d", kMaterials, corner(0.0, 1.0)),
                small = load(weather, "15:00", "1 d", kMaterials, corner(0.0, 0.1)),
                faulty = load(weather, "15:00", "1 d", kMaterials, corner(0.0, 0.1, 2.0));
  const std::vector<Look> here = looks(0.0, 1.0), there = looks(0.0, 0.1);
  double off = 0.0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    const auto mean = [&](const Session& session, const Look& look) {
      const scene::Scene& scene = session.parts().scene;
      const auto point = met_by(scene, look.from, look.along);
      EXPECT_TRUE(point.hit()) << k;
      return mean_of(*scene.solved.at(look.number), point);
    };
    const Mean expected = mean(plain, here[k]);
    EXPECT_LT(in_errors(mean(small, there[k]), expected), 4.0) << k;
    off = std::max(off, in_errors(mean(faulty, there[k]), expected));
  }
  EXPECT_GT(off, 6.0);
}

// Ten days in a closed room of air, walls, mirrors and metal that are all as warm: nothing drifts. The planted fault is a mirror that is not.
TEST(Invariances, NothingDriftsWhereAllIsAsWarm) {
  const StillDays weather("isothermal");
  const auto room = [&](const char* mirror_k) {
    return load(
        weather, "15:00", "10 d",
        format(
            R"("brick": {{"emissivity": 0.9, "temperature": "solved", "thermal": {{"layers": [{{"thickness": "20 cm", "library": "brick"}}], "solar_absorptance": 0.7}}}},
           "metal": {{"emissivity": 0.1, "temperature": "solved", "thermal": {{"layers": [{{"thickness": "1 mm", "library": "steel"}}], "solar_absorptance": 0.3}}}},
           "mirror": {{"reflectance": 0.95, "scattering": "mirror", "temperature": "{}"}})",
            mirror_k),
        R"({"box": {"low": ["-5 m", "-5 m", "0 m"], "high": ["5 m", "5 m", "10 m"]}, "material": "brick"},
           {"box": {"low": ["-4.5 m", "-4 m", "1 m"], "high": ["-4 m", "4 m", "6 m"]}, "material": "mirror"},
           {"sphere": {"center": ["2 m", "0 m", "3 m"], "radius": "1 m"}, "material": "metal"})");
  };
  const auto drift_k = [](const Session& session) {
    const scene::Scene& scene = session.parts().scene;
    double most_k = 0.0;
    for (const Look& look :
         {Look{{0.0, 0.5, 5.0}, {0.0, 0.0, 1.0}, 0}, Look{{0.0, 0.5, 5.0}, {0.0, 1.0, 0.0}, 0},
          Look{{-3.0, 0.0, 3.0}, {1.0, 0.0, 0.0}, 1}, Look{{2.0, 0.0, 0.5}, {0.0, 0.0, 1.0}, 1}}) {
      const auto point = met_by(scene, look.from, look.along);
      EXPECT_TRUE(point.hit());
      for (std::uint64_t draw = 0; draw < 200; ++draw)
        most_k = std::max(most_k, std::abs(scene.solved.at(look.number)->at(point, draw).kelvin - 290.0));
    }
    return most_k;
  };
  EXPECT_LT(drift_k(room("290 K")), 1e-4);
  EXPECT_GT(drift_k(room("291 K")), 1e-2);
}

}  // namespace
}  // namespace ifov::session::test_invariances
