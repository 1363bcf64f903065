#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/phase/propagation.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "atmosphere/survey/neutral_points.h"
#include "atmosphere/survey/sky_view.h"
#include "atmosphere/survey/survey_effects.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere::test_survey {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

AtmosphereColumn column(const std::string& aerosol) {
  AtmosphereDescription description;
  description.aerosol.type = aerosol;
  return AtmosphereColumn(description);
}

SensorGeometry sun_at(double zenith_deg) {
  SensorGeometry geometry;
  geometry.sun_zenith_rad = zenith_deg * kDegree;
  return geometry;
}

/// Irradiance of level ground from the sky's radiances: the trapezoidal rule over both angles.
double irradiance(const SkyView& sky) {
  double sum = 0.0;
  for (std::size_t z = 0; z + 1 < sky.zenith_rad.size(); ++z)
    for (std::size_t a = 0; a + 1 < sky.azimuth_rad.size(); ++a)
      for (const std::size_t dz : {0, 1})
        for (const std::size_t da : {0, 1}) {
          const double zenith = sky.zenith_rad[z + dz];
          sum += 0.5 * sky.at(z + dz, a + da).i * std::sin(zenith) * std::cos(zenith) *
                 (sky.zenith_rad[z + 1] - sky.zenith_rad[z]) * (sky.azimuth_rad[a + 1] - sky.azimuth_rad[a]);
        }
  return sum;  // both sides of the Sun's plane: twice a quarter
}

TEST(AtmosphereSurvey, TheSkyInThePictureGivesTheIrradianceInTheTable) {
  const AtmosphereColumn air = column("none");
  const std::vector<radiometry::Channel> channels{radiometry::Channel::top_hat("blue", 0.4495, 0.4505)};
  const auto& sunlight = radiometry::solar_irradiance_1au();
  const AtmosphereEffects light = survey_effects(air, channels, sunlight, sun_at(50.0)).front();
  const SkyView sky = view_sky(air, 0.45, light.solar_irradiance, 50.0 * kDegree);
  EXPECT_NEAR(irradiance(sky) / light.solar_sky, 1.0, 0.01);
}

TEST(AtmosphereSurvey, TheThermalSkyInThePictureGivesTheIrradianceInTheTable) {
  const AtmosphereColumn air = column("rural");
  const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("thermal", 1e4 / 900.0)};
  const AtmosphereEffects light = survey_effects(air, channels, radiometry::Spectrum(), {}).front();
  const SkyView sky = view_sky(air, 1e4 / 900.0, 0.0, std::nullopt);
  EXPECT_NEAR(irradiance(sky) / light.thermal_sky, 1.0, 0.01);
  EXPECT_EQ(light.solar_path, 0.0);
}

TEST(AtmosphereSurvey, SunlightSplitsFromEmission) {
  const AtmosphereColumn air = column("rural");
  const std::vector<radiometry::Channel> channels{radiometry::Channel::top_hat("mid-wave", 3.8, 4.0)};
  const auto& sunlight = radiometry::solar_irradiance_1au();
  const AtmosphereEffects day = survey_effects(air, channels, sunlight, sun_at(30.0)).front();
  const AtmosphereEffects night = survey_effects(air, channels, radiometry::Spectrum(), {}).front();
  EXPECT_NEAR(day.thermal_path / night.thermal_path, 1.0, 1e-6);
  EXPECT_GT(day.solar_path, 0.0);
  EXPECT_NEAR(day.view_transmittance, night.view_transmittance, 1e-12);
}

// Light finds the same ways up as down: where the sensor stands in the direction of the Sun, the share of its light
// that reaches level black ground is the share of the light of bright ground that reaches the sensor.
TEST(AtmosphereSurvey, LightGoesUpAsItComesDown) {
  SensorGeometry geometry = sun_at(40.0);
  geometry.view_zenith_rad = 40.0 * kDegree;
  const std::vector<radiometry::Channel> channels{radiometry::Channel::top_hat("green", 0.5495, 0.5505)};
  const AtmosphereEffects light =
      survey_effects(column("rural"), channels, radiometry::solar_irradiance_1au(), geometry).front();
  const double down =
      (light.direct_irradiance + light.solar_sky) / (std::cos(40.0 * kDegree) * light.solar_irradiance);
  EXPECT_NEAR((light.view_transmittance + light.diffuse_transmittance) / down, 1.0, 0.01);
  EXPECT_GT(light.diffuse_transmittance, 0.1);
}

