#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "atmosphere/column_maker.h"
#include "atmosphere/scattering/shell_line_of_sight.h"
#include "atmosphere/scattering/shell_orders.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/spherical_shells.h"
#include "atmosphere/thermal/thermal_column.h"

namespace test_shell_line_of_sight {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

const std::vector<double> kFalling = {60.0, 30.0, 12.0, 5.0, 2.0, 0.5, 0.0};

/// Depth of a beam through layers (falling altitudes), by small steps; infinite through the Earth.
double stepped_depth(const std::vector<double>& falling_km, const std::vector<double>& layer_depth,
                     double altitude_km, double sun_mu) {
  const double radius = kEarthRadius_km + altitude_km;
  double depth = 0.0;
  constexpr double kStep = 0.05;
  for (double s = 0.5 * kStep;; s += kStep) {
    const double z = std::sqrt(radius * radius + s * (s + 2.0 * radius * sun_mu)) - kEarthRadius_km;
    if (z < 0.0) return HUGE_VAL;
    if (z > falling_km.front()) return depth;
    std::size_t k = 0;
    while (z < falling_km[k + 1]) ++k;
    depth += kStep * layer_depth[k] / (falling_km[k] - falling_km[k + 1]);
  }
}

}  // namespace

TEST(ShellLineOfSight, IsAsLongAsItsShellsAreApart) {
  for (const double mu : {1.0, 0.5, 0.1, 0.0}) {
    const ShellLineOfSight up(kFalling, true, 0.5, {-mu, 0.7}, {1.0, 60.0}),
        down(kFalling, true, 0.5, {mu, 0.7}, {1.0, 60.0});
    double length = 0.0;
    for (const ShellLineOfSight::Piece& piece : up.pieces())
      length += piece.slant * (kFalling[piece.layer] - kFalling[piece.layer + 1]);
    EXPECT_NEAR(length, length_to_shell_km(1.0, mu, 60.0), 1e-9) << mu;
    if (mu == 0.0) continue;
    ASSERT_EQ(up.pieces().size(), down.pieces().size());
    EXPECT_EQ(up.pieces().front().slant, down.pieces().back().slant) << "the observer is at the other end";
    EXPECT_EQ(down.pieces().front().near_position, 0.0);
  }
}

TEST(ShellLineOfSight, SunlightComesToEveryPlaceByItsOwnAngle) {
  const Column column = [] {
    Air air;
    air.rayleigh = 1.0;
    air.aerosol = air.aerosol_absorption = 0.0;
    return air.column();
  }();
  std::vector<double> falling(column.levels.altitude_km.rbegin(), column.levels.altitude_km.rend());
  std::vector<double> depth(column.optics.rayleigh_scattering.rbegin(),
                            column.optics.rayleigh_scattering.rend());
  for (const double sun_deg : {30.0, 80.0, 89.5, 93.0})
    for (const double azimuth : {0.0, 2.0}) {
      const ShellLineOfSight line(falling, true, std::cos(sun_deg * kDegree),
                                  {-std::cos(85.0 * kDegree), azimuth}, {0.0, 60.0});
      const std::vector<double> beams = line.beam_depths(depth);
      double z = 0.0;
      for (std::size_t p = 0; p < line.pieces().size(); ++p) {
        const ShellLineOfSight::Piece& piece = line.pieces()[p];
        const double top = falling[piece.layer], height = top - falling[piece.layer + 1];
        z = top - piece.near_position * height;
        if (!piece.lit || (p > 0 && !line.pieces()[p - 1].lit)) continue;
        const double expected = stepped_depth(falling, depth, z, line.sun_mu()[p]);
        if (expected > 20.0) continue;
        EXPECT_NEAR(beams[p], expected, 2e-3 * expected + 1e-4) << sun_deg << " " << azimuth << " " << z;
      }
      // A light that comes from the Sun's side is seen towards the Sun.
      EXPECT_EQ(line.sun_mu().back() > line.sun_mu().front(), azimuth == 0.0) << sun_deg << " " << azimuth;
    }
}

