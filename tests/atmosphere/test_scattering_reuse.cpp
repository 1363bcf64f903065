#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "atmosphere/column_maker.h"
#include "atmosphere/scattering/multiple_scattering_table.h"

namespace test_scattering_reuse {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

struct GasProfile {
  double scale_km, low_km, high_km;
};
constexpr GasProfile kOzone{30.0, 15.0, 35.0}, kMixed{8.0, 0.0, 60.0}, kVapour{2.0, 0.0, 60.0},
    kDryVapour{1.6, 0.0, 60.0}, kBetween{5.0, 0.0, 60.0};
constexpr GasProfile kProfiles[] = {kOzone, kMixed, kVapour};

Column column_at(double wavelength_um, double gas, const GasProfile& profile) {
  Air air;
  const double haze = 0.25 * std::pow(0.55 / wavelength_um, 1.2);
  air.rayleigh = rayleigh_depth(wavelength_um);
  air.aerosol = 0.92 * haze;
  air.aerosol_absorption = 0.08 * haze;
  air.asymmetry = 0.68 - 0.04 * std::log(wavelength_um / 0.55);
  air.gas = gas;
  air.gas_scale_km = profile.scale_km;
  air.gas_low_km = profile.low_km;
  air.gas_high_km = profile.high_km;
  return air.column();
}

/// Path radiance upward, sky radiance, a path to an aircraft, diffuse irradiance, S and diffuse
/// transmittance.
std::vector<LightByOrder> quantities(const ColumnSolver& solver, const Levels& levels,
                                     const LayerOptics& optics, bool all_orders) {
  const double sun = 50.0 * kDegree;
  const ColumnSolution first = solver.solve_first_order(levels, optics, sun);
  const ColumnSolution whole = all_orders ? solver.solve(levels, optics, sun) : first;
  std::vector<LightByOrder> result;
  const auto path = [&](const Propagation& direction, double observer_km) {
    const PathLight light = whole.sunlit().path(direction, observer_km);
    result.push_back({light.single, light.multiple});
  };
  for (double azimuth : {0.0, 90.0, 180.0}) {
    for (double mu : {1.0, 0.6, 0.3}) path({mu, azimuth * kDegree}, 1e3);
    for (double mu : {-1.0, -0.5, -0.1}) path({mu, azimuth * kDegree}, 0.0);
  }
  path({0.9, 1.0}, 3.0);
  const auto number = [&](double all, double once) { result.push_back({{once, 0, 0}, {all - once, 0, 0}}); };
  number(whole.sunlit().fluxes().at(0.0).diffuse_down, first.sunlit().fluxes().at(0.0).diffuse_down);
  number(whole.spherical_albedo(), first.spherical_albedo());
  number(whole.diffuse_transmittance(0.9, 1e3).i, first.diffuse_transmittance(0.9, 1e3).i);
  return result;
}

class ScatteringReuse : public testing::Test {
 protected:
  static MultipleScatteringTable make(const MultipleScatteringTable::Nodes& nodes, int threads = 2) {
    const Levels levels = column_at(1.0, 0.0, kVapour).levels;
    const ColumnSolver solver;
    return MultipleScatteringTable(
        nodes,
        [](double um, double gas, std::size_t profile) {
          return column_at(um, gas, kProfiles[profile]).optics;
        },
        [&](double, const LayerOptics& optics) { return quantities(solver, levels, optics, true); }, threads);
  }
  static MultipleScatteringTable::Nodes nodes() {
    MultipleScatteringTable::Nodes result;
    for (int i = 0; i < 24; ++i) result.wavelength_um.push_back(0.38 * std::pow(2.5 / 0.38, i / 23.0));
    result.depth = {0.0, 0.02, 0.08, 0.25, 0.8, 2.5, 8.0};
    result.profiles = 3;
    return result;
  }

