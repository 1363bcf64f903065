// Lines of sight between those that are solved, against solutions of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere::test_line_of_sight_grid {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kPi = std::numbers::pi;

class LinesOfSight : public testing::Test {
 protected:
  LinesOfSight() {
    scattering_.nodes_per_hemisphere = 6;
    geometry_.sun_zenith_rad = 40.0 * kDegree;
    geometry_.sensor_altitude_km = 6.0;
    for (const double um : {0.45, 0.86, 0.762})
      channels_.push_back(radiometry::Channel::gaussian("", um, 0.004));
    channels_.push_back(radiometry::Channel::gaussian("", 10.0, 0.3));
  }
  SensorAtmosphere build(std::optional<LineOfSightGrid> lines_of_sight,
                         const SensorGeometry& geometry) const {
    SensorAtmosphere::Inputs inputs;
    inputs.channels = channels_;
    inputs.solar_irradiance = radiometry::solar_irradiance_1au();
    inputs.geometry = geometry;
    inputs.scattering = scattering_;
    inputs.lines_of_sight = std::move(lines_of_sight);
    inputs.demands.tolerance = 1e-3;
    inputs.demands.most_nodes = 8;
    inputs.with_errors = errors_;
    inputs.ground = radiometry::Spectrum::constant(0.2);
    return SensorAtmosphere(column_, inputs);
  }
  struct Seen {
    double through = 0.0, added = 0.0, groundlit = 0.0;
  };
  /// Of a channel: sunlight from white ground let through, path radiance, light from bright ground around.
  Seen seen(const SensorAtmosphere& air, std::size_t channel, const std::vector<double>& weight) const {
    Seen sum;
    const radiometry::SpectralNodes& nodes = air.nodes();
    for (std::size_t n = nodes.first_node(channel); n < nodes.first_node(channel + 1); ++n) {
      const double light = air.sun_irradiance()[n] + air.sky_irradiance()[n];
      for (std::size_t line = 0; line < weight.size(); ++line) {
        const SensorAtmosphere::LightAlongLine line_of_sight = air.line_of_sight(line);
        sum.through += nodes.node_weight(n) * weight[line] * light * line_of_sight.transmittance[n];
        sum.added += nodes.node_weight(n) * weight[line] * line_of_sight.radiance[n];
        sum.groundlit += nodes.node_weight(n) * weight[line] * light * line_of_sight.diffuse_transmittance[n];
      }
    }
    return sum;
  }

  AtmosphereColumn column_{AtmosphereDescription{}};
  SensorGeometry geometry_;
  ScatteringOptions scattering_;
  bool errors_ = true;
  std::vector<radiometry::Channel> channels_;
  SensorAltitudes altitudes_{6.0, 6.0};
  LineOfSightRange range_{-0.55, 0.5, 0.0, 0.45, 0.0};
};

TEST_F(LinesOfSight, BetweenTheSolvedDirections) {
  const SensorAtmosphere air = build(LineOfSightGrid(range_, column_.levels(), altitudes_), geometry_);
  double planted = 0.0;
  for (const LineOfSight line : {LineOfSight{0.0, 0.0, 0.0},
                                 {14.0 * kDegree, 70.0 * kDegree, 0.0},
                                 {26.0 * kDegree, 5.0 * kDegree, 0.0},
                                 {24.0 * kDegree, 165.0 * kDegree, 0.0}}) {
    SensorGeometry own = geometry_;
    own.view_zenith_rad = line.zenith_rad;
    own.view_azimuth_rad = line.azimuth_rad;
    const SensorAtmosphere right = build({}, own);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const Seen found = seen(air, c, air.lines_of_sight().weights(line)), expected = seen(right, c, {1.0}),
                 middle = seen(air, c, air.lines_of_sight().weights(LineOfSight{}));
      EXPECT_NEAR(found.added / expected.added, 1.0, 1.5e-3) << c << " " << line.zenith_rad;
      if (expected.groundlit > 0.0) {
        EXPECT_NEAR(found.through / expected.through, 1.0, 1.5e-3) << c << " " << line.zenith_rad;
        EXPECT_NEAR(found.groundlit / expected.groundlit, 1.0, 3e-3) << c << " " << line.zenith_rad;
      }
      // The planted fault: the nadir for all.
      if (c == 0 && line.zenith_rad > 0.3) {
        planted = std::max(planted, std::abs(middle.added / expected.added - 1.0));
        EXPECT_GT(std::abs(middle.through / expected.through - 1.0), 0.03) << line.azimuth_rad;
      }
    }
  }
  EXPECT_GT(planted, 0.02);
}

