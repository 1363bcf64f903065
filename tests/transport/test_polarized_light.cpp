// Sky and path as the transport asks for them, between the directions of the tables, against the solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/polarization_frame.h"
#include "radiometry/solar_spectrum.h"
#include "transport/sky/ground_around.h"
#include "transport/sky/sky_dome.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"
#include "transport/view_table.h"

namespace ifov::transport::test_polarized_light {
namespace {

using atmosphere::Propagation;
using math::Vec3;
using radiometry::PolarizationFrame;
using radiometry::StokesVector;

constexpr double kDegree = std::numbers::pi / 180.0, kPi = std::numbers::pi;
constexpr double kSunZenith = 50.0 * kDegree, kSunAzimuth = 0.7;  // counterclockwise from x
constexpr double kUm = 0.45, kSensor_km = 6.0;

Vec3 direction(double zenith, double azimuth) {
  return {std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth), std::cos(zenith)};
}

class PolarizedLight : public testing::Test {
 protected:
  static atmosphere::SensorAtmosphere::Inputs inputs(bool polarized) {
    static const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("", kUm)};
    atmosphere::SensorAtmosphere::Inputs inputs;
    inputs.channels = channels;
    inputs.solar_irradiance = radiometry::solar_irradiance_1au();
    inputs.geometry.sun_zenith_rad = kSunZenith;
    inputs.geometry.sensor_altitude_km = kSensor_km;
    inputs.lines_of_sight =
        atmosphere::LineOfSightGrid({-0.6, 0.5, 0.0, 0.55, 0.0}, column().levels(), {kSensor_km, kSensor_km});
    inputs.polarized = polarized;
    return inputs;
  }
  static const atmosphere::AtmosphereColumn& column() {
    static const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
    return column;
  }
  static const atmosphere::SensorAtmosphere& air() {
    static const atmosphere::SensorAtmosphere air(column(), inputs(true));
    return air;
  }
  static const atmosphere::ColumnSolution& solved() {
    static const atmosphere::ColumnSolution solved = atmosphere::ColumnSolver().solve(
        column().levels(), column().at(5.0 * std::round(1e4 / kUm / 5.0)).term(0), kSunZenith);
    return solved;
  }
  const Vec3 towards_sun_ = direction(kSunZenith, kSunAzimuth);
  const GroundAround black_{std::vector<double>(air().node_count(), 0.0), {}};

  /// The same light about the frame that an answer is about. In the solver sunlight propagates along x.
  static StokesVector about(const StokesVector& light, const Propagation& solver,
                            const PolarizationFrame& frame) {
    const PolarizationFrame own =
        radiometry::meridional_frame(solver.mu, solver.azimuth_rad + kSunAzimuth + kPi);
    EXPECT_NEAR(length(own.direction - frame.direction), 0.0, 1e-7);
    return turned(own, frame) * light;
  }
  struct Error {
    double polarization = 0.0;  ///< |difference of (Q, U) / I|
    double radiance = 0.0;      ///< relative
  };
  static Error error(const StokesVector& found, const StokesVector& expected) {
    return {
        std::hypot(found.q / found.i - expected.q / expected.i, found.u / found.i - expected.u / expected.i),
        std::abs(found.i / expected.i - 1.0)};
  }
};

