#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "platform/power_spectrum.h"
#include "platform/wander.h"

namespace ifov::platform {
namespace {

TEST(PowerSpectrum, HoldsThePowerThatIsAskedFor) {
  EXPECT_NEAR(PowerSpectrum::flat(50.0, 3e-6).rms(), 3e-6, 1e-18);
  EXPECT_NEAR(PowerSpectrum::flat(50.0, 3e-6).density(20.0), 9e-12 / 50.0, 1e-25);
  const PowerSpectrum falling = PowerSpectrum::falling(2.0, 2.0, 400.0, 1e-5);
  EXPECT_NEAR(falling.rms(), 1e-5, 1e-17);
  EXPECT_NEAR(falling.density(2.0) / falling.density(0.0), 0.5, 1e-3);
  EXPECT_NEAR(falling.density(40.0) / falling.density(0.0), 1.0 / 401.0, 1e-5);
  EXPECT_EQ(falling.density(401.0), 0.0);
  // Half of a Lorentzian's power lies below its corner, of all that is up to infinity.
  const double whole = std::atan(200.0);
  EXPECT_NEAR(falling.frequency_of(0.25 * std::numbers::pi / whole), 2.0, 2e-3);
  EXPECT_NEAR(falling.frequency_of(0.5), 2.0 * std::tan(0.5 * whole), 2e-3);
  EXPECT_EQ(falling.frequency_of(0.0), 0.0);
  EXPECT_NEAR(falling.frequency_of(1.0), 400.0, 1e-9);
  const PowerSpectrum ramp({0.0, 10.0, 20.0}, {0.0, 1.0, 0.0});
  EXPECT_NEAR(ramp.frequency_of(0.5), 10.0, 1e-12);
  EXPECT_NEAR(ramp.frequency_of(0.125), 5.0, 1e-12);
  EXPECT_EQ(PowerSpectrum().rms(), 0.0);
}

TEST(PowerSpectrum, RefusesWhatIsNone) {
  EXPECT_THROW(PowerSpectrum({0.0}, {1.0}), InputError);
  EXPECT_THROW(PowerSpectrum({1.0, 1.0}, {1.0, 1.0}), InputError);
  EXPECT_THROW(PowerSpectrum({-1.0, 1.0}, {1.0, 1.0}), InputError);
  EXPECT_THROW(PowerSpectrum({0.0, 1.0}, {1.0, -1.0}), InputError);
}

TEST(Wander, IsTheSameWhoeverAsks) {
  const std::vector<PowerSpectrum> spectra{PowerSpectrum(), PowerSpectrum::falling(5.0, 2.0, 40.0, 1.0)};
  const Wander all(spectra, 7, 0, -3.0, 20.0), part(spectra, 7, 0, 4.13, 4.7),
      other(spectra, 8, 0, -3.0, 20.0), stream(spectra, 7, 1, -3.0, 20.0);
  double differs = 0.0, streams = 0.0;
  for (double t = 4.13; t < 4.7; t += 0.0117) {
    double a[2], b[2], c[2], d[2];
    all.at(t, a), part.at(t, b), other.at(t, c), stream.at(t, d);
    EXPECT_EQ(a[0], 0.0);
    EXPECT_NEAR(a[1], b[1], 1e-9);
    differs = std::max(differs, std::abs(a[1] - c[1])), streams = std::max(streams, std::abs(a[1] - d[1]));
  }
  EXPECT_GT(differs, 0.1);
  EXPECT_GT(streams, 0.1);
  EXPECT_NEAR(all.step_s(), 1.0 / 800.0, 1e-15);
  double still[1] = {1.0};
  const Wander none(std::vector<PowerSpectrum>(1), 7, 0, 0.0, 1.0);
  none.at(0.5, still);
  EXPECT_EQ(still[0], 0.0);
  EXPECT_TRUE(std::isinf(none.step_s()));
}

/// Mean square of what two instants differ by, over seeds and time, in units of the variance.
double structure(const PowerSpectrum& spectrum, double apart_s) {
  constexpr int kSeeds = 40;
  double sum = 0.0;
  int count = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Wander wander({&spectrum, 1}, static_cast<std::uint64_t>(seed), 0, 0.0, 12.0);
    for (double t = 0.0; t < 11.0; t += 0.21) {
      double a[1], b[1];
      wander.at(t, a), wander.at(t + apart_s, b);
      sum += (b[0] - a[0]) * (b[0] - a[0]), ++count;
    }
  }
  return sum / count / (spectrum.rms() * spectrum.rms());
}

/// A Lorentzian's autocorrelation is exp(-2 pi corner t) (Wiener and Khinchin), that of white noise up to f a sinc; some 2,000
/// independent differences: 3 % of one sigma.
TEST(Wander, HasTheCorrelationOfItsSpectrum) {
  const PowerSpectrum lorentz = PowerSpectrum::falling(1.0, 2.0, 100.0, 4e-6);
  for (const double turns : {0.1, 0.5, 1.0}) {
    const double expected = 2.0 * (1.0 - std::exp(-turns));
    EXPECT_NEAR(structure(lorentz, turns / (2.0 * std::numbers::pi)), expected, 0.1 * expected) << turns;
  }
  const PowerSpectrum white = PowerSpectrum::flat(5.0, 1.0);
  EXPECT_NEAR(structure(white, 0.1), 2.0, 0.2) << "the first zero of the sinc";
  EXPECT_NEAR(structure(white, 0.05), 2.0 * (1.0 - 2.0 / std::numbers::pi), 0.08);
}

TEST(Wander, PlantedSlopeIsNoticed) {
  const double expected = 2.0 * (1.0 - std::exp(-0.1)), apart_s = 0.1 / (2.0 * std::numbers::pi);
  for (const double slope : {1.5, 2.5})
    EXPECT_GT(std::abs(structure(PowerSpectrum::falling(1.0, slope, 100.0, 1.0), apart_s) - expected),
              0.2 * expected)
        << slope;
}

TEST(Wander, RefusesMoreSamplesThanAreOfUse) {
  const PowerSpectrum fast = PowerSpectrum::flat(1e5, 1.0);
  try {
    const Wander wander({&fast, 1}, 1, 0, 0.0, 10.0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "motion of up to 100000 Hz over 10 s takes 2e+07 samples; expected at most 1e+06: a lower frequency, or fewer lines");
  }
}

}  // namespace
}  // namespace ifov::platform
