#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sensor/detector/detector_checks.h"
#include "sensor/detector/detector_signal.h"
#include "sensor/detector/poisson.h"

namespace ifov::sensor::test_detector_signal {
namespace {

/// k = 1: a radiance is its number of electrons.
Detector plain() {
  Detector detector;
  detector.electrons_per_radiance = 1.0;
  return detector;
}

/// Signals of an even image, line after line.
std::vector<double> image(const Detector& detector, double radiance, int lines, int columns,
                          std::uint64_t seed = 1) {
  return signal_image(detector, radiance, lines, columns, seed).values;
}

// ---------- the numbers of photons

/// Pearson's sum over bins that expect 25 or more, and how many there are.
struct Fit {
  double chi_square = 0.0, bins = -1.0;
  /// In its standard deviations.
  double off() const { return (chi_square - bins) / std::sqrt(2.0 * bins); }
};

Fit fit(double mean, const std::function<double(double uniform, double normal)>& drawn) {
  constexpr int kDraws = 400000;
  std::vector<double> found(4000, 0.0);
  const std::vector<double> normals = [] {
    Detector still = plain();
    still.read_noise = 1.0;
    return image(still, 0.0, 400, 1000);
  }();
  for (int k = 0; k < kDraws; ++k) {
    const double z = normals[static_cast<std::size_t>(k)];
    const double count = drawn(0.5 * std::erfc(-z / std::sqrt(2.0)), z);
    if (count >= 0.0 && count < 4000.0) found[static_cast<std::size_t>(count)] += 1.0;
  }
  Fit result;
  double expected = 0.0, in_bin = 0.0;
  for (int n = 0; n < 4000; ++n) {
    expected += kDraws * std::exp(n * std::log(mean) - mean - std::lgamma(n + 1.0));
    in_bin += found[static_cast<std::size_t>(n)];
    if (expected < 25.0) continue;
    result.chi_square += (in_bin - expected) * (in_bin - expected) / expected;
    result.bins += 1.0;
    expected = in_bin = 0.0;
  }
  return result;
}

TEST(Poisson, IsItsDistribution) {
  for (const double mean : {0.3, 4.0, 60.0, 99.9, 100.0, 130.0, 2000.0})
    EXPECT_LT(fit(mean, [&](double u, double z) { return poisson(mean, u, z); }).off(), 4.0) << mean;
}

TEST(Poisson, NormalOnesAreSeen) {
  EXPECT_GT(fit(100.0, [](double, double z) { return std::floor(100.0 + 10.0 * z + 0.5); }).off(), 20.0);
  EXPECT_GT(fit(4.0, [](double u, double z) { return poisson(4.05, u, z); }).off(), 4.0);
}

/// Photons and read noise drawn at once are as drawn one after the other: third and fourth moments, too.
TEST(DetectorSignal, ReadNoiseAndPhotonsTogetherAreAsApart) {
  Detector together = plain(), apart = plain();
  together.read_noise = apart.read_noise = 5.0;
  apart.full_well = 130.0 + 7.9 * std::sqrt(155.0);  // so near that it is looked at, and never met
  for (const Detector& detector : {together, apart}) {
    const std::vector<double> values = image(detector, 130.0, 1000, 1000);
    const Moments m = moments(values);
    double third = 0.0;
    for (const double value : values) third += std::pow(value - m.mean, 3) / 1e6;
    EXPECT_NEAR(m.mean, 130.0, 4.0 * std::sqrt(155.0 / 1e6));
    EXPECT_NEAR(m.variance / 155.0, 1.0, 4.0 * std::sqrt(2.0 / 1e6));
    EXPECT_NEAR(third, 130.0, 4.0 * std::sqrt(15.0 * std::pow(155.0, 3) / 1e6));
  }
}

// ---------- photon transfer

Detector camera() {
  Detector detector = plain();
  detector.full_well = 1e5;
  detector.read_noise = 30.0;
  detector.dark = 40.0;
  detector.bits = 12;
  detector.offset = 20.0;
  detector.gain = 1e5 / (4095.0 - 20.0);
  return detector;
}

std::vector<double> counts(const Detector& detector, double radiance, int lines, int columns) {
  std::vector<double> values = image(detector, radiance, lines, columns);
  for (double& value : values) value = detector.count(value);
  return values;
}

TEST(PhotonTransfer, HasASlopeOfOneAndShowsTheGain) {
  const PhotonTransfer found = photon_transfer(camera());
  EXPECT_NEAR(found.slope, 1.0, 0.01);
  EXPECT_NEAR(found.gain / camera().gain, 1.0, 0.01);
}

TEST(PhotonTransfer, OfALawThatBendsIsSeen) {
  const PhotonTransfer found =
      photon_transfer(camera(), [](double count) { return std::pow(count - 20.0 + 25.0, 1.01); });
  EXPECT_FALSE(std::abs(found.slope - 1.0) <= 0.01 && std::abs(found.gain / camera().gain - 1.0) <= 0.01);
}

TEST(PhotonTransfer, ShowsTheReadFloorAndTheWell) {
  const Detector detector = camera();
  const Moments darkness = moments(counts(detector, 0.0, 400, 1000));
  const double floor = 30.0 * 30.0 + 40.0 + detector.gain * detector.gain / 12.0;
  EXPECT_NEAR(darkness.mean, 20.0 + 40.0 / detector.gain, 0.01);
  EXPECT_NEAR(std::sqrt(darkness.variance) * detector.gain / std::sqrt(floor), 1.0, 0.01);
  // Beyond the well nothing is left but read noise, of which the counts cut the upper half.
  const Moments full = moments(image(detector, 2e5, 400, 1000));
  EXPECT_NEAR(full.mean / 1e5, 1.0, 0.01);
  EXPECT_NEAR(std::sqrt(full.variance) / 30.0, 1.0, 0.01);
  EXPECT_EQ(counts(detector, 3e5, 1, 1000).front() > 4090.0, true);
}

TEST(PhotonTransfer, ANonlinearResponseIsMissingItsShareAtTheWell) {
  Detector detector = plain();
  detector.full_well = 1e5;
  detector.nonlinearity = 0.02;
  EXPECT_NEAR(moments(image(detector, 9e4, 40, 1000)).mean / (9e4 * (1.0 - 0.02 * 0.9)), 1.0, 1e-4);
  EXPECT_NEAR(moments(image(detector, 3e5, 1, 1000)).mean / 98000.0, 1.0, 1e-9);
}

// ---------- who draws what

TEST(DetectorSignal, DependsOnSeedAndPlaceAlone) {
  const Detector detector = camera();
  const std::vector<double> one = image(detector, 700.0, 5, 1000, 3);
  EXPECT_EQ(one, image(detector, 700.0, 5, 1000, 3));
  EXPECT_NE(one, image(detector, 700.0, 5, 1000, 4));
  std::vector<double> alone(1000);
  DetectorSignal(detector, 3, 0, 1000).draw(4, std::vector<float>(1000, 700.0f), {}, alone);
  EXPECT_TRUE(std::equal(alone.begin(), alone.end(), one.begin() + 4000));
  std::vector<double> other(1000);
  DetectorSignal(detector, 3, 1, 1000).draw(4, std::vector<float>(1000, 700.0f), {}, other);
  EXPECT_NE(alone, other);
}

TEST(DetectorSignal, OfGapsIsAGapAndLightIsNotNegative) {
  std::vector<double> signal(3);
  DetectorSignal(plain(), 1, 0, 3).draw(0, std::vector<float>{NAN, -5.0f, 0.0f}, {}, signal);
  EXPECT_TRUE(std::isnan(signal[0]));
  EXPECT_EQ(signal[1], 0.0);
  EXPECT_EQ(signal[2], 0.0);
}

}  // namespace
}  // namespace ifov::sensor::test_detector_signal
