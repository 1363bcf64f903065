#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/aerosol_phase_functions.h"
#include "atmosphere/scattering/single_scattering.h"

namespace ifov::atmosphere {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<double, 8> kWavenumber_cm1{25000, 22000, 18180, 15400, 11560, 9400, 6400, 4540};

/// Computed with the original program: mid-latitude summer, 23 km of visibility, seen straight down from 100 km. Light
/// scattered once over direct sunlight from a ground of reflectance 0.2, which takes the solar spectrum out. The program
/// prints three digits.
struct Lowtran7 {
  const char* type;
  double sun_zenith_deg, tilt_deg;  ///< tilt: of the sight from the nadir towards the Sun
  double visibility_km;
  std::array<double, 8> ratio;
};
const Lowtran7 kLowtran7[] = {
    {"rural", 0, 0, 23, {0.07195, 0.04819, 0.02832, 0.02009, 0.01075, 0.006364, 0.002977, 0.001608}},
    {"rural", 15, 0, 23, {0.0671, 0.04395, 0.02509, 0.01736, 0.009346, 0.005663, 0.002994, 0.001647}},
    {"rural", 30, 0, 23, {0.06702, 0.04337, 0.02428, 0.01659, 0.008881, 0.00547, 0.002945, 0.001584}},
    {"rural", 45, 0, 23, {0.07274, 0.04669, 0.02595, 0.01763, 0.009563, 0.006051, 0.003162, 0.001618}},
    {"rural", 60, 0, 23, {0.1037, 0.06579, 0.03646, 0.02487, 0.0136, 0.008725, 0.004426, 0.002145}},
    {"rural", 45, 25, 50, {0.04145, 0.02608, 0.01415, 0.009251, 0.004827, 0.003096, 0.001524, 0.0007148}},
    {"rural", 60, 30, 50, {0.06895, 0.04478, 0.02596, 0.018, 0.01011, 0.006623, 0.003168, 0.001483}},
    {"maritime", 0, 0, 23, {0.09107, 0.06765, 0.04682, 0.03547, 0.02652, 0.02338, 0.008143, 0.00685}},
    {"maritime", 15, 0, 23, {0.07348, 0.05273, 0.03576, 0.02693, 0.01963, 0.01718, 0.008, 0.006773}},
    {"maritime", 30, 0, 23, {0.06111, 0.04206, 0.02759, 0.02163, 0.01564, 0.01347, 0.007297, 0.006165}},
    {"maritime", 45, 0, 23, {0.05779, 0.03754, 0.02311, 0.01688, 0.01115, 0.00936, 0.006751, 0.005694}},
    {"maritime", 60, 0, 23, {0.07754, 0.04947, 0.02962, 0.02084, 0.01317, 0.01095, 0.008507, 0.007198}},
    {"maritime", 45, 25, 50, {0.03603, 0.02211, 0.01208, 0.007784, 0.004345, 0.003431, 0.002518, 0.002141}},
    {"maritime", 60, 30, 50, {0.05676, 0.03609, 0.02126, 0.01447, 0.00889, 0.007383, 0.005569, 0.004826}},
};

/// Light in the forward peak has been scattered: here it counts. One sublayer a layer.
void without_delta_m(ScatteringColumn& column) {
  for (std::size_t s = 0; s < column.sublayers(); ++s) {
    const double kept = column.depth[s] / column.true_depth[s];
    column.mixtures[s].rayleigh *= kept;
    column.mixtures[s].aerosol *= kept;
  }
  column.depth = column.true_depth;
  column.beam_depth = column.true_beam_depth;
}

enum class Haze { of_tables, henyey_greenstein };

double worst_ratio(const Lowtran7& run, Haze haze) {
  AtmosphereDescription description;
  description.air.model = "tropical";
  description.air.co2_ppm = description.air.ch4_ppm = description.air.n2o_ppm = std::nullopt;
  description.gas_model = GasModel::lowtran7;
  description.aerosol.type = run.type;
  description.aerosol.visibility_km = run.visibility_km;
  const AtmosphereColumn column(description);
  ScatteringOptions options;
  options.most_sublayers = 1;
  double worst = 0.0;
  for (std::size_t k = 0; k < kWavenumber_cm1.size(); ++k) {
    const ColumnOptics optics = column.at(kWavenumber_cm1[k]);
    double once = 0.0, direct = 0.0;
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      LayerOptics layers = optics.term(term);
      if (haze == Haze::henyey_greenstein) layers.aerosol_phases = nullptr;
      ScatteringColumn lit(column.levels(), layers, run.sun_zenith_deg * kDegree, options);
      without_delta_m(lit);
      const PathLight path = single_scattering(lit, 0.0, {std::cos(run.tilt_deg * kDegree), 0.0}, 2.0);
      once += optics.weight(term) * path.single.i;
      direct += optics.weight(term) * 1.0 / std::numbers::pi * path.transmittance * lit.sun_mu *
                std::exp(-lit.true_beam_depth.back());
    }
    const double error = once / direct / run.ratio[k] - 1.0;
    if (std::getenv("H20"))
      printf("%s%s %g-%g %.3f %.4f\n", haze == Haze::of_tables ? "" : "HG", run.type, run.sun_zenith_deg,
             run.tilt_deg, 1e4 / kWavenumber_cm1[k], error);
    worst = std::max(worst, std::abs(error));
  }
  return worst;
}

}  // namespace

TEST(HazePhaseFunctions, ScatterOnceWhatLowtran7Says) {
  double planted = 0.0;
  for (const Lowtran7& run : kLowtran7) {
    EXPECT_LT(worst_ratio(run, Haze::of_tables), 0.02) << run.type << " " << run.sun_zenith_deg;
    planted = std::max(planted, worst_ratio(run, Haze::henyey_greenstein));
  }
  RecordProperty("henyey_greenstein", std::to_string(planted));
  EXPECT_GT(planted, 0.25) << "one number a layer passes";
}

}  // namespace ifov::atmosphere