  /// Largest difference from full solutions, of I, Q and U, in units of the light without gas.
  static double worst_error(const MultipleScatteringTable& table, const GasProfile& profile,
                            bool placed = true, double ozone = 0.0) {
    const ColumnSolver solver;
    double worst = 0.0;
    for (double um : {0.405, 0.56, 0.76, 0.94, 1.9}) {
      const Column clear = column_at(um, 0.0, profile);
      const auto without_gas = quantities(solver, clear.levels, clear.optics, true);
      for (double gas : {0.05, 0.6, 6.0}) {
        Column column = column_at(um, gas, profile);
        const Column high = column_at(um, ozone, kOzone);
        for (std::size_t i = 0; i < column.optics.layers(); ++i) {
          column.optics.gas_absorption[i] += high.optics.gas_absorption[i];
        }
        const auto exact = quantities(solver, column.levels, column.optics, true);
        std::vector<StokesVector> first, total(exact.size());
        for (const auto& light : quantities(solver, column.levels, column.optics, false))
          first.push_back(light.first);
        GasPlacement placement = gas_placement(column.optics);
        if (!placed) placement.under = placement.under_square = 1.0;
        table.complete(um, placement, first, total);
        for (std::size_t k = 0; k < exact.size(); ++k) {
          const StokesVector light = exact[k].first + exact[k].rest;
          const double unit = without_gas[k].first.i + without_gas[k].rest.i;
          worst = std::max({worst, std::abs(total[k].i - light.i) / unit,
                            std::abs(total[k].q - light.q) / unit, std::abs(total[k].u - light.u) / unit});
        }
      }
    }
    return worst;
  }
};

}  // namespace

TEST_F(ScatteringReuse, AgreesWithFullSolutions) {
  const MultipleScatteringTable table = make(nodes());
  EXPECT_EQ(table.quantities(), 22u);
  const double vapour = worst_error(table, kVapour), mixed = worst_error(table, kMixed),
               ozone = worst_error(table, kOzone);
  RecordProperty("vapour", std::to_string(vapour));
  RecordProperty("mixed", std::to_string(mixed));
  RecordProperty("ozone", std::to_string(ozone));
  EXPECT_LT(vapour, 3e-3);
  EXPECT_LT(mixed, 3e-3);
  EXPECT_LT(ozone, 6e-3);
  // Profiles that are not nodes.
  EXPECT_LT(worst_error(table, kBetween), 0.012);
  EXPECT_LT(worst_error(table, kDryVapour), 0.025);
  EXPECT_LT(worst_error(table, kVapour, true, 0.1), 0.012) << "with ozone";
  // The planted fault: all gas is taken for water vapour.
  EXPECT_GT(worst_error(table, kOzone, false), 0.02);
}

TEST_F(ScatteringReuse, NodesAreExactAndThreadsDoNotMatter) {
  MultipleScatteringTable::Nodes few;
  few.wavelength_um = {0.5, 0.9};
  few.depth = {0.0, 0.3, 2.0};
  few.profiles = 3;
  const MultipleScatteringTable one = make(few, 1), two = make(few, 4);
  const ColumnSolver solver;
  const Column column = column_at(0.5, 0.3, kMixed);
  const auto exact = quantities(solver, column.levels, column.optics, true);
  std::vector<StokesVector> first, a(exact.size()), b(exact.size());
  for (const auto& light : exact) first.push_back(light.first);
  one.complete(0.5, gas_placement(column.optics), first, a);
  two.complete(0.5, gas_placement(column.optics), first, b);
  for (std::size_t k = 0; k < exact.size(); ++k) {
    EXPECT_NEAR(a[k].i, exact[k].first.i + exact[k].rest.i, 1e-10 * a[k].i);
    EXPECT_NEAR(a[k].q, exact[k].first.q + exact[k].rest.q, 1e-10 * a[k].i);
    EXPECT_EQ(a[k].i, b[k].i);
  }
}

TEST_F(ScatteringReuse, GasIsPlacedByTheScatterersAboveIt) {
  const auto under = [](const GasProfile& profile) {
    return gas_placement(column_at(0.5, 0.7, profile).optics).under;
  };
  EXPECT_LT(under(kOzone), 0.2);
  EXPECT_GT(under(kMixed), under(kOzone) + 0.1);
  EXPECT_LT(under(kMixed), under(kVapour));
  EXPECT_LT(under(kVapour), 1.0);
  EXPECT_NEAR(gas_placement(column_at(0.5, 0.7, kMixed).optics).depth, 0.7, 1e-12);
  EXPECT_EQ(gas_placement(column_at(0.5, 0.0, kMixed).optics).depth, 0.0);
}

TEST_F(ScatteringReuse, RefusesWhatDoesNotFit) {
  MultipleScatteringTable::Nodes bad;
  bad.wavelength_um = {0.5};
  bad.depth = {0.0, 1.0};
  EXPECT_THROW(make(bad), std::invalid_argument);
  bad.wavelength_um = {0.5, 0.4};
  EXPECT_THROW(make(bad), std::invalid_argument);
  bad.wavelength_um = {0.5, 0.6};
  bad.depth = {0.1, 1.0};
  EXPECT_THROW(make(bad), std::invalid_argument);
}

}  // namespace test_scattering_reuse
