#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/thermal/thermal_column.h"
#include "lowtran_output.h"
#include "radiometry/planck.h"
#include "support/truth_data.h"

namespace ifov::atmosphere::test_thermal_reference {
namespace {

constexpr const char* kReptran = "atmosphere/libradtran/spectrum_terrestrial_reptran.OUT";

/// Thermal flux that comes down to the ground between two wavenumbers, W m-2.
double flux_down(const AtmosphereColumn& column, double from_cm1, double to_cm1) {
  const GaussNodes nodes = gauss_nodes(8);
  double sum = 0.0;
  for (double nu = from_cm1; nu < to_cm1; nu += 5.0) {
    const ColumnOptics optics = column.at(nu);
    const double um = optics.wavelength_um;
    std::vector<double> planck;
    for (double t : column.levels().temperature_K) planck.push_back(radiometry::planck_w_m2_sr_um(um, t));
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const LayerOptics layers = optics.term(term);
      const ThermalColumn thermal(column.levels().altitude_km, planck, layers.gas_absorption);
      const ThermalRadiance light = thermal.radiances(nodes, {0.7, planck[0]});
      sum += 5.0 * optics.weight(term) * light.flux_down[0] * um * um * 1e-4;
    }
  }
  return sum;
}

}  // namespace

// Downward thermal flux of the subarctic summer by REPTRAN "fine" (1 cm-1).
TEST(ThermalReference, ReptranDownwardFlux) {
  const auto file = ifov::test::truth_file(kReptran);
  if (!file) GTEST_SKIP() << "reference data not found: " << kReptran;
  AtmosphereDescription description;
  description.air.model = "subarctic summer";
  description.air.ozone_DU = 300.0;
  description.aerosol.type = "none";
  const AtmosphereColumn column(description);
  const auto theirs = [&](double from, double to) {
    double sum = 0.0;
    for (const auto& row : ifov::test::numeric_rows(*file, 3)) {
      if (row[1] >= from && row[1] < to) sum += row[2];
    }
    return sum;
  };
  // Bins of 5 cm-1 about their middles.
  const auto ratio = [&](double from, double to) {
    return flux_down(column, from, to) / theirs(from - 2.5, to - 2.5);
  };
  RecordProperty("all", std::to_string(ratio(255.0, 2900.0)));
  EXPECT_NEAR(ratio(255.0, 2900.0), 1.0, 0.015);
  EXPECT_NEAR(ratio(255.0, 560.0), 1.0, 0.01) << "opaque";
  EXPECT_NEAR(ratio(600.0, 800.0), 1.0, 0.015) << "carbon dioxide";
  EXPECT_NEAR(ratio(1080.0, 1200.0), 1.0, 0.05) << "window";
  // The planted fault: no carbon dioxide.
  description.air.co2_ppm = 1.0;
  const AtmosphereColumn faulty(description);
  EXPECT_LT(flux_down(faulty, 600.0, 800.0) / theirs(597.5, 797.5), 0.95);
}

}  // namespace ifov::atmosphere::test_thermal_reference
