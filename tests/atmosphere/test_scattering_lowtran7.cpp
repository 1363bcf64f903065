#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "lowtran_output.h"
#include "support/truth_data.h"

// Runs of the original program: nadir from 100 km, rural haze of 23 km visibility, Sun 45 degrees from the
// zenith, ground of albedo 0.2. Everything is divided by sunlight that the ground reflects straight to the
// sensor, which takes the solar spectrum out. The program has phase functions of its own for aerosol, and two
// streams for light scattered more than once.
namespace ifov::atmosphere::test_scattering_lowtran7 {
namespace {

constexpr double kAlbedo = 0.2;

struct Nadir {
  double single = 0.0, ground = 0.0;  ///< in units of direct light from the ground
};

class ScatteringLowtran7 : public testing::Test {
 protected:
  void SetUp() override {
    if (!ifov::test::truth_file("atmosphere/lowtran7"))
      GTEST_SKIP() << "reference data not found: atmosphere/lowtran7";
  }

  Nadir nadir(double wavenumber_cm1) const {
    const ColumnOptics optics = column_.at(wavenumber_cm1);
    Nadir sum;
    double direct = 0.0;
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const ColumnSolution solution =
          solver_.solve(column_.levels(), optics.term(term), 0.25 * std::numbers::pi);
      const PathLight path = solution.sunlit().path({1.0, 0.0}, 200.0);
      const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(0.0);
      const double all =
          (fluxes.direct_down + fluxes.diffuse_down) / (1.0 - kAlbedo * solution.spherical_albedo());
      const double reflected = optics.weight(term) * kAlbedo / std::numbers::pi * path.transmittance;
      direct += reflected * fluxes.direct_down;
      sum.ground += reflected * all;
      sum.single += optics.weight(term) * path.single.i;
    }
    return {sum.single / direct, sum.ground / direct};
  }

  /// Rows with wavenumber, transmittance, thermal, path, single, ground, direct ... at every 600 cm-1.
  static std::vector<std::vector<double>> rows(const std::string& file, double from_cm1, double to_cm1) {
    std::vector<std::vector<double>> result;
    for (const auto& row :
         ifov::test::numeric_rows(*ifov::test::truth_file("atmosphere/lowtran7/" + file), 9)) {
      if (row[0] >= from_cm1 && row[0] <= to_cm1 && std::fmod(row[0], 600.0) == 0.0) result.push_back(row);
    }
    EXPECT_GT(result.size(), 4u);
    return result;
  }

 private:
  static AtmosphereDescription description() {
    AtmosphereDescription result;
    result.air.co2_ppm = result.air.ch4_ppm = result.air.n2o_ppm = std::nullopt;
    result.gas_model = GasModel::lowtran7;
    return result;
  }
  AtmosphereColumn column_{description()};
  ColumnSolver solver_;
};

}  // namespace

TEST_F(ScatteringLowtran7, LightScatteredOnce) {
  const std::string file = "E_MLS_rural23_nadir100km_sun45_singlescat_albedo0p2.tape7.txt";
  // Where molecules scatter most of it.
  for (const auto& row : rows(file, 24000.0, 30600.0)) {
    EXPECT_NEAR(nadir(row[0]).single / (row[4] / row[6]), 1.0, 0.01) << row[0];
  }
  // Haze takes part, and its phase function at 135 degrees is not the program's.
  for (const auto& row : rows(file, 11400.0, 24000.0)) {
    EXPECT_NEAR(nadir(row[0]).single / (row[4] / row[6]), 1.0, 0.05) << row[0];
  }
}

TEST_F(ScatteringLowtran7, LightThatReachesTheGround) {
  const std::string file = "Em_MLS_rural23_nadir100km_sun45_multscat_albedo0p2.tape7.txt";
  for (const auto& row : rows(file, 15000.0, 30000.0)) {
    const Nadir ours = nadir(row[0]);
    EXPECT_NEAR(ours.ground / (row[5] / row[6]), 1.0, 0.015) << row[0];
    EXPECT_GT(row[5] / row[6], 1.3) << "direct light alone would pass";
  }
}

}  // namespace ifov::atmosphere::test_scattering_lowtran7
