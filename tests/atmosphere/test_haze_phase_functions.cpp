#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/aerosol_optics.h"
#include "atmosphere/particles/aerosol_phase_functions.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/single_scattering.h"

namespace ifov::atmosphere::test_haze_phase_functions {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<double, 8> kWavenumber_cm1{25000, 22000, 18180, 15400, 11560, 9400, 6400, 4540};

/// Computed with the original program (the values are three digits of radiance): tropical air seen from 2 km, light
/// scattered once over direct sunlight from a white ground, which takes the solar spectrum out. Above 2 km the program
/// mixes phase functions by height where aerosols of two kinds meet; scattering angles are those of its table, between
/// which it is linear, and where beams are long there is less haze, for its layers are 1 km thick.
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
      direct += optics.weight(term) / std::numbers::pi * path.transmittance * lit.sun_mu *
                std::exp(-lit.true_beam_depth.back());
    }
    const double error = once / direct / run.ratio[k] - 1.0;
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

// Shettle and Fenn's own asymmetries are another table; LOWTRAN7 took for each model the nearest of its 70 functions.
TEST(HazePhaseFunctions, HaveTheAsymmetriesOfTheirAerosols) {
  double worst = 0.0, planted = 0.0, mean_worst = 0.0;
  for (const char* kind : {"rural", "urban", "maritime", "tropospheric"})
    for (const double humidity : {0.0, 70.0, 80.0, 99.0})
      for (const double um : {0.3, 0.55, 0.6943, 1.06, 1.536, 2.0, 2.5}) {
        const PhaseFunction function = AerosolPhaseFunctions(kind, humidity).at(um);
        const double expected = AerosolOptics(kind, humidity).at(um).asymmetry;
        mean_worst = std::max(mean_worst, std::abs(function.moment(0) - 1.0));
        worst = std::max(worst, std::abs(function.moment(1) - expected));
        planted = std::max(
            planted, std::abs(AerosolPhaseFunctions(kind, 99.0 - humidity).at(um).moment(1) - expected));
      }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(mean_worst, 1e-12);
  EXPECT_LT(worst, 0.05);
  EXPECT_GT(planted, 0.08) << "dry for moist passes";
}

std::shared_ptr<const PhaseAngles> lowtran_angles() {
  std::vector<double> angles;
  for (const double degrees :
       {0.0,   2.0,   4.0,   6.0,   8.0,   10.0,  12.0,  16.0,  20.0,  24.0,  28.0,  32.0,
        36.0,  40.0,  50.0,  60.0,  70.0,  80.0,  90.0,  100.0, 110.0, 120.0, 125.0, 130.0,
        135.0, 140.0, 145.0, 150.0, 155.0, 160.0, 165.0, 170.0, 175.0, 180.0})
    angles.push_back(degrees == 180.0 ? std::numbers::pi : degrees * kDegree);
  return std::make_shared<const PhaseAngles>(std::move(angles));
}

// A Henyey-Greenstein function at the 34 angles of the tables: moments g^l.
TEST(PhaseFunction, OfATableHasTheMomentsOfWhatIsTabulated) {
  const auto angles = lowtran_angles();
  for (const double g : {0.0, 0.3, 0.7, 0.85}) {
    std::vector<double> logarithms;
    for (const double angle : angles->angle_rad)
      logarithms.push_back(std::log(aerosol_matrix(std::cos(angle), g, 0.0).a1));
    const PhaseFunction function(angles, logarithms);
    for (const int l : {0, 1, 2, 5, 16})
      EXPECT_NEAR(function.moment(l), std::pow(g, l), 1e-3) << g << " " << l;
    for (const double cosine : {-1.0, -0.3, 0.2, 0.9})
      EXPECT_NEAR(function.at(cosine) / aerosol_matrix(cosine, g, 0.0).a1, 1.0, 3e-3) << g << " " << cosine;
    // By both ways into generalised spherical functions.
    const AerosolProjection projection(16, 0.1);
    const PhaseExpansion a = projection.expansion(g), b = projection.expansion(function);
    for (std::size_t l = 2; l < 16; ++l) {
      EXPECT_NEAR(a.alpha[l], b.alpha[l], 1e-2) << g << " " << l;
      EXPECT_NEAR(a.zeta[l], b.zeta[l], 1e-2) << g << " " << l;
      EXPECT_NEAR(a.gamma[l], b.gamma[l], 1e-2) << g << " " << l;
    }
  }
}

