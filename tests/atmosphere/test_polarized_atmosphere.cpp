// Q and U in a sensor's tables, against the solver.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/profile/gas_requests.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere::test_polarized_atmosphere {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kPi = std::numbers::pi;

/// Keeps everything, as the scene cache does.
class Memory final : public KeptSolutions {
 public:
  bool find(std::span<const double> question, std::span<double> answer) override {
    const auto known = answers_.find({question.begin(), question.end()});
    if (known == answers_.end() || known->second.size() != answer.size()) return false;
    std::copy(known->second.begin(), known->second.end(), answer.begin());
    ++found;
    return true;
  }
  void keep(std::span<const double> question, std::span<const double> answer) override {
    answers_[{question.begin(), question.end()}] = {answer.begin(), answer.end()};
  }
  int found = 0;

 private:
  std::map<std::vector<double>, std::vector<double>> answers_;
};

class PolarizedAtmosphere : public testing::Test {
 protected:
  PolarizedAtmosphere() {
    inputs_.solar_irradiance = radiometry::solar_irradiance_1au();
    inputs_.geometry.sun_zenith_rad = 50.0 * kDegree;
    inputs_.geometry.sensor_altitude_km = 6.0;
    inputs_.demands.tolerance = 1e-3;
    inputs_.demands.most_nodes = 8;
    inputs_.polarized = true;
    inputs_.threads = 1;
  }
  SensorAtmosphere build(const std::vector<radiometry::Channel>& channels) {
    inputs_.channels = channels;
    return SensorAtmosphere(column_, inputs_);
  }
  static void expect_same(std::span<const double> a, std::span<const double> b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k], b[k]);
  }

  AtmosphereColumn column_{AtmosphereDescription{}};
  SensorAtmosphere::Inputs inputs_;
  const std::vector<radiometry::Channel> wide_{radiometry::Channel::gaussian("", 0.45, 0.02),
                                               radiometry::Channel::gaussian("", 0.94, 0.03),
                                               radiometry::Channel::gaussian("", 10.0, 0.5)};
};

// At single wavelengths a channel is one bin and one term, whose solution the tables interpolate.
TEST_F(PolarizedAtmosphere, TablesHoldWhatTheSolverTells) {
  inputs_.geometry.view_zenith_rad = 20.0 * kDegree;
  inputs_.geometry.view_azimuth_rad = 65.0 * kDegree;
  const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("", 0.45),
                                                  radiometry::Channel::monochromatic("", 0.86)};
  const SensorAtmosphere air = build(channels);
  ASSERT_TRUE(air.polarized());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const double um = channels[c].centre_um, sun = inputs_.solar_irradiance.at(um);
    const LayerOptics layers = column_.at(5.0 * std::round(1e4 / um / 5.0)).term(0);
    const ColumnSolution solved =
        ColumnSolver().solve(column_.levels(), layers, *inputs_.geometry.sun_zenith_rad);
    const StokesVector path =
        sun * solved.sunlit().path({std::cos(20.0 * kDegree), 65.0 * kDegree - kPi}, 6.0).radiance();
    const SensorAtmosphere::LineOfSightPolarization seen = air.line_of_sight_polarization(0);
    EXPECT_NEAR(seen.q[c], path.q, 3e-3 * path.i) << um;
    EXPECT_NEAR(seen.u[c], path.u, 3e-3 * path.i) << um;
    EXPECT_GT(std::abs(path.u), 0.01 * path.i) << "U of the other sign passes";
    const StokesVector diffuse = solved.diffuse_transmittance(std::cos(20.0 * kDegree), 6.0);
    EXPECT_NEAR(seen.diffuse_q[c] / diffuse.i, diffuse.q / diffuse.i, 1e-5) << um;
    const SkyDirections& sky = air.sky_directions();
    const double ground_km = column_.levels().altitude_km.front();
    for (const std::size_t z : {std::size_t{0}, std::size_t{3}, sky.zenith_rad.size() - 3})
      for (const std::size_t a : {std::size_t{4}, std::size_t{9}, std::size_t{16}}) {
        const Propagation from{-std::cos(sky.zenith_rad[z]), sky.azimuth_rad[a]};
        const StokesVector expected = sun * solved.sunlit().sky(from, ground_km).radiance();
        const StokesVector found = air.sky_stokes(z, a, c);
        // The table's own integral is made the irradiance, which changes all by a percent.
        EXPECT_NEAR(found.q / found.i, expected.q / expected.i, 3e-3) << z << " " << a;
        EXPECT_NEAR(found.u / found.i, expected.u / expected.i, 3e-3) << z << " " << a;
      }
    const StokesVector ground =
        solved.groundlit().sky({-std::cos(sky.zenith_rad[8]), 0.0}, ground_km).radiance();
    const StokesVector found = air.groundlit_sky_stokes(8, c);
    EXPECT_NEAR(found.q / found.i, ground.q / ground.i, 3e-3);
    EXPECT_EQ(found.u, 0.0);
  }
}