TEST_F(PolarizedLight, OfTheSkyBetweenTheTablesDirections) {
  const SkyDome dome(air(), towards_sun_, black_);
  ASSERT_TRUE(dome.polarized());
  std::vector<StokesVector> light(air().node_count());
  double worst = 0.0;
  for (const double zenith : {0.0, 1e-9, 1.0, 4.0, 9.0, 25.0, 45.0, 63.0, 82.0})
    for (const double azimuth : {3.0, 25.0, 75.0, 127.0, 172.0, -45.0, -140.0}) {
      const double away = azimuth * kDegree + kSunAzimuth;
      if (zenith > 40.0 && std::abs(azimuth) < 20.0) continue;  // the aureole is steeper than the table
      const PolarizationFrame frame = dome.stokes(direction(zenith * kDegree, away), light);
      EXPECT_NEAR(length(frame.x - radiometry::meridional_frame(frame.direction).x), 0.0, 1e-12);
      const Propagation from{-std::cos(zenith * kDegree), azimuth * kDegree};
      const StokesVector expected =
          about(solved().sunlit().sky(from, column().levels().altitude_km.front()).radiance(), from, frame);
      const double off = error(light[0], expected).polarization;
      EXPECT_LT(off, 0.02) << zenith << " " << azimuth;
      worst = std::max(worst, off);
      // I is that of the scalar table.
      const SkyDome::Corners corners = dome.at(direction(zenith * kDegree, away));
      double i = 0.0;
      for (std::size_t k = 0; k < 4; ++k)
        i += static_cast<double>(corners.weight[k]) * static_cast<double>(corners.spectrum[k][0]);
      EXPECT_NEAR(light[0].i, i, 1e-6 * i);
    }
  RecordProperty("worst", std::to_string(worst));
}

