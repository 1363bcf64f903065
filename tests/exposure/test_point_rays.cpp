// Few rays where little light is at stake: the same temperatures in the mean, and told by how much they scatter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "exposure/clear_days.h"
#include "exposure/point_rays.h"
#include "exposure/solved_surface.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_point_rays {
namespace {

constexpr int kDraws = 12000;

/// Planck's law at 4 um, where it bends most.
double light_of(double kelvin) { return 1e6 / (std::exp(3596.94 / kelvin) - 1.0); }

/// Of temperatures, and of their light: with what its bend is taken away, and what others stand in.
struct Spread {
  double mean_k = 0.0, variance_k2 = 0.0, told_k2 = 0.0;
  double light = 0.0, variance = 0.0, faulty = 0.0, faulty_variance = 0.0;
};

Spread spread_of(const exposure::SolvedSurface& surface, const geometry::SurfacePoint& point, double share) {
  const double else_k = surface.classes().middle_k(), else_light = light_of(else_k);
  Spread found;
  double sum = 0.0, squares = 0.0, light = 0.0, light_squares = 0.0, faulty = 0.0, faulty_squares = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const scene::EstimatedTemperature one = surface.at(point, draw, share);
    const auto of_estimate = [](double kelvin, double deviation_k) {
      return 2.0 * light_of(kelvin) - 0.5 * (light_of(kelvin - deviation_k) + light_of(kelvin + deviation_k));
    };
    const bool by_chance = one.times != 1.0;
    const double own_else_k = by_chance ? one.else_k : one.kelvin;
    const double moved_k = one.times * (one.kelvin - own_else_k), off_k = own_else_k + moved_k - else_k;
    sum += off_k / kDraws;
    squares += off_k * off_k / kDraws;
    found.told_k2 += one.deviation_k * one.deviation_k / kDraws;
    const double whole = of_estimate(one.kelvin, one.deviation_k),
                 other = by_chance ? of_estimate(one.else_k, one.else_deviation_k) : whole;
    const double off = other + one.times * (whole - other) - else_light;
    light += off / kDraws;
    light_squares += off * off / kDraws;
    // A fault: kelvins are moved by the inverse of the chance in place of light, and tell a variance that holds those which are not asked.
    const double moved_k2 =
        moved_k * moved_k * (one.times - 1.0) / one.times + one.times * one.deviation_k * one.deviation_k;
    const double moved = of_estimate(own_else_k + moved_k, std::sqrt(std::max(0.0, moved_k2))) - else_light;
    faulty += moved / kDraws;
    faulty_squares += moved * moved / kDraws;
  }
  found.mean_k = else_k + sum;
  found.variance_k2 = squares - sum * sum;
  found.light = else_light + light;
  found.variance = light_squares - light * light;
  found.faulty = else_light + faulty;
  found.faulty_variance = faulty_squares - faulty * faulty;
  return found;
}

double error_of(double variance, double other) { return std::sqrt((variance + other) / kDraws); }

/// What single rays tell of what is about a point, in the mean, times a sign: above and below its horizon.
std::pair<exposure::SolvedSurface::Warmth, exposure::SolvedSurface::Warmth> means_about(
    const exposure::SolvedSurface& surface, const geometry::SurfacePoint& point, double sign) {
  constexpr int kRays = 1000;
  std::pair<exposure::SolvedSurface::Warmth, exposure::SolvedSurface::Warmth> means;
  double above = 0.0, below = 0.0;
  const auto add = [&](auto& mean, double& count, const auto& one) {
    if (!one) return;
    count += 1.0;
    mean.in_shade_k += (sign * one->in_shade_k - mean.in_shade_k) / count;
    mean.of_sun_k += (sign * one->of_sun_k - mean.of_sun_k) / count;
  };
  for (int k = 0; k < kRays; ++k) {
    const auto asked = surface.asked_about(point, sampling::hash(k, 77));
    add(means.first, above, asked.above);
    add(means.second, below, asked.below);
  }
  return means;
}