/// How far two are apart, in parts of what is wanted.
double off(double found, double wanted) { return std::abs(found / wanted - 1.0); }

// Where no gas absorbs (pairs of oxygen neither) nothing is interpolated, and a hundredth of any Q or U is seen.
TEST_F(PolarizedAtmosphere, WithoutGasTablesAreWhatTheSolverTells) {
  constexpr double kSeen = 1e-4;  // a hundredth of what a hundredth would be
  AtmosphereDescription description;
  description.air.ozone_DU = 0.0;
  description.air.water_vapour_g_cm2 = 0.0;
  GasRequests gases;
  gases.of[static_cast<std::size_t>(Gas::no2)].emplace().off = true;
  description.air.gases = std::make_shared<const GasRequests>(gases);
  column_ = AtmosphereColumn(description);
  inputs_.geometry.view_zenith_rad = 35.0 * kDegree;
  inputs_.geometry.view_azimuth_rad = 65.0 * kDegree;
  const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("", 1.0 / 2.439),
                                                  radiometry::Channel::monochromatic("", 1.0 / 1.4925)};
  const SensorAtmosphere air = build(channels);
  const double ground_km = column_.levels().altitude_km.front(), mu = std::cos(35.0 * kDegree);
  const SkyDirections& sky = air.sky_directions();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const double um = channels[c].centre_um, sun = inputs_.solar_irradiance.at(um);
    const ColumnOptics optics = column_.at(1e4 / um);
    ASSERT_EQ(optics.terms(), 1u) << um;
    const ColumnSolution solved =
        ColumnSolver().solve(column_.levels(), optics.term(0), *inputs_.geometry.sun_zenith_rad);
    const StokesVector path =
        sun * solved.sunlit().line_of_sight({mu, 65.0 * kDegree - kPi}, 6.0, ground_km).radiance();
    const SensorAtmosphere::LineOfSightPolarization seen = air.line_of_sight_polarization(0);
    EXPECT_LT(off(seen.q[c], path.q), kSeen) << um;
    EXPECT_LT(off(seen.u[c], path.u), kSeen) << um;
    // What comes more than once alone: a hundredth of it is not seen in the sum.
    const StokesVector once =
        sun * solved.sunlit().line_of_sight({mu, 65.0 * kDegree - kPi}, 6.0, ground_km).single;
    EXPECT_LT(off(seen.q[c] - once.q, path.q - once.q), 10.0 * kSeen) << um;
    EXPECT_LT(off(seen.u[c] - once.u, path.u - once.u), 10.0 * kSeen) << um;
    const StokesVector diffuse = solved.diffuse_transmittance(mu, 6.0);
    EXPECT_LT(off(seen.diffuse_q[c], diffuse.q), kSeen) << um;
    for (const std::size_t z : {std::size_t{1}, std::size_t{5}, sky.zenith_rad.size() - 2})
      for (const std::size_t a : {std::size_t{4}, std::size_t{9}, std::size_t{16}}) {
        const Propagation from{-std::cos(sky.zenith_rad[z]), sky.azimuth_rad[a]};
        const StokesVector expected = sun * solved.sunlit().sky(from, ground_km).radiance(),
                           found = air.sky_stokes(z, a, c);
        EXPECT_LT(off(found.q / found.i, expected.q / expected.i), kSeen) << z << " " << a;
        EXPECT_LT(off(found.u / found.i, expected.u / expected.i), kSeen) << z << " " << a;
      }
    const StokesVector ground =
                           solved.groundlit().sky({-std::cos(sky.zenith_rad[8]), 0.0}, ground_km).radiance(),
                       found = air.groundlit_sky_stokes(8, c);
    EXPECT_LT(off(found.q / found.i, ground.q / ground.i), kSeen) << um;
  }
}