// A twentieth of the light goes into a Gaussian of 0.6 degrees, of which the table shows the height alone. Planted: the
// height that the peak has beyond the first step, as if there were none.
TEST(PhaseFunction, FindsThePeakThatItsFirstStepHides) {
  const auto angles = lowtran_angles();
  constexpr double kPeak = 0.05, kWidth_rad = 0.6 * kDegree;
  std::vector<double> logarithms;
  for (const double angle : angles->angle_rad)
    logarithms.push_back(
        std::log((1.0 - kPeak) * aerosol_matrix(std::cos(angle), 0.6, 0.0).a1 +
                 kPeak * 2.0 / (kWidth_rad * kWidth_rad) * std::exp(-std::pow(angle / kWidth_rad, 2))));
  const double asymmetry = (1.0 - kPeak) * 0.6 + kPeak;
  const PhaseFunction function(angles, logarithms);
  EXPECT_NEAR(function.moment(0), 1.0, 1e-12);
  EXPECT_NEAR(function.moment(1), asymmetry, 2e-3);
  EXPECT_NEAR(function.moment(16), (1.0 - kPeak) * std::pow(0.6, 16) + kPeak, 2e-3);
  EXPECT_NEAR(function.at(0.0), (1.0 - kPeak) * aerosol_matrix(0.0, 0.6, 0.0).a1, 1e-3);
  logarithms[0] = logarithms[1];
  const PhaseFunction without(angles, logarithms);
  EXPECT_LT(without.moment(1), asymmetry - 0.01);
}

// A cell of a table beside the Sun: linear along both sides it holds what the function scatters into it.
TEST(PhaseFunction, FillsTheCellsBesideTheSun) {
  const PhaseFunction function = AerosolPhaseFunctions("maritime", 80.0).at(0.4);
  const double width = 3.0 * kDegree, height = 2.0 * kDegree;
  double mean = 0.0;
  constexpr int kSteps = 600;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      mean += function.at(std::cos(std::hypot(width * (i + 0.5) / kSteps, height * (j + 0.5) / kSteps))) /
              (kSteps * kSteps);
  const double others = function.at(std::cos(width)) + function.at(std::cos(height)) +
                        function.at(std::cos(std::hypot(width, height)));
  EXPECT_NEAR(0.25 * (function.forward_for(width, height) + others) / mean, 1.0, 2e-3);
  EXPECT_GT(0.25 * (function.at(1.0) + others) / mean, 1.3) << "the peak itself passes";
}

TEST(PhaseFunction, RefusesWhatIsNone) {
  const auto angles = lowtran_angles();
  EXPECT_THROW(PhaseFunction(angles, std::vector<double>(33, 0.0)), std::invalid_argument);
  EXPECT_THROW(PhaseFunction(angles, std::vector<double>(34, 1e4)), std::invalid_argument);
  EXPECT_THROW(PhaseAngles({0.0, 1.0, 2.0, 3.0}), std::invalid_argument);
  EXPECT_THROW(PhaseAngles({0.0, 2.0, 1.0, std::numbers::pi}), std::invalid_argument);
}

// Aerosol that absorbs nothing over white ground: all light comes back, whatever the peak that delta-M cuts off.
TEST(HazePhaseFunctions, ConserveEnergy) {
  const AtmosphereColumn column = [] {
    AtmosphereDescription description;
    description.aerosol.type = "maritime";
    return AtmosphereColumn(description);
  }();
  LayerOptics layers = column.at(18180.0).scattering;
  layers.gas_absorption.assign(column.levels().layers(), 0.0);
  layers.aerosol_absorption.assign(column.levels().layers(), 0.0);
  ScatteringOptions options;
  options.spherical_earth = false;
  const ColumnSolution solution = ColumnSolver(options).solve(column.levels(), layers, 40.0 * kDegree);
  const FluxProfile& fluxes = solution.sunlit().fluxes();
  const double back = fluxes.up.front() + fluxes.direct_down.back() + fluxes.diffuse_down.back();
  EXPECT_NEAR(back / std::cos(40.0 * kDegree), 1.0, 1e-3);
}

}  // namespace ifov::atmosphere::test_haze_phase_functions