// The planted fault: Q and U of the table's directions averaged as they are, though each is about its own plane.
TEST_F(PolarizedLight, NaiveAveragesBreakAtTheZenith) {
  const SkyDome dome(air(), towards_sun_, black_);
  const atmosphere::SkyDirections& sky = air().sky_directions();
  std::vector<StokesVector> light(air().node_count());
  double worst = 0.0, worst_naive = 0.0, jump = 0.0, jump_naive = 0.0;
  // Straight up, and along a line that passes it.
  for (const double x : {-0.02, -0.001, 0.0, 0.001, 0.02}) {
    const Vec3 up = math::normalized(Vec3{x * std::cos(2.0), x * std::sin(2.0), 1.0});
    const PolarizationFrame frame = dome.stokes(up, light);
    const double zenith = std::acos(std::min(1.0, up.z));
    const double azimuth =
        std::abs(std::remainder((x == 0.0 ? 0.0 : std::atan2(up.y, up.x)) - kSunAzimuth, 2.0 * kPi));
    const bool left = std::remainder(std::atan2(up.y, up.x) - kSunAzimuth, 2.0 * kPi) >= 0.0;
    const auto above = std::upper_bound(sky.azimuth_rad.begin() + 1, sky.azimuth_rad.end() - 1, azimuth);
    const std::size_t a = static_cast<std::size_t>(above - sky.azimuth_rad.begin()) - 1;
    const double on = (azimuth - sky.azimuth_rad[a]) / (sky.azimuth_rad[a + 1] - sky.azimuth_rad[a]),
                 out = zenith / sky.zenith_rad[1];
    StokesVector naive;
    for (const std::size_t dz : {0, 1})
      for (const std::size_t da : {0, 1})
        naive += (dz == 0 ? 1.0 - out : out) * (da == 0 ? 1.0 - on : on) * air().sky_stokes(dz, a + da, 0);
    // Straight up the azimuth is what it is taken to be, and the average about the Sun's plane.
    if (x == 0.0) naive = air().sky_stokes(0, 0, 0);
    if (!left) naive.u = -naive.u;
    const Propagation from{-std::cos(zenith), std::atan2(up.y, up.x) - kSunAzimuth};
    const StokesVector expected =
        about(solved().sunlit().sky(from, column().levels().altitude_km.front()).radiance(), from, frame);
    worst = std::max(worst, error(light[0], expected).polarization);
    worst_naive = std::max(worst_naive, error(naive, expected).polarization);
    // Told about one common frame, light does not jump.
    const PolarizationFrame upright = radiometry::meridional_frame(Vec3{0.0, 0.0, -1.0});
    const auto level = [&](const StokesVector& s) {
      return turned(radiometry::carried(frame, upright.direction), upright) * s;
    };
    dome.stokes({0.0, 0.0, 1.0}, light);
    const StokesVector top = light[0];
    dome.stokes(up, light);
    jump = std::max(jump, error(level(light[0]), top).polarization);
    jump_naive = std::max(jump_naive, error(level(naive), top).polarization);
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(jump, 0.02);
  EXPECT_GT(worst_naive, 0.1);
  EXPECT_GT(jump_naive, 0.1);
}

TEST_F(PolarizedLight, OfThePathBetweenItsLinesOfSight) {
  const ViewTable table(air(), towards_sun_, black_);
  ASSERT_TRUE(table.polarized());
  std::vector<StokesVector> light(air().node_count());
  const double sun = radiometry::solar_irradiance_1au().at(kUm);
  double worst_of_planes = 0.0;
  for (const double zenith : {0.0, 1e-9, 0.5, 3.0, 12.0, 25.0})
    for (const double azimuth : {10.0, 75.0, 130.0, 175.0, -60.0, -120.0}) {
      const Vec3 k = direction(zenith * kDegree, azimuth * kDegree + kSunAzimuth);
      const PolarizationFrame frame = table.stokes(k, 0.0, 1e3 * kSensor_km, light);
      const Propagation up{std::cos(zenith * kDegree), azimuth * kDegree - kPi};
      const StokesVector exact = sun * solved().sunlit().path(up, kSensor_km).radiance(),
                         expected = about(exact, up, frame);
      EXPECT_LT(error(light[0], expected).polarization, 3e-3) << zenith << " " << azimuth;
      EXPECT_LT(error(light[0], expected).radiance, 5e-3) << zenith << " " << azimuth;
      // The planted fault: polynomials through what each line has about its own plane.
      const std::vector<double> weight = air().lines_of_sight().weights(
          atmosphere::LineOfSight{zenith * kDegree, std::abs(azimuth) * kDegree, 0.0});
      StokesVector naive{light[0].i, 0.0, 0.0, 0.0};
      for (std::size_t line = 0; line < weight.size(); ++line) {
        naive.q += weight[line] * air().line_of_sight_polarization(line).q[0];
        naive.u += weight[line] * air().line_of_sight_polarization(line).u[0] * (azimuth < 0.0 ? -1.0 : 1.0);
      }
      worst_of_planes = std::max(worst_of_planes, error(naive, exact).polarization);
    }
  EXPECT_GT(worst_of_planes, 0.05);
}

TEST_F(PolarizedLight, BrightGroundAddsToBoth) {
  const GroundAround bright{std::vector<double>(air().node_count(), 50.0), {}};
  const SkyDome dark(air(), towards_sun_, black_), lit(air(), towards_sun_, bright);
  const ViewTable dark_path(air(), towards_sun_, black_), lit_path(air(), towards_sun_, bright);
  std::vector<StokesVector> a(air().node_count()), b(air().node_count());
  const Vec3 d = direction(60.0 * kDegree, 2.0);
  const PolarizationFrame frame = dark.stokes(d, a);
  lit.stokes(d, b);
  const StokesVector sky =
      solved().groundlit().sky({-0.5, 0.0}, column().levels().altitude_km.front()).radiance();
  EXPECT_NEAR((b[0].q - a[0].q) / (b[0].i - a[0].i), sky.q / sky.i, 0.01);
  EXPECT_NEAR((b[0].u - a[0].u) / (b[0].i - a[0].i), 0.0, 1e-4);
  EXPECT_NEAR(dot(frame.y(), {0.0, 0.0, 1.0}), 0.0, 1e-12);
  const Vec3 k = direction(25.0 * kDegree, 2.0);
  dark_path.stokes(k, 0.0, 1e3 * kSensor_km, a);
  lit_path.stokes(k, 0.0, 1e3 * kSensor_km, b);
  const StokesVector path = solved().diffuse_transmittance(std::cos(25.0 * kDegree), kSensor_km);
  EXPECT_NEAR((b[0].q - a[0].q) / (b[0].i - a[0].i) * path.i / path.q, 1.0, 0.05);
  EXPECT_NEAR((b[0].u - a[0].u) / (b[0].i - a[0].i), 0.0, 1e-3);
}

TEST_F(PolarizedLight, NotAskedForIsNotThere) {
  const atmosphere::SensorAtmosphere scalar(column(), inputs(false));
  const SkyDome dome(scalar, towards_sun_, black_), polarized(air(), towards_sun_, black_);
  EXPECT_FALSE(dome.polarized());
  EXPECT_FALSE(ViewTable(scalar, towards_sun_, black_).polarized());
  // The radiance is the same light's, refined between its directions.
  const auto radiance = [](const SkyDome& sky, double zenith) {
    const SkyDome::Corners corners = sky.at(direction(zenith * kDegree, 1.0));
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
      sum += static_cast<double>(corners.weight[k] * corners.spectrum[k][0]);
    return sum;
  };
  for (const double zenith : {0.0, 33.0, 80.0})
    EXPECT_NEAR(radiance(polarized, zenith) / radiance(dome, zenith), 1.0, 0.01) << zenith;
}

// Where one line of sight holds for all, paths take its row, and the table is there for its polarization alone.
TEST_F(PolarizedLight, OfASceneSeenFromAfar) {
  atmosphere::SensorAtmosphere::Inputs far = inputs(true);
  far.geometry.view_zenith_rad = 25.0 * kDegree;
  far.geometry.view_azimuth_rad = -60.0 * kDegree;
  far.lines_of_sight.reset();
  test::SmallScene scene;
  scene.build();
  scene.scene().sun.emplace().direction = towards_sun_;
  const atmosphere::SensorAtmosphere seen(column(), far);
  const SpectralScene spectral(scene.scene(), seen, true);
  EXPECT_EQ(spectral.view_table(), nullptr);
  ASSERT_NE(spectral.polarized_path(), nullptr);
  std::vector<StokesVector> light(seen.node_count());
  for (const double side : {1.0, -1.0}) {
    const Propagation up{std::cos(25.0 * kDegree), side * 60.0 * kDegree - kPi};
    const PolarizationFrame frame = spectral.polarized_path()->stokes(
        direction(25.0 * kDegree, side * 60.0 * kDegree + kSunAzimuth), 0.0, 1e3 * kSensor_km, light);
    const StokesVector expected = about(solved().sunlit().path(up, kSensor_km).radiance(), up, frame);
    EXPECT_LT(error({light[0].i, light[0].q, light[0].u, 0.0},
                    radiometry::solar_irradiance_1au().at(kUm) * expected)
                  .polarization,
              3e-3)
        << side;
    EXPECT_GT(std::abs(expected.u), 0.01 * expected.i);
    EXPECT_NEAR(light[0].i, static_cast<double>(spectral.view_radiance()[0]), 1e-6 * light[0].i);
  }
  far.polarized = false;
  const atmosphere::SensorAtmosphere scalar(column(), far);
  EXPECT_EQ(SpectralScene(scene.scene(), scalar).polarized_path(), nullptr);
}

// A Sun in the zenith has no azimuth: light is the same all around, and unpolarized in the zenith.
TEST_F(PolarizedLight, UnderASunInTheZenith) {
  atmosphere::SensorAtmosphere::Inputs noon = inputs(true);
  noon.geometry.sun_zenith_rad = 0.0;
  const atmosphere::SensorAtmosphere above(column(), noon);
  const SkyDome dome(above, {0.0, 0.0, 1.0}, black_);
  std::vector<StokesVector> first(above.node_count()), other(above.node_count());
  dome.stokes(direction(70.0 * kDegree, 0.0), first);
  EXPECT_LT(first[0].q, -0.2 * first[0].i);
  for (const double azimuth : {1.0, 2.5, -2.0}) {
    dome.stokes(direction(70.0 * kDegree, azimuth), other);
    EXPECT_NEAR(other[0].q, first[0].q, 1e-6 * first[0].i);
    EXPECT_NEAR(other[0].u, 0.0, 1e-6 * first[0].i);
  }
}

}  // namespace
}  // namespace ifov::transport::test_polarized_light
