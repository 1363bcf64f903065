// Thin sheets that stand free: what comes to either face, and what is said of one whose other side is left out.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "session/solved/second_pass.h"
#include "thermal/surface_exchange.h"

namespace ifov::session::test_two_faces {
namespace {

constexpr double kSunRadius_rad = 0.00465;

/// A sign across the way to the Sun of eight in the morning, with what stands about it.
std::string text_of(const DaysOfJune& weather, const std::string& sign, const std::string& more = "",
                    const char* hour = "08:00") {
  return format(
      R"({{"ifov": 1, "time": "2026-06-21T{}:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "10 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}}, "materials": {{
             "road": {{"reflectance": {{"library": "asphalt, road, weathered"}}, "temperature": "solved"}},
             "hot": {{"emissivity": 1, "temperature": "310 K"}},
             "cold": {{"emissivity": 1, "temperature": "260 K"}},
             "sign": {{"temperature": "solved", {}}}}},
           "objects": [{{"plane": {{}}, "material": "road"}},
             {{"disk": {{"center": ["0 m", "0 m", "1.6 m"], "normal": [-1, 0, 0], "radius": "0.4 m"}}, "material": "sign", "name": "sign"}}{}]}},
          "light": {{"sky": {{"temperature": "255 K"}}}},
          "sensor": {{"camera": {{"frame": {{"position": ["-4 m", "0.5 m", "1.8 m"], "look_at": ["0 m", "0 m", "1.5 m"], "focal_length": "40 mm", "pitch": "500 um", "pixels": [24, 16]}}}},
            "channels": [{{"name": "thermal", "top_hat": {{"from": "10 um", "to": "11 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "20 K"}}}}}})",
      hour, weather.path(), sign, more);
}

constexpr const char* kSteel =
    R"("reflectance": 0.1, "thermal": {"layers": [{"thickness": "1 mm", "library": "steel"}], "roughness": "smooth"})";
constexpr const char* kSheet =
    R"("reflectance": 0.1, "thermal": {"layers": [{"thickness": "1 mm", "library": "steel"}], "roughness": "smooth", "back": {"other_side": {}}})";
constexpr std::uint32_t kSign = 3;

Session load(const std::string& text) {
  return Session::load(io::parse_document(text, "sign.json"), nullptr);
}

geometry::SurfacePoint seen_from(const Session& session, double x) {
  const math::Ray ray{{x, 0.05, 1.7}, {x > 0.0 ? -1.0 : 1.0, 0.0, 0.0}};
  geometry::SurfacePoint hit;
  session.parts().scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit;
}

const exposure::SolvedSurface& sign_of(const Session& session) {
  return dynamic_cast<const exposure::SolvedSurface&>(*session.parts().scene.solved.at(kSign));
}

double mean_k(const scene::SolvedTemperature& of, const geometry::SurfacePoint& point, int draws = 4000) {
  double sum = 0.0;
  for (int k = 0; k < draws; ++k) sum += of.at(point, static_cast<std::uint64_t>(k)).kelvin / draws;
  return sum;
}

/// In full, with what is about it asked by many rays, each of which meets what is solved in full.
double full_k(const Session& session, const geometry::SurfacePoint& point, bool beside) {
  const Parts& parts = session.parts();
  const DocumentOutdoors outdoors = outdoors_of_document(parts.document, *parts.weather);
  const ByMaterial by_material = solved_materials(parts.document, parts.scene, outdoors.mean_air_k);
  const SolvedMaterial& sign = by_material.at(kSign);
  thermal::Stand stand;
  stand.terrain = outdoors.terrain;
  const Neighbourhood about{parts.scene, sign.surface->scene(), by_material, outdoors.outdoors.series,
                            stand,       kSunRadius_rad};
  const auto exposure = sign.surface->exposure(point, 1, 512, 8);
  std::vector<thermal::FromBeside> comes;
  if (beside) comes = beside_of(about, point, exposure, 1, 128, 1, sign.classes->two_faces());
  return full_solution(sign, about.series, stand, sign.surface->normal_at(point), exposure, std::move(comes))
      .history.nodes.back()
      .surface_k;
}

// The Sun lights the one face, a camera on either side sees the same sheet; and it is that which one dimension in full has.
TEST(TwoFaces, OfASignAreAsWarmAndLitFromBehind) {
  const ClearDays weather("sign", 2.5);
  const Session session = load(text_of(weather, kSheet));
  const geometry::SurfacePoint lit = seen_from(session, 3.0), dark = seen_from(session, -3.0);
  ASSERT_TRUE(lit.hit() && dark.hit() && lit.front != dark.front);
  const exposure::SolvedSurface alone = sign_of(session).without_neighbours();
  EXPECT_NEAR(mean_k(alone, lit), full_k(session, lit, false), 0.05);
  EXPECT_NEAR(mean_k(alone, dark), full_k(session, lit, false), 0.05);
  EXPECT_NEAR(mean_k(sign_of(session), dark), full_k(session, dark, true), 0.25);
  EXPECT_NEAR(mean_k(sign_of(session), lit), mean_k(sign_of(session), dark), 0.1);
  EXPECT_LT(session.parts().temperature_errors->by_material.at(kSign).half_width_k(), 0.5);
  EXPECT_EQ(session.parts().temperature_errors->free_standing, 0);
}

// The same sheet, insulated behind as without a word it is: its faces differ by kelvins, and what it states holds what the sheet has.
TEST(TwoFaces, ThatAreLeftOutAreStated) {
  const ClearDays weather("sign", 2.5);
  const Session sheet = load(text_of(weather, kSheet)), session = load(text_of(weather, kSteel));
  const geometry::SurfacePoint lit = seen_from(session, 3.0), dark = seen_from(session, -3.0);
  const double right_k = full_k(sheet, lit, true);
  const double lit_k = mean_k(sign_of(session), lit), dark_k = mean_k(sign_of(session), dark);
  EXPECT_GT(lit_k - dark_k, 4.0);
  const TemperatureErrors& errors = *session.parts().temperature_errors;
  EXPECT_GT(errors.by_material.at(kSign).half_width_k(), std::abs(dark_k - right_k));
  EXPECT_GT(errors.free_standing, 0);
  EXPECT_NE(
      errors.statement().find("are of thin sheets whose other side is outdoors, which is left out: up to "),
      std::string::npos)
      << errors.statement();
  EXPECT_NE(errors.statement().find("of 'sign' (\"back\": {\"other_side\": {}} has it count)"),
            std::string::npos);
  EXPECT_LT(errors.by_material.at(0).half_width_k(), 1.0);  // the road
}

// A closed box of the same sheet has an inside: nothing is said.
TEST(TwoFaces, OfAClosedBoxAreNotOutdoors) {
  const ClearDays weather("sign", 2.5);
  const Session session = load(text_of(
      weather, kSteel,
      R"(, {"box": {"low": ["-1 m", "-1 m", "0.4 m"], "high": ["-0.6 m", "1 m", "2.6 m"]}, "material": "sign"})"));
  const TemperatureErrors& errors = *session.parts().temperature_errors;
  EXPECT_EQ(errors.free_standing, 0) << errors.statement();
}

// Three millimetres of plastic in the Sun, by explicit steps through eight slices with a balance on either face: by what a face is off the one
// temperature, that is stated.
TEST(TwoFaces, DifferByWhatIsStated) {
  const ClearDays weather("sign", 2.5);
  const Session session = load(text_of(
      weather,
      R"("reflectance": 0.1, "thermal": {"layers": [{"thickness": "3 mm", "library": "polyethylene"}], "roughness": "smooth", "back": {"other_side": {}}})"));
  const Parts& parts = session.parts();
  const DocumentOutdoors outdoors = outdoors_of_document(parts.document, *parts.weather);
  const ByMaterial by_material = solved_materials(parts.document, parts.scene, outdoors.mean_air_k);
  const SolvedMaterial& sign = by_material.at(kSign);
  const thermal::OutdoorsSeries& series = outdoors.outdoors.series;
  thermal::Stand stand;
  stand.terrain = outdoors.terrain;
  thermal::Skin one = sign.thermal.skin;
  one.two_faces = false;
  const exposure::SolvedSurface faces = sign.surface->exposed_on(false);
  const auto balance_on = [&](double x) {
    const geometry::SurfacePoint point = seen_from(session, x);
    return face_balance(sign, one, series, stand, faces.normal_at(point), faces.exposure(point, 1, 64, 1),
                        {});
  };
  const thermal::SurfaceBalance lit = balance_on(3.0), dark = balance_on(-3.0);
  constexpr int kSlices = 8;
  constexpr double kThick_m = 3e-3 / kSlices, kConducts = 0.50, kHolds = 980.0 * 1800.0, kStep_s = 0.2;
  const double end_s = sign.classes->end_s();
  std::vector<double> slices(kSlices, 295.0);
  double lit_k = 295.0, dark_k = 295.0;
  const double half = 2.0 * kConducts / kThick_m;
  for (double time_s = end_s - 7200.0; time_s < end_s; time_s += kStep_s) {
    lit_k = thermal::balanced_temperature_k(lit, time_s, half, slices.front(), lit_k);
    dark_k = thermal::balanced_temperature_k(dark, time_s, half, slices.back(), dark_k);
    std::vector<double> next = slices;
    for (int k = 0; k < kSlices; ++k) {
      const auto i = static_cast<std::size_t>(k);
      double in = 0.0;
      in += k > 0 ? 0.5 * half * (slices[i - 1] - slices[i]) : half * (lit_k - slices[i]);
      in += k + 1 < kSlices ? 0.5 * half * (slices[i + 1] - slices[i]) : half * (dark_k - slices[i]);
      next[i] += kStep_s * in / (kThick_m * kHolds);
    }
    slices = next;
  }
  const double both_k = full_k(session, seen_from(session, 3.0), false);
  const double off_k = std::max(std::abs(lit_k - both_k), std::abs(dark_k - both_k));
  const double stated_k = session.parts().temperature_errors->by_material.at(kSign).other_side_k;
  EXPECT_GT(off_k, 0.3);
  EXPECT_NEAR(stated_k, off_k, 0.25 * off_k);
  EXPECT_NEAR(0.5 * (lit_k + dark_k), both_k, 0.25 * off_k);
  const std::string statement = session.parts().temperature_errors->statement();
  EXPECT_NE(statement.find("K off the temperature that both are taken to have"), std::string::npos)
      << statement;
}

// By night between a hot wall and a cold one, which fill most of what each face sees. Where they are hotter the second order is not enough, and
// what is stated holds it.
TEST(TwoFaces, AreWarmedByWhatStandsOnEitherSide) {
  const StillDays weather("sign");
  const std::string walls =
      R"(, {"box": {"low": ["0.3 m", "-3 m", "0 m"], "high": ["0.5 m", "3 m", "4 m"]}, "material": "hot"},
           {"box": {"low": ["-6 m", "-3 m", "0 m"], "high": ["-5.5 m", "3 m", "4 m"]}, "material": "cold"})";
  for (const bool hotter : {false, true}) {
    std::string text = text_of(weather, kSheet, walls, "02:00");
    if (hotter) text.replace(text.find("310 K"), 5, "340 K");
    const Session session = load(text);
    const geometry::SurfacePoint from_cold = seen_from(session, -3.0), from_hot = seen_from(session, 0.2);
    ASSERT_TRUE(from_cold.hit() && from_hot.hit() && from_cold.front != from_hot.front);
    const double expected_k = full_k(session, from_cold, true);
    EXPECT_GT(expected_k - full_k(session, from_cold, false), hotter ? 10.0 : 4.0);
    const double found_k = mean_k(sign_of(session), from_cold, 16000);
    EXPECT_NEAR(found_k, expected_k, hotter ? 2.5 : 0.3);
    EXPECT_NEAR(mean_k(sign_of(session), from_hot, 16000), found_k, 0.3);
    EXPECT_GT(session.parts().temperature_errors->by_material.at(kSign).half_width_k(),
              std::abs(found_k - expected_k));
  }
}

// A wall that is told to be as warm all the time by a table warms as one of that temperature does; one that was cold until a minute ago does not.
TEST(HeldTemperatures, WarmWhatStandsBesideThemByTheirPast) {
  const StillDays weather("sign");
  const std::string wall =
      R"(, {"box": {"low": ["0.3 m", "-3 m", "0 m"], "high": ["0.5 m", "3 m", "4 m"]}, "material": "hot"})";
  const std::string given = text_of(weather, kSheet, wall, "02:00"),
                    hot = R"({"emissivity": 1, "temperature": "310 K"})";
  const auto sign_k = [&](const std::string& table) {
    std::string text = given;
    if (!table.empty())
      text.replace(text.find(hot), hot.size(),
                   R"({"emissivity": 1, "temperature": "solved", "thermal": {"table": [)" + table + "]}}");
    const Session session = load(text);
    return mean_k(sign_of(session), seen_from(session, -3.0), 8000);
  };
  const double given_k = sign_k("");
  EXPECT_NEAR(sign_k(R"({"time": "2026-06-21T00:00Z", "temperature": "310 K"})"), given_k, 0.15);
  EXPECT_LT(
      sign_k(
          R"({"time": "2026-06-21T01:59Z", "temperature": "280 K"}, {"time": "2026-06-21T02:00Z", "temperature": "310 K"})"),
      given_k - 2.0);
}

TEST(TwoFaces, OfLeavesThatLetLightThrough) {
  const ClearDays weather("sign", 2.5);
  const std::string leaf =
      R"("reflectance": {"library": "leaf, aspen"}, "transmittance": {"library": "leaf, aspen"})";
  const std::string below =
      R"(, {"disk": {"center": ["0 m", "0 m", "1 m"], "normal": [0.3, 0, 1], "radius": "0.4 m"}, "material": "sign"})";
  const Session session = load(text_of(weather, leaf, below, "12:00"));
  for (const double x : {3.0, -3.0}) {
    const geometry::SurfacePoint point = seen_from(session, x);
    const double found_k = mean_k(sign_of(session), point);
    EXPECT_NEAR(found_k, full_k(session, point, true), 0.15);
    EXPECT_NEAR(found_k, 273.15 + 18.0 + 3.5, 3.0);  // near the air
  }
  EXPECT_LT(session.parts().temperature_errors->by_material.at(kSign).half_width_k(), 0.6);
}

std::string message_of(const std::string& text) {
  try {
    load(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TwoFaces, OfDifferentMaterialsOrThickOnesAreErrors) {
  const ClearDays weather("sign", 2.5);
  const std::string thick = message_of(text_of(
      weather,
      R"("reflectance": 0.1, "thermal": {"layers": [{"thickness": "2 cm", "library": "softwood"}], "back": {"other_side": {}}})"));
  EXPECT_NE(
      thick.find("the two faces of a sheet are taken to have one temperature, and this one's layers have a "
                 "resistance of 0.154 m2 K W-1, expected at most 0.01"),
      std::string::npos)
      << thick;
  EXPECT_NE(thick.find("sign.json:7:79:"), std::string::npos) << thick;
  std::string text = text_of(weather, kSheet);
  const std::string disk = R"("material": "sign", "name")";
  text.replace(text.find(disk), disk.size(), R"("material": "both", "name")");
  const std::string cold = R"("cold": {)";
  text.replace(text.find(cold), cold.size(), R"("both": {"front": "sign", "back": "road"}, "cold": {)");
  const std::string both = message_of(text);
  EXPECT_NE(
      both.find(
          "a sheet whose faces are both outdoors has the same material on either, and its sides are 'sign' and "
          "'road': give one of them, or both a \"back\" other than \"other_side\""),
      std::string::npos)
      << both;
}

}  // namespace
}  // namespace ifov::session::test_two_faces
