// Where the ground's light in the air comes from: against the solver's own sums, and 6S's environment functions.
#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/ground_spread.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "column_maker.h"

namespace ifov::atmosphere::test_ground_spread {
namespace {

using test::Air;
using test::Column;
using test::kDegree;

GroundSpread spread(const Column& column, const GroundSpread::Sight& sight, std::size_t photons = 16384) {
  return {column.levels.altitude_km, column.optics, sight, photons};
}

/// Of 6S for a sensor above the air that looks down, r in km (Vermote et al. 1997, subroutine ENVIRO).
double molecules_of_6s(double r) { return 1.0 - 0.930 * std::exp(-0.080 * r) - 0.070 * std::exp(-1.100 * r); }
double haze_of_6s(double r) { return 1.0 - 0.448 * std::exp(-0.27 * r) - 0.552 * std::exp(-2.83 * r); }

/// Haze of a type at 0.55 um that thins out exponentially, in thin layers.
Column haze(double scale_km, double depth = 0.1, const char* type = "rural") {
  AtmosphereDescription description;
  description.aerosol.type = type;
  const AerosolPhases whole = *AtmosphereColumn(description).at(1e4 / 0.55).scattering.aerosol_phases;
  auto phases = std::make_shared<AerosolPhases>();
  phases->functions = whole.functions;
  Column column;
  double low = 0.0;
  for (int k = 0; k < 80; ++k) {
    const double high = low + 0.1 * std::pow(1.05, k);
    const double share = std::exp(-low / scale_km) - std::exp(-high / scale_km);
    column.add_layer(high, 0.0, depth * share, 0.65, 0.0, 0.1 * depth * share);
    phases->share.insert(phases->share.end(), whole.shares(0), whole.shares(0) + whole.functions.size());
    low = high;
  }
  column.optics.aerosol_phases = phases;
  return column;
}

/// F(r) of light scattered once, looking straight down through thin air that thins out exponentially: what is scattered by theta at
/// z lands at z tan theta.
class ThinAir {
 public:
  ThinAir(const PhaseFunction& phase, double scale_km) : scale_km_(scale_km) {
    constexpr int kSteps = 4000;
    for (int k = 0; k < kSteps; ++k) {
      const double u = (k + 0.5) / kSteps, theta = 0.5 * std::numbers::pi * u * u * u;
      tangent_.push_back(std::tan(theta));
      share_.push_back(u * u * phase.at(std::cos(theta)) * std::sin(theta));
      sum_ += share_.back();
    }
  }
  double operator()(double r_km) const {
    double inside = 0.0;
    for (std::size_t k = 0; k < share_.size(); ++k)
      inside -= share_[k] * std::expm1(-r_km / (scale_km_ * tangent_[k]));
    return inside / sum_;
  }

