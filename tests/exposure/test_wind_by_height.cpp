// The wind of a surface is that of its height above ground: heights by hand, and a roof against one dimension solved alone in a
// wind that the logarithmic law has raised here.
#include <gtest/gtest.h>

#include <cmath>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/ground_beside.h"
#include "exposure/past_scene.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "thermal/surface_solution.h"

namespace ifov::session::test_wind_by_height {
namespace {

Session load(const ClearDays& day, const std::string& objects, const char* terrain = "open",
             const char* error = "2 K", const char* of_scene = "") {
  return Session::load(
      io::parse_document(format(R"({{"ifov": 1, "time": "2026-06-21T14:00:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "10 min", "repeat_first_day": true, "terrain": "{}"}},
          "scene": {{{}"origin": {{"latitude": "52 deg", "longitude": "5 deg"}},
            "materials": {{"tar": {{"emissivity": 1, "temperature": "solved",
                "thermal": {{"layers": [{{"thickness": "3 cm", "library": "asphalt"}}, {{"thickness": "20 cm", "library": "concrete"}}],
                            "solar_absorptance": 0.9}}}},
              "paint": {{"emissivity": 0.9, "temperature": "300 K"}}}},
            "objects": [{}]}},
          "light": {{"sky": {{"none": {{}}}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "2 m", "pixels": [12, 12]}}}},
            "channels": [{{"name": "thermal", "top_hat": {{"from": "10 um", "to": "11 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "{}"}}}}}})",
                                day.path(), terrain, of_scene, objects, error),
                         "windy.json"),
      nullptr);
}

std::string box(double low_x, double low_y, double low_z, double high_x, double high_y, double high_z,
                const char* material = "tar") {
  return format(
      R"({{"box": {{"low": ["{} m", "{} m", "{} m"], "high": ["{} m", "{} m", "{} m"]}}, "material": "{}"}})",
      low_x, low_y, low_z, high_x, high_y, high_z, material);
}
const std::string kGround = R"({"plane": {}, "material": "tar"})";

double height_m(const Session& session, double x, double y, double z) {
  return exposure::PastScene(*session.parts().scene.world).height_above_ground_m({x, y, z}, 2.0);
}

TEST(WindByHeight, CountsFromTheGroundBelow) {
  const ClearDays day("windy", 3.0);
  // A tower that stands on the plane, one with a foundation, a deck on nothing with a hut on it.
  const Session session =
      load(day, kGround + ", " + box(-4, -4, 0, 4, 4, 20) + ", " + box(10, -4, -3, 18, 4, 12) + ", " +
                    box(-20, -4, 6, -10, 4, 7) + ", " + box(-18, -2, 7, -14, 2, 11));
  EXPECT_NEAR(height_m(session, 0, 0, 20), 20.0, 1e-6);  // roof
  EXPECT_NEAR(height_m(session, 4.0, 0, 9), 9.0, 1e-6);  // on a wall, and before it
  EXPECT_NEAR(height_m(session, 4.001, 0, 9), 9.0, 1e-6);
  EXPECT_NEAR(height_m(session, 14, 0, 12), 12.0, 1e-6);  // not from the bottom of its foundation
  EXPECT_NEAR(height_m(session, -12, 0, 7), 7.0, 1e-6);   // upon the deck, and below it
  EXPECT_NEAR(height_m(session, -12, 0, 6), 6.0, 1e-6);
  EXPECT_NEAR(height_m(session, -16, 0, 11), 11.0, 1e-6);  // the hut: above ground, not above the deck
  EXPECT_EQ(height_m(session, 7, 0, 0.0), 0.0);
  EXPECT_EQ(height_m(session, 4.0, 0, 1.9), 0.0);  // as low as the lowest wind
  EXPECT_EQ(height_m(session, 7, 0, 0.5), 0.0);
}

TEST(WindByHeight, GroundMayBeABlock) {
  const ClearDays day("windy", 3.0);
  // A deep block for ground, whose bottom is not: a house on it, and the block itself.
  const Session block = load(day, box(-50, -50, -30, 50, 50, 5, "paint") + ", " + box(-4, -4, 5, 4, 4, 14));
  EXPECT_NEAR(height_m(block, 0, 0, 14), 9.0, 1e-6);
  EXPECT_EQ(height_m(block, 20, 0, 5), 0.0);
  // Nothing faces up below the roof of a house that stands on nothing: it counts as ground.
  EXPECT_EQ(height_m(load(day, box(-4, -4, 0, 4, 4, 9)), 0, 0, 9), 0.0);
}

TEST(WindByHeight, UnderCrownsAndInCells) {
  const ClearDays day("windy", 3.0);
  // A crown over the ground, and a house that stands below its edge: both count from the ground, and the crown as far as its top.
  const Session crown = load(
      day, kGround +
               R"(, {"sphere": {"center": ["0 m", "0 m", "10 m"], "radius": "4 m"}, "material": "tar"}, )" +
               box(2, -2, 0, 8, 2, 5));
  EXPECT_NEAR(height_m(crown, 0, 0, 14), 14.0, 1e-6);
  EXPECT_NEAR(height_m(crown, 0, 0, 6), 6.0, 1e-6);
  EXPECT_NEAR(height_m(crown, 3, 0, 5), 5.0, 1e-6);
  // Cells: the ground of one that repeats is below all of them.
  const Session cell = load(day, box(-10, -10, -1, 10, 10, 0, "paint") + ", " + box(-3, -3, 0, 3, 3, 8),
                            "open", "2 K", R"("periodic": {"size": ["20 m", "20 m"]}, )");
  EXPECT_NEAR(height_m(cell, 0, 0, 8), 8.0, 1e-6);
  EXPECT_NEAR(height_m(cell, 40, -20, 8), 8.0, 1e-6);
  EXPECT_EQ(height_m(cell, 9, 9, 0), 0.0);
}

geometry::SurfacePoint from_above(const Session& session, double x, double y) {
  const math::Ray down{{x, y, 100.0}, {0.0, 0.0, -1.0}};
  geometry::SurfacePoint hit;
  session.parts().scene.world->intersect({&down, 1}, {&hit, 1});
  return hit;
}

/// One dimension, level and in the open, in the weather's wind times a factor.
double alone_k(const Session& of, double wind_factor) {
  const DocumentOutdoors about = outdoors_of_document(of.parts().document, *of.parts().weather);
  const ThermalMaterial tar =
      *assemble_thermal(of.parts().document.sources, of.parts().document.scene.materials[0],
                        of.parts().scene.materials[0], 285.0);
  thermal::OutdoorsSeries series = about.outdoors.series;
  for (thermal::Outdoors& now : series.rows) now.wind_m_s *= wind_factor;
  series.anemometer = {
      10.0, thermal::Terrain::open};  // of the document, where 10 m of open terrain is the factor 1
  thermal::Stand stand;
  stand.height_m = 10.0;
  return thermal::solve_surface(tar.solid, tar.skin, stand, series, tar.start).history.nodes.back().surface_k;
}

TEST(WindByHeight, ARoofConvectsMoreThanTheStreet) {
  const ClearDays day("windy", 3.0);
  for (const char* terrain : {"open", "suburb"}) {
    const double z0 = std::string(terrain) == "open" ? 0.03 : 1.0;
    // Of the wind at 10 m over open terrain, by way of the one at 60 m.
    const auto factor = [&](double z) {
      return std::log(60.0 / 0.03) / std::log(10.0 / 0.03) * std::log(z / z0) / std::log(60.0 / z0);
    };
    for (const double roof_m : {20.0, 7.0}) {
      const Session session = load(day, kGround + ", " + box(-6, -6, 0, 6, 6, roof_m), terrain);
      const scene::SolvedTemperature& tar = *session.parts().scene.solved.at(0);
      const double roof_k = tar.at(from_above(session, 0.0, 0.0), 1).kelvin,
                   street_k = tar.at(from_above(session, 9000.0, -9000.0), 1).kelvin;
      EXPECT_NEAR(roof_k, alone_k(session, factor(roof_m)), 0.05) << terrain << roof_m;
      EXPECT_NEAR(street_k, alone_k(session, factor(2.0)), 0.05) << terrain << roof_m;
      EXPECT_GT(alone_k(session, factor(2.0)) - roof_k, 0.5)
          << terrain << roof_m;  // as if it were the street
    }
  }
}

/// Ground of four slabs about a hole of 12 x 12 m.
std::string ground_with_a_hole() {
  return box(-90, -90, -1, -6, 90, 0, "paint") + ", " + box(6, -90, -1, 90, 90, 0, "paint") + ", " +
         box(-6, -90, -1, 6, -6, 0, "paint") + ", " + box(-6, 6, -1, 6, 90, 0, "paint");
}

double height_beside_m(const Session& session, double x, double y, double z) {
  return exposure::height_above_ground_beside_m(exposure::PastScene(*session.parts().scene.world), {x, y, z},
                                                2.0);
}

/// A house in a hole of the terrain stands on nothing: its roof counts as ground, and half-widths hold what it is off by for that.
TEST(WindByHeight, HalfWidthsHoldARoofOverAHole) {
  const ClearDays day("windy", 3.0);
  constexpr double kRoof_m = 20.0;
  const std::string house = box(-6, -6, -1, 6, 6, kRoof_m);
  const Session over_hole = load(day, ground_with_a_hole() + ", " + house, "open", "30 K"),
                over_ground = load(day, kGround + ", " + house, "open", "30 K");
  const auto factor = [](double z) { return std::log(z / 0.03) / std::log(10.0 / 0.03); };
  const auto off_k = [&](const Session& session) {
    const double found_k = session.parts().scene.solved.at(0)->at(from_above(session, 0.0, 0.0), 1).kelvin;
    return std::abs(found_k - alone_k(session, factor(kRoof_m)));
  };
  const TemperatureErrors &wide = *over_hole.parts().temperature_errors,
                          &narrow = *over_ground.parts().temperature_errors;
  EXPECT_GT(off_k(over_hole), 1.0);
  EXPECT_LE(off_k(over_hole), wide.half_width_k());
  EXPECT_NEAR(wide.ground_k, off_k(over_hole), 0.1);
  EXPECT_GT(wide.on_nothing, 0);
  EXPECT_NE(wide.statement().find("nothing faces up"), std::string::npos);
  // A fault: what is stated where the house has ground below it would not do.
  EXPECT_LE(off_k(over_ground), narrow.half_width_k());
  EXPECT_GT(off_k(over_hole), 2.0 * narrow.half_width_k());
  EXPECT_EQ(narrow.ground_k, 0.0);
  EXPECT_NE(narrow.statement().find("wind of 0 to 20 m above ground"), std::string::npos)
      << narrow.statement();
  EXPECT_EQ(narrow.statement().find("nothing faces up"), std::string::npos);
}

TEST(WindByHeight, GroundBesideIsAtTheFootOfADrop) {
  const ClearDays day("windy", 3.0);
  const Session hole = load(day, ground_with_a_hole() + ", " + box(-6, -6, -1, 6, 6, 9), "open", "30 K");
  EXPECT_NEAR(height_beside_m(hole, 0, 0, 9), 9.0, 1e-6);
  EXPECT_NEAR(height_beside_m(hole, 5, -5, 9), 9.0, 1e-6);
  EXPECT_EQ(height_beside_m(hole, 20, 0, 0), 0.0);  // ground, whose hole is filled
  // A quay: to one side alone; ground that is a block, by itself and with a house; a house on nothing.
  const Session quay =
      load(day, box(-90, -90, -9, 0, 90, 5) + ", " + box(0, -90, -9, 90, 90, 0, "paint"), "open", "30 K");
  EXPECT_EQ(height_beside_m(quay, -5, 0, 5), 0.0);
  const Session block =
      load(day, box(-90, -90, -30, 90, 90, 5, "paint") + ", " + box(-4, -4, 5, 4, 4, 14), "open", "30 K");
  EXPECT_EQ(height_beside_m(block, 20, 0, 5), 0.0);
  EXPECT_EQ(height_beside_m(load(day, box(-4, -4, 0, 4, 4, 9), "open", "30 K"), 0, 0, 9), 0.0);
}

/// Nothing jumps where the wind begins to count by height.
TEST(WindByHeight, TwoMetresAreASeam) {
  const ClearDays day("windy", 3.0);
  const auto roof_k = [&](double top_m) {
    const Session session = load(day, kGround + ", " + box(-6, -6, 0, 6, 6, top_m));
    return session.parts().scene.solved.at(0)->at(from_above(session, 0.0, 0.0), 1).kelvin;
  };
  const double at_k = roof_k(2.0);
  EXPECT_NEAR(roof_k(1.999), at_k, 0.01);
  EXPECT_NEAR(roof_k(2.001), at_k, 0.01);
  EXPECT_GT(at_k - roof_k(3.0), 0.2);
}

}  // namespace
}  // namespace ifov::session::test_wind_by_height