// Clear air above dark ground: skylight is most polarized 90 degrees from the Sun, across the Sun's plane,
// and not at all near the Sun and on both sides of it (the points of Babinet and Brewster). Coulson et al.
// (1960) have 0.7 to 0.8.
TEST(SkyView, ClearSkyIsPolarizedAcrossTheSunsPlane) {
  const SkyView sky = view_sky(column("none"), 0.55, 1.0, 60.0 * kDegree);
  const std::size_t away = sky.azimuth_rad.size() - 1;
  const std::size_t ninety = 15;  // 30 degrees from the zenith, opposite the Sun
  ASSERT_NEAR(sky.zenith_rad[ninety], 30.0 * kDegree, 1e-12);
  EXPECT_NEAR(radiometry::degree_of_linear_polarization(sky.at(ninety, away)), 0.80, 0.08);
  EXPECT_LT(radiometry::degree_of_linear_polarization(sky.at(30, 0)), 0.05);
  int neutral = 0;
  for (std::size_t z = 1; z + 1 < sky.zenith_rad.size(); ++z)
    neutral += sky.at(z, 0).q * sky.at(z + 1, 0).q < 0.0 ? 1 : 0;
  EXPECT_EQ(neutral, 2);
}

// Coulson (1988): over a low Sun the points of Babinet and Arago stand some 20 degrees from the Sun and from
// the point opposite, and close in where the air is clearer; light scattered once has none but these two
// themselves.
TEST(SkyView, NeutralPointsAreWhereTheTableHasThem) {
  const double sun = 75.0 * kDegree;
  const auto distance = [&](double wavelength_um, const char* name) {
    for (const NeutralPoint& point : neutral_points(view_sky(column("none"), wavelength_um, 1.0, sun), sun))
      if (point.name == name) return point.distance_rad / kDegree;
    return 0.0;
  };
  const double blue = distance(0.45, "Babinet"), red = distance(0.65, "Babinet");
  EXPECT_GT(blue, 15.0);
  EXPECT_LT(blue, 25.0);
  EXPECT_GT(red, 5.0);
  EXPECT_LT(red, blue);
  // The point opposite is 15 degrees below the horizon: in the red Arago's has not risen yet.
  EXPECT_GT(distance(0.45, "Arago"), 15.0);
  EXPECT_LT(distance(0.45, "Arago"), 25.0);
  EXPECT_EQ(distance(0.65, "Arago"), 0.0);

  SkyView once = view_sky(column("none"), 0.45, 1.0, sun);
  for (StokesVector& light : once.light) light.q = -light.i;
  EXPECT_TRUE(neutral_points(once, sun).empty());
}

// Of the air alone: neither the Sun nor how a channel is divided for its light counts.
TEST(AtmosphereSurvey, WhatTheAirSendsBackDoesNotDependOnTheSun) {
  AtmosphereDescription description;
  description.air.model = "subarctic winter";
  const AtmosphereColumn dry(description);
  const std::vector<radiometry::Channel> channels{radiometry::Channel::gaussian("1.6", 1.6, 0.016),
                                                  radiometry::Channel::gaussian("2.2", 2.2, 0.022)};
  std::vector<AtmosphereEffects> first;
  for (const double zenith_deg : {10.0, 72.0, 80.0, 86.0}) {
    const auto light = survey_effects(dry, channels, radiometry::solar_irradiance_1au(), sun_at(zenith_deg));
    if (first.empty()) first = light;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      EXPECT_NEAR(light[c].spherical_albedo, first[c].spherical_albedo, 1e-4 * first[c].spherical_albedo);
      EXPECT_NEAR(light[c].diffuse_transmittance, first[c].diffuse_transmittance,
                  1e-4 * first[c].diffuse_transmittance);
    }
  }
}

TEST(AtmosphereSurvey, StepsAreAsWideAsTheBandModelResolves) {
  const std::vector<radiometry::Channel> steps = resolved_steps(0.5, 0.6);
  EXPECT_GE(steps.back().response.last_um(), 0.6);
  EXPECT_LE(steps.front().response.first_um(), 0.5);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_NEAR(1e4 / steps[k].response.first_um() - 1e4 / steps[k].response.last_um(), kResolution_cm1,
                1e-6);
    if (k > 0) {
      EXPECT_NEAR(steps[k].response.first_um(), steps[k - 1].response.last_um(), 1e-9);
    }
  }
  EXPECT_LE(resolved_steps(0.3, 14.0, nullptr, 100).size(), 101u);
}

}  // namespace
}  // namespace ifov::atmosphere::test_survey
