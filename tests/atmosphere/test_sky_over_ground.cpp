// What facets make of Sun and sky, against a sum over a fine sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/ground_monte_carlo.h"
#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "atmosphere/sensor/sky_over_ground.h"
#include "atmosphere/test_ground.h"
#include "radiometry/solar_spectrum.h"
#include "radiometry/stokes.h"

namespace test_sky_over_ground {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;
using ifov::radiometry::StokesVector;

namespace {

constexpr double kPi = std::numbers::pi, kEmitted = 400.0;

/// The table's sky over the ground, linear between its directions and held below the last.
StokesVector sky_at(const SensorAtmosphere& air, double zenith_rad, double azimuth_rad) {
  const SkyDirections& table = air.sky_directions();
  const DirectionalLight& ground = *air.directional();
  const auto place = [](const std::vector<double>& at, double x) {
    std::size_t low = 0;
    while (low + 2 < at.size() && at[low + 1] <= x) ++low;
    return std::pair{low, (x - at[low]) / (at[low + 1] - at[low])};
  };
  const auto [z, down] = place(table.zenith_rad, std::min(zenith_rad, table.zenith_rad.back()));
  const auto [a, along] = place(table.azimuth_rad, std::abs(azimuth_rad));
  StokesVector sum;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double weight = (i == 0 ? 1.0 - down : down) * (j == 0 ? 1.0 - along : along);
      const std::size_t row = (z + i) * table.azimuth_rad.size() + a + j;
      const StokesVector of_ground{ground.sky_i[row], ground.sky_q[row], ground.sky_u[row], 0.0};
      sum += weight * (air.sky_stokes(z + i, a + j, 0) + ground.exitance(0, kEmitted) / kPi * of_ground +
                       kEmitted * air.groundlit_sky_stokes(z + i, 0));
    }
  if (azimuth_rad < 0.0) sum.u = -sum.u;
  return sum;
}

}  // namespace

TEST(SkyOverGround, IsTheSumOverAFineSky) {
  const GroundOfFields fields = facets_of_fields(1.34, 0.06);
  const auto facets = std::make_shared<const FormulaGround>(
      [fields](const GroundEvent& e) {
        const Vector in = towards(e.in_mu, e.in_azimuth_rad), out = towards(e.out_mu, e.out_azimuth_rad);
        GroundMatrix matrix{};
        for (std::size_t column = 0; column < 3; ++column) {
          std::array<double, 3> unit{};
          unit[column] = 1.0;
          const auto made = stokes_of(fields(dyad_of(unit, in), in, out), out);
          for (std::size_t row = 0; row < 3; ++row) matrix[row][column] = made[row];
        }
        return matrix;
      },
      true);
  const AtmosphereColumn column{AtmosphereDescription{}};
  const std::vector<ifov::radiometry::Channel> channels{
      ifov::radiometry::Channel::monochromatic("blue", 0.45)};
  SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = ifov::radiometry::solar_irradiance_1au();
  inputs.geometry.sun_zenith_rad = 50.0 * kPi / 180.0;
  inputs.geometry.sensor_altitude_km = 4.0;
  inputs.polarized = true;
  inputs.directional = facets;
  const SensorAtmosphere air(column, inputs);
  ASSERT_EQ(air.node_count(), 1u);
  const std::vector<double> emitted{kEmitted};
  const SkyOverGround light(air, emitted);
  for (const auto& [mu, azimuth] : {std::pair{0.8, 0.4}, {0.6, -1.5}, {0.55, 2.9}}) {
    const Vector out = towards(mu, azimuth);
    std::array<double, 3> wanted{};
    double whole = 0.0;
    constexpr int kZeniths = 180, kAzimuths = 360;
    for (int i = 0; i < kZeniths; ++i)
      for (int j = 0; j < kAzimuths; ++j) {
        const double zenith = 0.5 * kPi * (i + 0.5) / kZeniths,
                     from = 2.0 * kPi * (j + 0.5) / kAzimuths - kPi;
        const double weight = std::sin(zenith) * std::cos(zenith);
        const StokesVector sky = sky_at(air, zenith, from);
        const Vector in = towards(-std::cos(zenith), from);
        const auto made = stokes_of(fields(dyad_of({sky.i, sky.q, sky.u}, in), in, out), out);
        for (std::size_t c = 0; c < 3; ++c) wanted[c] += weight * made[c];
        whole += weight;
      }
    for (double& value : wanted) value *= kPi / whole;
    const SkyOverGround::Radiance found = light.towards(mu, azimuth);
    const double polarized = std::hypot(wanted[1], wanted[2]);
    EXPECT_NEAR(found.sky[0] / wanted[0], 1.0, 1e-3) << mu;
    EXPECT_NEAR(found.sky[1], wanted[1], 4e-3 * polarized) << mu;
    EXPECT_NEAR(found.sky[2], wanted[2], 4e-3 * polarized) << mu;
    const double sine = air.geometry().sun_sine(), sun = air.sun_irradiance()[0] * sine;
    const Vector beam = towards(-sine, 0.0);
    const auto made = stokes_of(fields(dyad_of({sun, 0.0, 0.0}, beam), beam, out), out);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found.sun[c], made[c], 1e-9 * made[0]);
  }
}

}  // namespace test_sky_over_ground