 private:
  double scale_km_, sum_ = 0.0;
  std::vector<double> tangent_, share_;
};

template <class Expected>
double worst(const GroundSpread& spread, const Expected& expected, double from_km, double to_km) {
  double worst = 0.0;
  for (double r = from_km; r <= to_km * 1.001; r *= 1.2)
    worst = std::max(worst, std::abs(spread.within(r) - expected(r)));
  return worst;
}

TEST(GroundSpread, AddsUpToWhatTheSolverSays) {
  constexpr std::size_t kPhotons = 1 << 19;
  const Column column = Air{}.column();
  const ColumnSolution solution =
      ColumnSolver(test::flat(8, 0.005, false)).solve(column.levels, column.optics, 0.5);
  const auto expect = [](const GroundSpread& found, double sum) {
    EXPECT_NEAR(found.transmittance(), sum, 4.0 * found.standard_error());
    EXPECT_LT(found.standard_error(), 0.0024 * sum);
    double shares = 0.0;
    for (const double share : found.shares()) shares += share;
    EXPECT_NEAR(shares, 1.0, 1e-9);
  };
  for (const double zenith : {0.0, 50.0 * kDegree})
    for (const double sensor_km : {2.5, 100.0})
      expect(spread(column, {zenith, sensor_km}, kPhotons),
             solution.diffuse_transmittance(std::cos(zenith), sensor_km).i);
  expect(spread(column, {0.0, 0.0, true}, kPhotons), solution.spherical_albedo());
  // Twin: a column thicker by a hundredth is told apart.
  const GroundSpread thicker = spread(Air{0.101, 0.202, 0.65, 0.0202}.column(), {}, kPhotons);
  EXPECT_GT(std::abs(thicker.transmittance() - solution.diffuse_transmittance(1.0, 100.0).i),
            4.0 * thicker.standard_error());
}

TEST(GroundSpread, OfMoleculesIsThatOf6S) {
  EXPECT_LT(worst(spread(Air{0.1, 0.0, 0.0, 0.0}.column(), {}), molecules_of_6s, 0.05, 10.0), 0.03);
  // Twin: all of it below half of the height.
  Column low = Air{0.1, 0.0, 0.0, 0.0}.column();
  for (double& altitude_km : low.levels.altitude_km) altitude_km *= 0.5;
  EXPECT_GT(worst(spread(low, {}), molecules_of_6s, 0.05, 10.0), 0.03);
}

TEST(GroundSpread, OfHazeIsThatOf6S) {
  const GroundSpread found = spread(haze(2.0), {});
  EXPECT_LT(worst(found, haze_of_6s, 0.02, 0.2), 0.05);
  EXPECT_LT(worst(found, haze_of_6s, 0.2, 2.0), 0.09);
  EXPECT_LT(worst(found, haze_of_6s, 2.0, 100.0), 0.03);
  EXPECT_GT(worst(spread(haze(0.7), {}), haze_of_6s, 2.0, 100.0), 0.03);  // twin
}

// Which of the two is off below 2 km: 6S's two exponentials stand for all haze, and haze of different kinds differs by more than
// ours from theirs.
TEST(GroundSpread, OfThinHazeIsInClosedForm) {
  const auto phase = [](const char* type) {
    return haze(2.0, 0.1, type).optics.aerosol_phases->functions[0];
  };
  for (const char* type : {"rural", "maritime", "urban"}) {
    const ThinAir exact(phase(type), 2.0);
    const GroundSpread found = spread(haze(2.0, 1e-4, type), {}, 1 << 17);
    EXPECT_LT(worst(found, exact, 0.02, 100.0), 0.004) << type;
    EXPECT_GT(worst(found, ThinAir(phase(type), 2.1), 0.02, 100.0), 0.006) << type;  // twin
  }
  const ThinAir rural(phase("rural"), 2.0), maritime(phase("maritime"), 2.0);
  EXPECT_NEAR(rural(0.5) - haze_of_6s(0.5), -0.070, 0.002);
  EXPECT_NEAR(maritime(0.5) - haze_of_6s(0.5), 0.013, 0.003);
}

// Lines of sight from the east: their light is scattered above the east, and starts there.
TEST(GroundSpread, LeansTowardsTheSensor) {
  const GroundSpread slanted = spread(Air{}.column(), {60.0 * kDegree, 100.0});
  double towards = 0.0, away = 0.0;
  for (std::size_t ring = 0; ring < GroundSpread::kRings; ++ring) {
    towards += slanted.shares()[ring * GroundSpread::kSectors];
    away += slanted.shares()[ring * GroundSpread::kSectors + GroundSpread::kSectors / 2];
    for (std::size_t s = 1; s < GroundSpread::kSectors; ++s)  // the same on both sides of the plane of sight
      EXPECT_EQ(slanted.shares()[ring * GroundSpread::kSectors + s],
                slanted.shares()[ring * GroundSpread::kSectors + GroundSpread::kSectors - s]);
  }
  EXPECT_GT(towards, 2.0 * away);
}

}  // namespace
}  // namespace ifov::atmosphere::test_ground_spread
