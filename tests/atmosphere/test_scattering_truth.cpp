#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "atmosphere/column_maker.h"
#include "support/truth_data.h"

namespace test_scattering_truth {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

/// Lines of numbers, separated by commas or blanks; other lines are left out.
std::vector<std::vector<double>> read_numbers(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream stream(line);
    std::vector<double> row;
    for (double value; stream >> value;) row.push_back(value);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

constexpr const char* kNatraj = "atmosphere/rayleigh_polarized/coulson_natraj_tau0.5_mu0_0.2.csv";
constexpr const char* kSos = "atmosphere/derived/rayleigh_vector_sos.csv";

struct Worst {
  double i = 0.0, q = 0.0, u = 0.0, relative = 0.0;
};

Worst against_natraj(const ScatteringOptions& options) {
  const Column column = rayleigh_layer(0.5);
  const ColumnSolution solution = ColumnSolver(options).solve(column.levels, column.optics, std::acos(0.2));
  Worst worst;
  int rows = 0;
  for (const auto& row : read_numbers(*ifov::test::truth_file(kNatraj))) {
    if (row.size() != 6) continue;
    ++rows;
    const StokesVector light =
        std::numbers::pi * light_with_ground(solution, {row[1], row[2] * kDegree}, row[0]);
    worst.i = std::max(worst.i, std::abs(light.i - row[3]));
    worst.q = std::max(worst.q, std::abs(-light.q - row[4]));  // the table has the other sign of Q
    worst.u = std::max(worst.u, std::abs(light.u - row[5]));
    worst.relative = std::max(worst.relative, std::abs(light.i / row[3] - 1.0));
  }
  EXPECT_EQ(rows, 12);
  return worst;
}

}  // namespace

TEST(ScatteringTruth, NatrajTwelveDirections) {
  if (!ifov::test::truth_file(kNatraj)) GTEST_SKIP() << "reference data not found: " << kNatraj;
  const Worst vector = against_natraj(flat(16, 0.0025));
  RecordProperty("worst_i", std::to_string(vector.i));
  EXPECT_LT(vector.i, 1e-4);
  EXPECT_LT(vector.q, 1e-4);
  EXPECT_LT(vector.u, 1e-4);
  const Worst scalar = against_natraj(flat(16, 0.0025, false));
  RecordProperty("scalar_relative", std::to_string(scalar.relative));
  EXPECT_NEAR(scalar.relative, 0.100, 0.005) << "the scalar answer is wrong by 10 %";
  EXPECT_GT(scalar.i, 5e-3) << "the scalar answer passes for the vector one";
}

TEST(ScatteringTruth, NatrajWithTheDefaultOptions) {
  if (!ifov::test::truth_file(kNatraj)) GTEST_SKIP() << "reference data not found: " << kNatraj;
  ScatteringOptions options;
  options.spherical_earth = false;
  options.most_sublayers = 60;  // all of the air in one layer
  const Worst vector = against_natraj(options);
  EXPECT_LT(vector.relative, 1.5e-3);  // at 89 degrees from the zenith; below 3e-4 elsewhere
}

TEST(ScatteringTruth, FourHundredAndEightyDirections) {
  const auto file = ifov::test::truth_file(kSos);
  if (!file) GTEST_SKIP() << "reference data not found: " << kSos;
  Worst worst, scalar_worst;
  int rows = 0;
  double depth = 0.0, mu0 = 0.0;
  std::vector<ColumnSolution> solutions;
  for (const auto& row : read_numbers(*file)) {
    if (row.size() != 9) continue;
    ++rows;
    if (row[0] != depth || row[1] != mu0) {
      depth = row[0];
      mu0 = row[1];
      solutions.clear();
      const Column column = rayleigh_layer(depth);
      for (bool polarized : {true, false}) {
        const ColumnSolver solver(flat(12, 0.005, polarized));
        solutions.push_back(solver.solve(column.levels, column.optics, std::acos(mu0)));
      }
    }
    const Propagation direction{row[3], row[4] * kDegree};
    const StokesVector light = std::numbers::pi * light_with_ground(solutions[0], direction, row[2]);
    const StokesVector scalar = std::numbers::pi * light_with_ground(solutions[1], direction, row[2]);
    worst.i = std::max(worst.i, std::abs(light.i - row[5]));
    worst.q = std::max(worst.q, std::abs(light.q - row[6]));
    worst.u = std::max(worst.u, std::abs(light.u - row[7]));
    scalar_worst.i = std::max(scalar_worst.i, std::abs(scalar.i - row[8]));
  }
  EXPECT_EQ(rows, 480);
  RecordProperty("worst_i", std::to_string(worst.i));
  EXPECT_LT(worst.i, 2e-4);
  EXPECT_LT(worst.q, 2e-4);
  EXPECT_LT(worst.u, 2e-4);
  EXPECT_LT(scalar_worst.i, 2e-4) << "our scalar answer against theirs";
}

TEST(ScatteringTruth, IprtCaseB2SingleScattering) {
  const auto layers = ifov::test::truth_file("atmosphere/rayleigh_polarized/iprt_b2_tau_ssa.txt");
  const auto lights =
      ifov::test::truth_file("atmosphere/rayleigh_polarized/iprt_b2_ipol_single_scattering.txt");
  if (!layers || !lights) GTEST_SKIP() << "reference data not found: atmosphere/rayleigh_polarized/iprt_b2_*";
  Column column;
  auto rows = read_numbers(*layers);
  std::reverse(rows.begin(), rows.end());
  for (const auto& row : rows) {
    column.add_layer(column.levels.altitude_km.empty() ? 1.0 : column.levels.altitude_km.back() + 1.0,
                     row[0] * row[1], 0.0, 0.0, row[0] * (1.0 - row[1]));
  }
  const auto worst_with = [&](double depolarization) {
    column.optics.depolarization = depolarization;
    const ScatteringColumn sunlit(column.levels, column.optics, 60.0 * kDegree, flat(8, 1.0));
    double worst = 0.0;
    int directions = 0;
    for (const auto& row : read_numbers(*lights)) {
      // Their mu counts downward propagation as positive.
      if (row.size() != 9 || std::abs(row[4]) < 0.01) continue;
      ++directions;
      const Propagation direction{std::cos(row[3] * kDegree), row[2] * kDegree};
      const StokesVector light =
          single_scattering(sunlit, 0.0, direction, direction.mu > 0.0 ? 1e3 : 0.0).single;
      worst = std::max({worst, std::abs(light.i - row[5]) / row[5], std::abs(light.q - row[6]) / row[5],
                        std::abs(light.u + row[7]) / row[5]});  // U of Hovenier and van der Mee
    }
    EXPECT_GT(directions, 1000);
    return worst;
  };
  EXPECT_LT(worst_with(0.03), 2e-5);
  EXPECT_GT(worst_with(0.0), 5e-3) << "dipoles without depolarization pass";
}

TEST(ScatteringTruth, PolradtranSky) {
  const auto file = ifov::test::truth_file("atmosphere/libradtran/POLRADTRAN.OUT");
  if (!file) GTEST_SKIP() << "reference data not found: atmosphere/libradtran/POLRADTRAN.OUT";
  // Sky over ground of albedo 0.2 at 350 nm, sun zenith 32 degrees, 8 streams; the solar spectrum is not in
  // the file, so radiances are divided by the irradiance, which ours and theirs have in common. Ozone is left
  // out (0.4 % of a vertical path), and 8 streams miss 0.3 % of the flux: their own upward flux is 0.2006 of
  // it.
  Air air;
  air.rayleigh = rayleigh_depth(0.35);
  air.aerosol = air.aerosol_absorption = 0.0;
  Column column = air.column();
  column.optics.depolarization = 0.0303;
  const auto solve = [&](bool polarized) {
    return ColumnSolver(flat(8, 0.01, polarized)).solve(column.levels, column.optics, 32.0 * kDegree);
  };
  const auto rows = read_numbers(*file);
  std::vector<std::vector<double>> lights;
  for (const auto& row : rows) {
    if (row.size() == 5 && row[0] < 0.0) lights.push_back(row);
  }
  ASSERT_EQ(lights.size(), 12u);  // three directions of I, Q, U, V
  const double their_irradiance = rows.front()[1];
  const auto worst = [&](const ColumnSolution& solution) {
    const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(0.0);
    const double irradiance =
        (fluxes.direct_down + fluxes.diffuse_down) / (1.0 - 0.2 * solution.spherical_albedo());
    double result = 0.0;
    for (int direction = 0; direction < 3; ++direction) {
      for (int azimuth = 0; azimuth < 3; ++azimuth) {
        const StokesVector light =
            their_irradiance / irradiance *
            light_with_ground(solution, {lights[direction][0], azimuth * 90.0 * kDegree}, 0.2);
        const double i = lights[direction][2 + azimuth];
        result = std::max({result, std::abs(light.i - i) / i,
                           std::abs(light.q - lights[3 + direction][2 + azimuth]) / i,
                           std::abs(light.u - lights[6 + direction][2 + azimuth]) / i});
      }
    }
    return result;
  };
  EXPECT_LT(worst(solve(true)), 0.006);
  EXPECT_GT(worst(solve(false)), 0.05) << "the scalar answer passes for the vector one";
}

}  // namespace test_scattering_truth