TEST(ShellLineOfSight, TheEarthCastsItsShadow) {
  // Straight up with the Sun at -4 degrees the shadow ends at R (1/cos 4 - 1).
  const double sun = 94.0 * kDegree, edge = kEarthRadius_km * (1.0 / std::cos(4.0 * kDegree) - 1.0);
  const ShellLineOfSight line(kFalling, true, std::cos(sun), {-1.0, 0.0}, {0.0, 60.0});
  double dark = 0.0;
  bool was_lit = false;
  for (const ShellLineOfSight::Piece& piece : line.pieces()) {
    if (!piece.lit) dark += piece.slant * (kFalling[piece.layer] - kFalling[piece.layer + 1]);
    EXPECT_TRUE(piece.lit || !was_lit) << "dark above lit air";
    was_lit = piece.lit;
  }
  EXPECT_NEAR(dark, edge, 1e-6);
  const ShellLineOfSight day(kFalling, true, 0.01, {-0.1, 0.0}, {0.0, 60.0});
  for (const ShellLineOfSight::Piece& piece : day.pieces()) EXPECT_TRUE(piece.lit);
}

TEST(ShellLineOfSight, ThermalLinesOfSightPassTheSameShells) {
  const std::vector<double> rising(kFalling.rbegin(), kFalling.rend()),
      depth = {0.1, 0.2, 0.3, 0.2, 0.1, 0.02}, planck(rising.size(), 3.0);
  const ThermalColumn air(rising, planck, depth);
  for (const double zenith_deg : {0.0, 60.0, 80.0, 89.0}) {
    const double mu = std::cos(zenith_deg * kDegree), height = 0.8, sensor = 20.0;
    const std::vector<double> slants = view_slants(rising, {zenith_deg * kDegree, 0.0, height, sensor}, true);
    const double through = std::exp(-std::inner_product(depth.begin(), depth.end(), slants.begin(), 0.0));
    const ThermalPath path = air.line_of_sight(sensor, mu, height);
    EXPECT_NEAR(path.transmittance, through, 1e-12);
    EXPECT_NEAR(path.radiance, 3.0 * (1.0 - through), 1e-12) << "air of one temperature";
    const ShellLineOfSight line(kFalling, true, 1.0, {mu, 0.0}, {height, sensor}, false);
    double along = 0.0;
    for (const ShellLineOfSight::Piece& piece : line.pieces())
      along += piece.slant * depth[depth.size() - 1 - piece.layer];
    EXPECT_NEAR(std::exp(-along), through, 1e-12);
  }
  // Warmer air below: what is seen from above is nearer to the cold, from the ground of flat air the same.
  const std::vector<double> cooling = {5.0, 4.8, 4.0, 3.0, 2.0, 1.0, 0.5};
  const ThermalColumn layered(rising, cooling, depth);
  EXPECT_NEAR(layered.line_of_sight(100.0, 1.0, 0.0).radiance, layered.path(100.0, 1.0).radiance, 1e-12);
  EXPECT_LT(layered.path(100.0, 0.05).transmittance, layered.line_of_sight(100.0, 0.05, 0.0).transmittance);
}

TEST(ShellOrders, FlatOnesAreTheColumnsMeanRadiance) {
  Air air;
  air.rayleigh = 0.2;
  air.aerosol = air.aerosol_absorption = 0.0;
  const Column column = air.column();
  ScatteringOptions options;
  options.polarized = false;
  const double sun = 50.0 * kDegree;
  const ColumnSolution solution = ColumnSolver(options).solve(column.levels, column.optics, sun);
  const ScatteringColumn& layers = solution.sunlit().solved().column;
  const double suns[] = {sun};
  const ShellOrders flat(layers, {false, false}, suns, 0, {12, 3, 1e9});
  // The moment l = 0 holds half the sum over both hemispheres times 2.
  const ModeMoments& moments = solution.sunlit().modes().front();
  for (std::size_t z = 0; z < flat.altitude_km().size(); ++z) {
    if (flat.altitude_km()[z] > 20.0) continue;
    std::size_t level = 0;
    while (layers.altitude_km[level] > flat.altitude_km()[z] + 1e-9) ++level;
    EXPECT_NEAR(std::exp(flat.log_mean()[z]) / (0.5 * moments.at(0, 0)[level]), 1.0, 0.02)
        << flat.altitude_km()[z];
  }
}

}  // namespace test_shell_line_of_sight