// Near the vertical and under a high Sun a round Earth polarizes as a flat one, where tables and other programs check Q and U.
TEST_F(PolarizedAtmosphere, ThroughShellsNearTheVerticalIsAsThroughFlatLayers) {
  const ColumnSolution solved =
      ColumnSolver().solve(column_.levels(), column_.at(22220.0).term(0), 30.0 * kDegree);
  const double ground_km = column_.levels().altitude_km.front();
  for (const double azimuth : {0.7, 1.9, 2.8}) {
    const Propagation up{std::cos(15.0 * kDegree), azimuth}, down{-std::cos(15.0 * kDegree), azimuth};
    for (const bool from_above : {true, false}) {
      const PathLight round = from_above ? solved.sunlit().line_of_sight(up, 90.0, ground_km)
                                         : solved.sunlit().sky(down, ground_km),
                      flat =
                          from_above ? solved.sunlit().path(up, 90.0) : solved.sunlit().path(down, ground_km);
      for (const auto part : {&PathLight::single, &PathLight::multiple}) {
        EXPECT_LT(off((round.*part).q / (round.*part).i, (flat.*part).q / (flat.*part).i), 4e-3)
            << azimuth << from_above;
        EXPECT_LT(off((round.*part).u / (round.*part).i, (flat.*part).u / (flat.*part).i), 4e-3)
            << azimuth << from_above;
      }
    }
  }
}

// The irradiance of a coarse table with sunlight and emission in it is put right by a factor, the same for I, Q and U.
TEST_F(PolarizedAtmosphere, ACoarseTableIsAsPolarizedAsAFineOne) {
  const std::vector<radiometry::Channel> mixed{radiometry::Channel::monochromatic("", 3.8)};
  const SensorAtmosphere fine = build(mixed);
  const SkyDirections& all = fine.sky_directions();
  const std::size_t last = all.zenith_rad.size() - 1, end = all.azimuth_rad.size() - 1;
  inputs_.sky = SkyDirections{{all.zenith_rad[0], all.zenith_rad[last]},
                              {all.azimuth_rad[0], all.azimuth_rad[9], all.azimuth_rad[end]}};
  const SensorAtmosphere coarse = build(mixed);
  const StokesVector a = fine.sky_stokes(last, 9, 0), b = coarse.sky_stokes(1, 1, 0);
  EXPECT_GT(std::abs(b.i / a.i - 1.0), 0.05) << "nothing had to be put right";
  EXPECT_GT(std::abs(a.u), 1e-3 * std::abs(a.q));
  EXPECT_NEAR(b.u / b.q, a.u / a.q, 0.01 * std::abs(a.u / a.q));
}

TEST_F(PolarizedAtmosphere, IIsWhatItIsWithoutAndNothingIsKeptThen) {
  const SensorAtmosphere with = build(wide_);
  inputs_.polarized = false;
  const SensorAtmosphere without = build(wide_);
  EXPECT_FALSE(without.polarized());
  expect_same(with.view_radiance(), without.view_radiance());
  expect_same(with.sky_irradiance(), without.sky_irradiance());
  for (std::size_t n = 0; n < with.node_count(); ++n)
    for (std::size_t z = 0; z < with.sky_directions().zenith_rad.size(); ++z)
      for (std::size_t a = 0; a < with.sky_directions().azimuth_rad.size(); ++a)
        EXPECT_EQ(with.sky(z, a, n), without.sky(z, a, n));
}