// At single wavelengths, from surfaces above the ground, against the solver itself.
TEST_F(LinesOfSight, AboveTheGround) {
  channels_ = {radiometry::Channel::monochromatic("", 0.45), radiometry::Channel::monochromatic("", 0.86)};
  range_.highest_km = 1.6;
  const SensorAtmosphere air = build(LineOfSightGrid(range_, column_.levels(), altitudes_), geometry_);
  const ColumnSolver solver([] {
    ScatteringOptions options;
    options.nodes_per_hemisphere = 6;
    return options;
  }());
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const double um = channels_[c].centre_um, sun = radiometry::solar_irradiance_1au().at(um);
    const LayerOptics layers = column_.at(5.0 * std::round(1e4 / um / 5.0)).term(0);
    const ColumnSolution solved = solver.solve(column_.levels(), layers, *geometry_.sun_zenith_rad);
    for (const LineOfSight line : {LineOfSight{5.0 * kDegree, 40.0 * kDegree, 0.6},
                                   {22.0 * kDegree, 120.0 * kDegree, 1.1},
                                   {16.0 * kDegree, 10.0 * kDegree, 0.18}}) {
      const double mu = std::cos(line.zenith_rad);
      const PathLight path = solved.sunlit().line_of_sight({mu, line.azimuth_rad - kPi}, 6.0, line.height_km);
      const std::vector<double> weight = air.lines_of_sight().weights(line);
      double through = 0.0, added = 0.0;
      for (std::size_t k = 0; k < weight.size(); ++k) {
        through += weight[k] * air.line_of_sight(k).transmittance[c];
        added += weight[k] * air.line_of_sight(k).radiance[c];
      }
      EXPECT_NEAR(through / path.transmittance, 1.0, 1.5e-3) << um << " " << line.height_km;
      EXPECT_NEAR(added / (sun * path.radiance().i), 1.0, 6e-3) << um << " " << line.height_km;
      const double error = air.errors()[c].lines_of_sight.path;
      EXPECT_LE(std::abs(added - sun * path.radiance().i), 1.5 * error + 1e-3 * added)
          << um << " " << line.height_km;
      if (line.height_km > 0.5) {  // the planted fault: the ground for all
        EXPECT_GT(std::abs(air.line_of_sight(0).transmittance[c] / path.transmittance - 1.0), 0.03);
      }
      // Light that comes down there.
      const std::vector<double> by_height = air.lines_of_sight().height().weights(line.height_km);
      double beam = 0.0, sky = 0.0;
      for (std::size_t h = 0; h < by_height.size(); ++h) {
        beam += by_height[h] * air.sun_at_height(h)[c];
        sky += by_height[h] * air.sky_at_height(h)[c];
      }
      EXPECT_NEAR(beam / (sun * solved.sun_transmittance(line.height_km)), 1.0, 2e-3);
      EXPECT_NEAR(sky / (sun * solved.sunlit().fluxes().at(line.height_km).diffuse_down), 1.0, 6e-3);
    }
  }
}

// Straight down under any Sun but a low one a round Earth is a flat one, in every channel.
TEST_F(LinesOfSight, PathsUnderHighSunsAreThoseOfFlatLayers) {
  errors_ = false;
  channels_.clear();
  for (const double um : {0.45, 0.86, 1.65, 2.2, 3.85})
    channels_.push_back(radiometry::Channel::monochromatic("", um));
  geometry_.sensor_altitude_km = kTopOfAtmosphereKm;
  for (const double sun : {0.0, 20.0, 24.0, 60.0}) {
    geometry_.sun_zenith_rad = sun * kDegree;
    scattering_.spherical_earth = false;
    const SensorAtmosphere flat = build({}, geometry_);
    scattering_.spherical_earth = true;
    const SensorAtmosphere round = build({}, geometry_);
    for (std::size_t c = 0; c < channels_.size(); ++c)
      EXPECT_NEAR(seen(round, c, {1.0}).added / seen(flat, c, {1.0}).added, 1.0, 0.01) << sun << " " << c;
  }
}

