#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geodesy/moon_position.h"
#include "geodesy/sun_position.h"

namespace ifov::geodesy::test_moon_position {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kPolarRadius_m = 6356752.314;

// Meeus, Astronomical Algorithms, examples 47.a and 48.a: 1992 April 12, 0 h TD, from the Earth's centre:
// apparent right ascension 134.688470, declination 13.768368 degrees, 368,409.7 km, phase angle 69.0756
// degrees, illuminated 0.6786. The centre is the place a polar radius below the pole, where elevation is
// declination.
TEST(MoonPosition, MeeusExample) {
  const MoonPosition moon =
      moon_position(parse_utc("1992-04-11T23:59:00.816Z"), {90.0 * kDegree, 0.0, -kPolarRadius_m});
  EXPECT_NEAR(moon.elevation_rad / kDegree, 13.768368, 10.0 / 3600.0);
  EXPECT_NEAR(moon.distance_m / 1e3, 368409.7, 1.0);
  EXPECT_NEAR(moon.phase_angle_rad / kDegree, 69.0756, 0.003);
  EXPECT_NEAR(moon.illuminated_fraction, 0.6786, 1e-4);
  // Right ascension by way of the Sun, which is placed by a theory of its own: 20.6579 degrees (Meeus'
  // apparent Sun of example 48.a).
  const SunPosition sun =
      sun_position(parse_utc("1992-04-11T23:59:00.816Z"), {90.0 * kDegree, 0.0, -kPolarRadius_m});
  const double difference = std::remainder((sun.azimuth_rad - moon.azimuth_rad) / kDegree, 360.0);
  EXPECT_NEAR(difference, 134.688470 - 20.6579, 0.005);
}

// The Moon stands a degree lower at the horizon than seen from the Earth's centre: its horizontal parallax.
TEST(MoonPosition, ParallaxIsTopocentric) {
  const UtcTime time = parse_utc("1992-04-11T23:59:00.816Z");
  double lowest = 90.0, drop = 0.0;
  for (double longitude = -180.0; longitude < 180.0; longitude += 0.5) {
    const MoonPosition here = moon_position(time, {0.0, longitude * kDegree});
    if (std::abs(here.elevation_rad / kDegree) < lowest) {
      lowest = std::abs(here.elevation_rad / kDegree);
      const MoonPosition centre = moon_position(time, {0.0, longitude * kDegree, -6378137.0});
      drop = (centre.elevation_rad - here.elevation_rad) / kDegree;
    }
  }
  EXPECT_NEAR(drop, std::asin(6378.137 / 368409.7) / kDegree, 0.001);
}

// Eclipses say where the Moon is: 1999-08-11 11:03 UTC total near Bucharest, 2017-08-21 18:25 near
// Hopkinsville (Kentucky), 2024-04-08 18:17 in Mexico: the centres are within the difference of radii and a
// little.
TEST(MoonPosition, CoversTheSunInEclipses) {
  const struct {
    const char* time;
    double latitude, longitude;
  } cases[] = {{"1999-08-11T11:03:00Z", 45.1, 24.3},
               {"2017-08-21T18:25:30Z", 36.97, -87.67},
               {"2024-04-08T18:17:20Z", 25.29, -104.14}};
  for (const auto& c : cases) {
    const UtcTime time = parse_utc(c.time);
    const MoonPosition moon = moon_position(time, {c.latitude * kDegree, c.longitude * kDegree});
    const SunPosition sun = sun_position(time, {c.latitude * kDegree, c.longitude * kDegree});
    EXPECT_LT(std::acos(dot(moon.direction_enu, sun.direction_enu)) / kDegree, 0.02) << c.time;
    EXPECT_NEAR(moon.illuminated_fraction, 0.0, 1e-4);
    const double moon_radius = std::asin(1737.4e3 / moon.distance_m) / kDegree;
    EXPECT_GT(moon_radius, 0.2666 / sun.distance_au) << c.time;
  }
}

TEST(MoonPosition, LightByPhase) {
  MoonPosition moon;
  moon.distance_m = 384.4e6;
  // Full: 400,000 times less than the Sun.
  EXPECT_NEAR(moonlight_ratio(moon), std::pow(10.0, -0.4 * 14.01), 1e-12);
  EXPECT_NEAR(1.0 / moonlight_ratio(moon), 4.018e5, 0.001e5);
  const double full = moonlight_ratio(moon);
  moon.phase_angle_rad = 90.0 * kDegree;  // V = -12.73 + 2.34 + 0.262: a twelfth of full
  EXPECT_NEAR(moonlight_ratio(moon) / full, std::pow(10.0, -0.4 * (2.34 + 0.26244)), 1e-12);
  moon.phase_angle_rad = 0.0;
  moon.distance_m *= 2.0;
  moon.sun_distance_au = 2.0;
  EXPECT_NEAR(moonlight_ratio(moon), full / 16.0, 1e-15);
}

TEST(MoonPosition, RefusesImpossiblePlaces) {
  EXPECT_THROW(moon_position(parse_utc("2021-03-05T15:07:09Z"), {91.0 * kDegree, 0.0}), InputError);
}

}  // namespace
}  // namespace ifov::geodesy::test_moon_position