TEST_F(PolarizedAtmosphere, LightCanBeAndEmissionIsUnpolarized) {
  const SensorAtmosphere air = build(wide_);
  const radiometry::SpectralNodes& nodes = air.nodes();
  double most = 0.0;
  for (std::size_t n = 0; n < air.node_count(); ++n)
    for (std::size_t z = 0; z < air.sky_directions().zenith_rad.size(); ++z)
      for (std::size_t a = 0; a < air.sky_directions().azimuth_rad.size(); ++a) {
        const StokesVector light = air.sky_stokes(z, a, n);
        EXPECT_LE(degree_of_linear_polarization(light), 1.0 + 1e-12);
        if (n < nodes.first_node(2)) most = std::max(most, degree_of_linear_polarization(light));
        // The little sunlight at 10 um is nothing beside what the air emits.
        if (n >= nodes.first_node(2)) {
          EXPECT_LT(degree_of_linear_polarization(light), 1e-3);
        }
      }
  EXPECT_GT(most, 0.3);
}

TEST_F(PolarizedAtmosphere, OtherSideOfTheSunsPlane) {
  const std::vector<radiometry::Channel> blue{radiometry::Channel::gaussian("", 0.45, 0.02)};
  inputs_.geometry.view_zenith_rad = 30.0 * kDegree;
  inputs_.geometry.view_azimuth_rad = 80.0 * kDegree;
  const SensorAtmosphere left = build(blue);
  inputs_.geometry.view_azimuth_rad = -80.0 * kDegree;
  const SensorAtmosphere right = build(blue);
  for (std::size_t n = 0; n < left.node_count(); ++n) {
    EXPECT_NEAR(left.line_of_sight_polarization(0).q[n], right.line_of_sight_polarization(0).q[n],
                1e-9 * left.view_radiance()[n]);
    EXPECT_NEAR(left.line_of_sight_polarization(0).u[n], right.line_of_sight_polarization(0).u[n],
                1e-9 * left.view_radiance()[n]);
  }
}

TEST_F(PolarizedAtmosphere, KeptSolutionsAreFoundAgainAndNotMixedUp) {
  const std::vector<radiometry::Channel> blue{radiometry::Channel::gaussian("", 0.45, 0.02)};
  Memory memory;
  inputs_.kept = &memory;
  const SensorAtmosphere first = build(blue);
  EXPECT_EQ(memory.found, 0);
  inputs_.polarized = false;
  build(blue);
  EXPECT_EQ(memory.found, 0) << "an answer without Q and U is another one";
  inputs_.polarized = true;
  const SensorAtmosphere again = build(blue);
  EXPECT_GT(memory.found, 0);
  expect_same(first.line_of_sight_polarization(0).q, again.line_of_sight_polarization(0).q);
  expect_same(first.line_of_sight_polarization(0).u, again.line_of_sight_polarization(0).u);
  for (std::size_t n = 0; n < first.node_count(); ++n) {
    EXPECT_EQ(first.sky_stokes(5, 7, n).q, again.sky_stokes(5, 7, n).q);
    EXPECT_EQ(first.sky_stokes(5, 7, n).u, again.sky_stokes(5, 7, n).u);
  }
}

TEST_F(PolarizedAtmosphere, NightAndScalarSolver) {
  inputs_.geometry.sun_zenith_rad.reset();
  const SensorAtmosphere night = build({wide_[2]});
  for (std::size_t n = 0; n < night.node_count(); ++n) EXPECT_EQ(night.sky_stokes(5, 7, n).q, 0.0);
  inputs_.scattering.polarized = false;
  EXPECT_THROW(build({wide_[2]}), std::invalid_argument);
}

}  // namespace
}  // namespace ifov::atmosphere::test_polarized_atmosphere