// An aeroplane at dusk: the air below it lies in the Earth's shadow, or is lit through so much oxygen that hardly any light is left to be
// scattered once, by which the rest was told. It darkens with the Sun, and is darker than all of the air.
TEST_F(LinesOfSight, PathsAtDuskDarken) {
  errors_ = false;
  channels_ = {radiometry::Channel::gaussian("", 0.762, 0.004), radiometry::Channel::monochromatic("", 0.55)};
  std::vector<double> last(channels_.size(), 1e300);
  for (const double sun : {88.0, 90.0, 92.0, 94.0}) {
    geometry_.sun_zenith_rad = sun * kDegree;
    geometry_.sensor_altitude_km = 10.0;
    const SensorAtmosphere air = build({}, geometry_);
    geometry_.sensor_altitude_km = kTopOfAtmosphereKm;
    const SensorAtmosphere whole = build({}, geometry_);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const double path = seen(air, c, {1.0}).added;
      EXPECT_GT(path, 0.0) << sun << " " << c;
      EXPECT_LT(path, 0.95 * last[c]) << sun << " " << c;
      EXPECT_LT(path, seen(whole, c, {1.0}).added) << sun << " " << c;
      last[c] = path;
    }
  }
}

// Ozone above a sensor dims nothing of what the ground sends there: told by all gas, scattered light of the ground came out 1e14
// times what it is.
TEST_F(LinesOfSight, GasAboveTheSensorDimsNothingBelowIt) {
  errors_ = false;
  channels_ = {radiometry::Channel::gaussian("", 9.6, 0.3), radiometry::Channel::gaussian("", 8.5, 0.2)};
  for (const double view : {0.0, 79.0}) {
    geometry_.view_zenith_rad = view * kDegree;
    geometry_.sensor_altitude_km = 4.0;
    const SensorAtmosphere air = build({}, geometry_);
    geometry_.sensor_altitude_km = 4.3;
    const SensorAtmosphere higher = build({}, geometry_);
    for (std::size_t n = 0; n < air.node_count(); ++n) {
      EXPECT_LT(air.view_transmittance()[n] + air.diffuse_transmittance()[n], 1.0) << view;
      EXPECT_GE(air.diffuse_transmittance()[n], 0.0);
    }
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const Seen here = seen(air, c, {1.0}), there = seen(higher, c, {1.0});
      EXPECT_NEAR(there.groundlit / here.groundlit, 1.0, 0.1) << view << " " << c;
    }
  }
}

// The lowest 13 m of haze are a quarter percent of what a roof sends: more than an image needs that is asked for 1 %.
// Planted: roofs seen through all of the air that is over the ground.
TEST_F(LinesOfSight, RoofsHaveTheirOwn) {
  range_ = {0.0, 0.0, 0.0, 0.0, 0.013};
  const SensorAtmosphere air = build(LineOfSightGrid(range_, column_.levels(), altitudes_), geometry_);
  const Seen roof = seen(air, 0, air.lines_of_sight().weights(LineOfSight{0.0, 0.0, 0.013})),
             ground = seen(air, 0, air.lines_of_sight().weights(LineOfSight{}));
  const LayerOptics layers = column_.at(5.0 * std::round(1e4 / 0.45 / 5.0)).term(0);
  double below = 0.0;  // in the lowest layer
  for (const double part : {layers.gas_absorption.front(), layers.rayleigh_scattering.front(),
                            layers.aerosol_scattering.front(), layers.aerosol_absorption.front()})
    below += part;
  const std::vector<double>& levels_km = column_.levels().altitude_km;
  below *= 0.013 / (levels_km[1] - levels_km[0]);
  EXPECT_NEAR(roof.through / ground.through, std::exp(below), 3e-4);
  EXPECT_GT(roof.through / ground.through, 1.001);
  for (const AtmosphereErrors& errors : air.errors()) EXPECT_LT(errors.lines_of_sight.surface, 3e-4);
}

TEST_F(LinesOfSight, OfOneDirectionAreTheGeometrysOwn) {
  geometry_.view_zenith_rad = 12.0 * kDegree;
  geometry_.view_azimuth_rad = 50.0 * kDegree;
  const double along = std::tan(12.0 * kDegree) * std::cos(50.0 * kDegree),
               across = std::tan(12.0 * kDegree) * std::sin(50.0 * kDegree);
  const SensorAtmosphere air = build(
      LineOfSightGrid(LineOfSightRange{along, along, across, across, 0.0}, column_.levels(), altitudes_),
      geometry_);
  EXPECT_TRUE(air.lines_of_sight().trivial());
  for (std::size_t n = 0; n < air.node_count(); ++n)
    EXPECT_EQ(air.line_of_sight(0).transmittance[n], air.view_transmittance()[n]);
}

}  // namespace
}  // namespace ifov::atmosphere::test_line_of_sight_grid
