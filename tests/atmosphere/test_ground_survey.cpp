// What channels see over ground that reflects by direction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/column_maker.h"
#include "atmosphere/ground_monte_carlo.h"
#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/reflected_light.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "atmosphere/survey/survey_effects.h"
#include "atmosphere/test_ground.h"
#include "radiometry/solar_spectrum.h"

namespace test_ground_survey {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;
using ifov::radiometry::Channel;

namespace {

constexpr double kPi = std::numbers::pi;

std::shared_ptr<const FormulaGround> facets() {
  const GroundOfFields fields = facets_of_fields(1.34, 0.06);
  return std::make_shared<const FormulaGround>(
      [fields](const GroundEvent& e) {
        const Vector in = towards(e.in_mu, e.in_azimuth_rad), out = towards(e.out_mu, e.out_azimuth_rad);
        GroundMatrix matrix{};
        for (std::size_t column = 0; column < 3; ++column) {
          std::array<double, 3> unit{};
          unit[column] = 1.0;
          const std::array<double, 3> made = stokes_of(fields(dyad_of(unit, in), in, out), out);
          for (std::size_t row = 0; row < 3; ++row) matrix[row][column] = made[row];
        }
        return matrix;
      },
      true);
}

AtmosphereEffects survey(const AtmosphereColumn& air, const Channel& channel, const SensorGeometry& where,
                         std::shared_ptr<const DirectionalGround> ground, double reflectance = 0.0) {
  SurveyControl control;
  control.ground = ifov::radiometry::Spectrum::constant(reflectance);
  control.directional = std::move(ground);
  return survey_effects(air, {&channel, 1}, ifov::radiometry::solar_irradiance_1au(), where, control).front();
}

SensorGeometry where(double sensor_km, double azimuth_deg) {
  SensorGeometry geometry;
  geometry.sun_zenith_rad = 50.0 * kDegree;
  geometry.sensor_altitude_km = sensor_km;
  geometry.view_zenith_rad = 30.0 * kDegree;
  geometry.view_azimuth_rad = azimuth_deg * kDegree;
  return geometry;
}

/// In shares of the radiance, the largest difference of I, Q and U between what channels are told and every bin and term solved
/// in full, from within the air and from above it, on both sides of the Sun's plane; and that of the fluxes in shares of theirs.
struct Differences {
  double light = 0.0, fluxes = 0.0;
};
Differences against_full(const AtmosphereColumn& air, const std::shared_ptr<const FormulaGround>& given,
                         const FormulaGround& right) {
  const ColumnSolver solver;
  Differences worst;
  for (const Channel& channel :
       {Channel::top_hat("water", 0.936, 0.939), Channel::top_hat("blue", 0.4700, 0.4705)})
    for (const auto& [sensor_km, azimuth_deg] : {std::pair{2.0, -60.0}, std::pair{100.0, 160.0}}) {
      const SensorGeometry geometry = where(sensor_km, azimuth_deg);
      const Propagation up{std::cos(geometry.view_zenith_rad), -geometry.view_azimuth_rad - kPi};
      StokesVector light;
      double ground_up = 0.0, sensor_up = 0.0;
      for (const ChannelBin& bin : channel_bins(channel, ifov::radiometry::solar_irradiance_1au())) {
        const ColumnOptics optics = air.at(bin.wavenumber_cm1);
        const GroundModes modes = solver.modes_of(right, bin.wavelength_um, *geometry.sun_zenith_rad);
        for (std::size_t term = 0; term < optics.terms(); ++term) {
          const ColumnSolution solved =
              solver.solve(air.levels(), optics.term(term), *geometry.sun_zenith_rad, &modes);
          if (solved.reflected() == nullptr) {  // no light comes down
            light += bin.share * optics.weight(term) * bin.irradiance *
                     solved.sunlit().line_of_sight(up, sensor_km, 0.0).radiance();
            sensor_up +=
                bin.share * optics.weight(term) * bin.irradiance * solved.sunlit().fluxes().at(sensor_km).up;
            continue;
          }
          const double weight = bin.share * optics.weight(term) * bin.irradiance,
                       exitance = solved.reflected()->exitance, radiance = exitance / kPi;
          const PathLight path = solved.sunlit().line_of_sight(up, sensor_km, 0.0);
          light +=
              weight * (path.radiance() + radiance * (solved.reflected_transmittance(up, sensor_km) +
                                                      path.transmittance * solved.reflected()->shape.radiance(
                                                                               up.mu, up.azimuth_rad)));
          ground_up += weight * exitance;
          sensor_up += weight * (solved.sunlit().fluxes().at(sensor_km).up +
                                 exitance * solved.reflected_flux(sensor_km).up);
        }
      }
      const AtmosphereEffects::OverGround found = survey(air, channel, geometry, given).over_ground;
      for (const double difference : {found.radiance - light.i, found.q - light.q, found.u - light.u})
        worst.light = std::max(worst.light, std::abs(difference) / light.i);
      worst.fluxes = std::max({worst.fluxes, std::abs(found.ground_up / ground_up - 1.0),
                               std::abs(found.sensor_up / sensor_up - 1.0)});
    }
  return worst;
}

}  // namespace

TEST(GroundSurvey, FacetsAreAsEveryTermSolvedInFull) {
  AtmosphereDescription description;
  description.aerosol.type = "rural";
  const AtmosphereColumn air(description);
  const auto ground = facets();
  const Differences found = against_full(air, ground, *ground);
  RecordProperty("light", std::to_string(found.light));
  RecordProperty("fluxes", std::to_string(found.fluxes));
  EXPECT_LT(found.light, 0.006);
  // What leaves the ground in all is worked out from the sky's I alone.
  EXPECT_LT(found.fluxes, 0.03);
  // Planted: seen from the other side of the Sun.
  const auto mirrored = std::make_shared<const FormulaGround>(
      [ground](const GroundEvent& e) {
        GroundMatrix brdf[1];
        const GroundEvent turned{e.out_mu, e.in_mu, e.out_azimuth_rad + kPi, e.in_azimuth_rad};
        ground->reflect(0.5, {&turned, 1}, brdf);
        return brdf[0];
      },
      true);
  EXPECT_GT(against_full(air, mirrored, *ground).light, 0.05);
}

TEST(GroundSurvey, LambertianGroundIsAsItsReflectanceSays) {
  const AtmosphereColumn air{AtmosphereDescription{}};
  const auto even =
      std::make_shared<const FormulaGround>(scalar_ground([](double, double, double) { return 0.3 / kPi; }));
  const Channel channel = Channel::top_hat("red", 0.65, 0.67);
  for (const double sensor_km : {2.0, 100.0}) {
    const AtmosphereEffects::OverGround by_brdf =
                                            survey(air, channel, where(sensor_km, 40.0), even).over_ground,
                                        wanted = survey(air, channel, where(sensor_km, 40.0), nullptr, 0.3)
                                                     .over_ground;
    EXPECT_NEAR(by_brdf.radiance / wanted.radiance, 1.0, 1e-4);
    EXPECT_NEAR(by_brdf.ground_up / wanted.ground_up, 1.0, 1e-4);
    EXPECT_NEAR(by_brdf.ground_diffuse / wanted.ground_diffuse, 1.0, 1e-4);
    EXPECT_NEAR(by_brdf.sensor_up / wanted.sensor_up, 1.0, 1e-4);
    EXPECT_NEAR(by_brdf.sensor_diffuse, wanted.sensor_diffuse, 1e-4 * wanted.sensor_diffuse);
    EXPECT_NEAR(by_brdf.q, wanted.q, 1e-4 * wanted.radiance);
    EXPECT_NEAR(by_brdf.u, wanted.u, 1e-4 * wanted.radiance);
  }
}

}  // namespace test_ground_survey