// At a wall, in its shadow and under a sheet. The planted fault: kelvins that are asked for by chance are made up for, not their light.
TEST(PointRays, SmallSharesAreAsWarmInTheMeanAndTellTheirSpread) {
  const ClearDays weather("shares", 2.5);
  const Session session = Session::load(
      io::parse_document(format(
                             R"({{"ifov": 1, "time": "2026-06-21T15:00:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "20 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}}, "materials": {{
              "lawn": {{"reflectance": {{"library": "grass, lawn"}}, "temperature": "solved"}},
              "leaf": {{"reflectance": {{"library": "leaf, aspen"}}, "temperature": "solved"}}}},
            "objects": [{{"plane": {{}}, "material": "lawn"}},
              {{"box": {{"low": ["-1 m", "0 m", "0 m"], "high": ["1 m", "0.2 m", "1.5 m"]}}, "material": "leaf"}},
              {{"box": {{"low": ["-1 m", "1 m", "0.8 m"], "high": ["1 m", "2 m", "0.82 m"]}}, "material": "leaf"}}]}},
          "light": {{"sky": {{"temperature": "255 K"}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [4, 4]}}}},
            "channels": [{{"name": "thermal", "monochromatic": {{"at": "10 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "50 K"}}}}}})",
                             weather.path()),
                         "shares.json"),
      nullptr);
  const scene::Scene& scene = session.parts().scene;
  struct Place {
    math::Point3 from;
    math::Vec3 along;
    std::size_t number;
  };
  bool by_chance = false;
  double off = 0.0, spent_off = 0.0, least_spread = 1.0;
  for (const Place& place :
       {Place{{0.3, 0.6, 0.5}, {0.0, 0.0, -1.0}, 0}, Place{{0.2, 0.9, 0.6}, {0.0, -1.0, 0.0}, 1},
        Place{{0.1, 1.5, 0.4}, {0.0, 0.0, 1.0}, 1}, Place{{-0.4, 1.3, 0.5}, {0.0, 0.0, -1.0}, 0}}) {
    const math::Ray ray{.origin_m = place.from, .direction = place.along};
    geometry::SurfacePoint point;
    scene.world->intersect({&ray, 1}, {&point, 1});
    ASSERT_TRUE(point.hit());
    const auto& surface = dynamic_cast<const exposure::SolvedSurface&>(*scene.solved.at(place.number));
    const Spread whole = spread_of(surface, point, exposure::SolvedSurface::kItself),
                 little = spread_of(surface, point, 0.05);
    EXPECT_NEAR(little.mean_k, whole.mean_k, 4.0 * error_of(little.variance_k2, whole.variance_k2))
        << place.number;
    EXPECT_NEAR(little.light, whole.light, 4.0 * error_of(little.variance, whole.variance)) << place.number;
    EXPECT_GT(whole.told_k2, 0.85 * whole.variance_k2 - 1e-3) << place.number;
    EXPECT_LT(whole.told_k2, 1.25 * whole.variance_k2 + 1e-3) << place.number;
    // What is about a point asked by chance, and one pair of rays to the Sun: the same light, of whatever stands in.
    for (const double beside_k : {-2.0, 3.0}) {
      const Spread spent =
          spread_of(surface.spending({1, 0.15, {beside_k, 0.5 * beside_k}, {-beside_k, 0.0}}), point, 1.0);
      EXPECT_NEAR(spent.mean_k, whole.mean_k, 4.0 * error_of(spent.variance_k2, whole.variance_k2))
          << place.number << " " << beside_k;
      EXPECT_NEAR(spent.light, whole.light, 4.0 * error_of(spent.variance, whole.variance))
          << place.number << " " << beside_k;
      spent_off = std::max(
          spent_off, std::abs(spent.faulty - whole.light) / error_of(spent.faulty_variance, whole.variance));
    }
    // What is not asked scatters least where what rays that meet something tell in the mean stands in; turned about it scatters more.
    const auto spread_with = [&](double sign) {
      const auto [above, below] = means_about(surface, point, sign);
      return spread_of(surface.spending({1, 0.15, above, below}), point, 1.0).variance_k2;
    };
    const double none_k2 = spread_with(0.0);
    EXPECT_LT(spread_with(1.0), 1.02 * none_k2) << place.number;
    EXPECT_GT(spread_with(-1.0), 0.98 * none_k2) << place.number;
    least_spread = std::min(least_spread, spread_with(1.0) / none_k2);
    if (exposure::AskedByChance(surface.classes(), 0.05).chance() < 1.0) by_chance = true;
    off = std::max(off,
                   std::abs(little.faulty - whole.light) / error_of(little.faulty_variance, whole.variance));
  }
  EXPECT_TRUE(by_chance);
  EXPECT_LT(least_spread, 0.7);
  EXPECT_GT(off, 6.0);
  EXPECT_GT(spent_off, 6.0);
}

// Clumps of leaves that are turned every way differ within pixels by more than rays scatter, a level court between walls by less.
TEST(PointRays, ImagesSpendRaysWhereTheyAreWorthMoreThanPaths) {
  const ClearDays weather("spending", 2.5);
  std::string leaves;
  for (int k = 0; k < 100; ++k)
    leaves += format(
        R"(, {{"sphere": {{"center": ["{:.2f} m", "{:.2f} m", "{:.2f} m"], "radius": "0.2 m"}}, "material": "leaf"}})",
        0.4 * (k % 10) + 2.2, 0.4 * (k / 10) - 1.8, 1.0 + 0.1 * (k * 7 % 5));
  const Session session = Session::load(
      io::parse_document(format(
                             R"({{"ifov": 1, "time": "2026-06-21T15:00:00Z", "weather": {{"file": "{}"}},
          "temperatures": {{"spin_up": "1 d", "step": "20 min", "repeat_first_day": true}},
          "scene": {{"origin": {{"latitude": "52 deg", "longitude": "5 deg"}}, "materials": {{
              "lawn": {{"reflectance": {{"library": "grass, lawn"}}, "temperature": "solved"}},
              "wall": {{"reflectance": {{"library": "brick, red"}}, "temperature": "solved"}},
              "leaf": {{"reflectance": {{"library": "leaves, stacked"}}, "temperature": "solved"}}}},
            "objects": [{{"plane": {{}}, "material": "lawn"}},
              {{"box": {{"low": ["-6 m", "-6 m", "0 m"], "high": ["0 m", "-3 m", "4 m"]}}, "material": "wall"}},
              {{"box": {{"low": ["-6 m", "2 m", "0 m"], "high": ["0 m", "4 m", "4 m"]}}, "material": "wall"}}{}]}},
          "light": {{"sky": {{"temperature": "255 K"}}}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "0.5 m", "pixels": [24, 24]}}}},
            "channels": [{{"name": "thermal", "monochromatic": {{"at": "10 um"}}}}]}},
          "sampling": {{"accuracy": {{"error": "50 K"}}}}}})",
                             weather.path(), leaves),
                         "spending.json"),
      nullptr);
  const auto spent_on = [&](std::size_t material) {
    return dynamic_cast<const exposure::SolvedSurface&>(*session.parts().scene.solved.at(material)).spent();
  };
  EXPECT_LT(spent_on(2).chance_beside, 0.5);
  EXPECT_GT(spent_on(0).chance_beside, 1.5 * spent_on(2).chance_beside);
  EXPECT_GE(spent_on(0).sun_pairs, spent_on(2).sun_pairs);
}

}  // namespace
}  // namespace ifov::session::test_point_rays
