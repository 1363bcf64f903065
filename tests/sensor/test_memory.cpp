#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "sensor/detector/blooming.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/detector_checks.h"
#include "sensor/detector/detector_signal.h"
#include "sensor/detector/memory.h"

namespace ifov::sensor::test_memory {
namespace {

/// Lag leaves its share to the power of the exposures since; an element that follows by a time constant is off by exp(-t / time constant).
TEST(SignalMemory, ForgetsAStepAsItsFormSays) {
  const double lag = 0.07, inertia = std::exp(-14.0 / 9.0);
  const auto after = [](const SignalMemory& memory, std::size_t exposures) {
    double sum = 0.0;
    for (std::size_t k = 0; k <= exposures && k < memory.weights().size(); ++k) sum += memory.weights()[k];
    return sum;
  };
  const SignalMemory lags(lag, 0.0), follows(0.0, inertia), both(lag, inertia);
  for (std::size_t n = 0; n < 8; ++n) {
    const double power = static_cast<double>(n + 1);
    EXPECT_NEAR(after(lags, n), 1.0 - std::pow(lag, power), 2e-7);
    EXPECT_NEAR(after(follows, n), 1.0 - std::pow(inertia, power), 2e-7);
    // One after the other: 1 - (a^(n+2) (1-b) - b^(n+2) (1-a)) / (a - b).
    EXPECT_NEAR(
        after(both, n),
        1.0 - (std::pow(lag, power + 1.0) * (1.0 - inertia) - std::pow(inertia, power + 1.0) * (1.0 - lag)) /
                  (lag - inertia),
        2e-7);
  }
  for (const SignalMemory* one : {&lags, &follows, &both})
    EXPECT_NEAR(std::accumulate(one->weights().begin(), one->weights().end(), 0.0), 1.0, 1e-12);
  EXPECT_TRUE(SignalMemory(0.0, 0.0).none());
  EXPECT_FALSE(lags.none());
}

TEST(SignalMemory, SwingsAsItsWeightsDo) {
  const SignalMemory memory(0.1, std::exp(-1.0 / 2.5));
  for (const double cycles : {0.0, 0.05, 0.2, 0.35, 0.5}) {
    double real = 0.0, imaginary = 0.0;
    for (std::size_t k = 0; k < memory.weights().size(); ++k) {
      const double phase = 2.0 * std::numbers::pi * cycles * static_cast<double>(k);
      real += memory.weights()[k] * std::cos(phase), imaginary += memory.weights()[k] * std::sin(phase);
    }
    EXPECT_NEAR(memory.modulation(cycles), std::hypot(real, imaginary), 1e-6);
  }
}

TEST(SignalMemory, RunsAlongTheSweep) {
  std::vector<float> flash(9, 0.0F);
  flash[3] = 1.0F;
  std::vector<float> back = flash;
  remember_along(SignalMemory(0.25, 0.0), false, flash);
  remember_along(SignalMemory(0.25, 0.0), true, back);
  for (int x = 0; x < 9; ++x) {
    EXPECT_NEAR(flash[static_cast<std::size_t>(x)], x < 3 ? 0.0 : 0.75 * std::pow(0.25, x - 3), 1e-7);
    EXPECT_NEAR(back[static_cast<std::size_t>(x)], x > 3 ? 0.0 : 0.75 * std::pow(0.25, 3 - x), 1e-7);
  }
}

TEST(Blooming, FillsNeighboursAndLosesNothing) {
  // 11 wells in the middle of 21 elements that hold a tenth each: 10 over, 5 to each side, each of which takes 0.9.
  std::vector<double> held(21, 100.0);
  held[10] = 11000.0;
  std::vector<double> lossy = held;
  run_over(held, 0, 1, held.size(), 1000.0, 1.0);
  for (int d = 1; d <= 5; ++d) EXPECT_DOUBLE_EQ(held[static_cast<std::size_t>(10 + d)], 1000.0) << d;
  EXPECT_NEAR(held[16], 100.0 + 5000.0 - 4500.0, 1e-9);
  for (std::size_t k = 0; k < 21; ++k) EXPECT_NEAR(held[k], held[20 - k], 1e-9) << k;
  EXPECT_NEAR(std::accumulate(held.begin(), held.end(), 0.0), 13000.0, 1e-9);
  // Of a share what the drain takes is missing.
  run_over(lossy, 0, 1, lossy.size(), 1000.0, 0.3);
  EXPECT_NEAR(std::accumulate(lossy.begin(), lossy.end(), 0.0), 13000.0 - 7000.0, 1e-9);
  // Along a column of three, over its end.
  std::vector<double> image{0, 0, 0, 0, 5000, 0, 0, 0, 0};
  run_over(image, 1, 3, 3, 1000.0, 1.0);
  EXPECT_EQ(image, (std::vector<double>{0, 1000, 0, 0, 1000, 0, 0, 1000, 0}));
}

std::vector<double> signal_image_corrected(const Detector& detector, double radiance) {
  std::vector<double> all, line(500);
  const std::vector<float> even(500, static_cast<float>(radiance));
  const DetectorSignal of(detector, 7, 0, 500);
  for (int y = 0; y < 40; ++y) {
    of.draw(y, even, {}, line);
    of.correct(y, line);
    all.insert(all.end(), line.begin(), line.end());
  }
  return all;
}

Detector uneven(int frames) {
  Detector detector;
  detector.electrons_per_radiance = 1.0, detector.dark = 200.0, detector.read_noise = 30.0;
  detector.prnu = 0.05, detector.dsnu = 500.0, detector.column_gain = 0.02, detector.row_offset = 90.0;
  detector.full_well = 1e6;
  detector.nuc_low = 1e4, detector.nuc_high = 9e4, detector.nuc_frames = frames;
  return detector;
}

/// Variance from element to element of the mean of many exposures, less what is left of their own noise.
double pattern_left(const Detector& detector, double radiance, int exposures = 60) {
  constexpr int kLines = 40, kColumns = 500;
  std::vector<double> mean(kLines * kColumns, 0.0), signal(kColumns);
  const std::vector<float> even(kColumns, static_cast<float>(radiance));
  double noise = 0.0;
  for (int e = 0; e < exposures; ++e) {
    const DetectorSignal of(detector, 100 + static_cast<std::uint64_t>(e), 0, kColumns);
    for (int y = 0; y < kLines; ++y) {
      of.draw(y, even, {}, signal);
      of.correct(y, signal);
      for (int x = 0; x < kColumns; ++x)
        mean[static_cast<std::size_t>(y * kColumns + x)] += signal[static_cast<std::size_t>(x)] / exposures;
    }
  }
  noise = (radiance + detector.dark + detector.read_noise * detector.read_noise) / exposures;
  return moments(mean).variance - noise;
}

/// What is left is the noise of two means of so many exposures, led from one light to the other.
TEST(Correction, LeavesTheNoiseOfItsMeasurement) {
  const Detector detector = uneven(16);
  for (const double radiance : {1e4, 5e4, 9e4, 1.4e5}) {
    const double share = (radiance - 1e4) / 8e4;
    const double low = 1e4 + 200.0 + 900.0, high = 9e4 + 200.0 + 900.0;
    const double expected = ((1.0 - share) * (1.0 - share) * low + share * share * high) / 16.0;
    EXPECT_NEAR(std::pow(detector.correction_noise(radiance), 2), expected, 1e-9 * expected);
    // 20,000 elements, and what is taken off is known to a percent.
    const double scatter = 3.0 * std::sqrt(2.0 / 20000.0) * (expected + radiance / 60.0) + 0.06 * expected;
    EXPECT_NEAR(pattern_left(detector, radiance), expected, scatter) << radiance;
  }
  // Without it the pattern is (0.05^2 + 0.02^2) of the signal squared, hundreds of times more.
  Detector raw = detector;
  raw.nuc_frames = 0.0;
  EXPECT_GT(pattern_left(raw, 5e4), 100.0 * pattern_left(detector, 5e4));
}

TEST(Correction, TellsWhatIdealElementsWould) {
  Detector detector = uneven(1000000);
  detector.nonlinearity = 0.04;
  const auto at = [&](double radiance) { return moments(signal_image_corrected(detector, radiance)).mean; };
  // At the two lights exactly; between them nonlinearity, a parabola, is off by k n (well)^-1 (s - low)(high - s), told at its own slope.
  EXPECT_NEAR(at(1e4), 1e4 + 200.0, 3.0);
  EXPECT_NEAR(at(9e4), 9e4 + 200.0, 6.0);
  const double bend = 0.04 / 1e6, low = 10200.0, high = 90200.0, middle = 50200.0;
  const double slope = 1.0 - bend * (low + high);
  EXPECT_NEAR(at(5e4), middle + bend * (middle - low) * (high - middle) / slope, 5.0);
}

TEST(Correction, LeavesElementsThatDoNotAnswer) {
  Detector detector = uneven(64);
  detector.dead_share = 0.1;
  const std::vector<double> signal = signal_image_corrected(detector, 5e4);
  const auto dark = std::count_if(signal.begin(), signal.end(), [](double one) { return one < 2e4; });
  EXPECT_NEAR(static_cast<double>(dark) / static_cast<double>(signal.size()), 0.1, 0.012);
}

/// An element of a line scanner sees all lines, one of a whiskbroom all samples of its line of a sweep: so do faults and patterns.
TEST(ReadOut, SaysWhoseThePatternIs) {
  Detector detector;
  detector.electrons_per_radiance = 1.0, detector.full_well = 1e12;
  detector.prnu = 0.05, detector.dsnu = 1e6, detector.dead_share = 0.05;
  const std::vector<float> even(64, 1e8F);
  const auto lines_of = [&](ReadOut read_out) {
    const DetectorSignal of(detector, 3, 0, 64, read_out);
    std::vector<std::vector<double>> lines(8, std::vector<double>(64));
    for (int y = 0; y < 8; ++y) of.draw(y, even, {}, lines[static_cast<std::size_t>(y)]);
    return lines;
  };
  const auto apart = [](double a, double b) {
    return std::abs(a - b) > 2e5;
  };  // twenty times the photons' noise
  const auto frame = lines_of({}), line = lines_of({.kind = ReadOut::Kind::lines}),
             sweep = lines_of({.kind = ReadOut::Kind::sweeps, .elements = 4});
  int frames = 0, along = 0, across = 0;
  for (std::size_t x = 0; x < 64; ++x) {
    frames += apart(frame[0][x], frame[5][x]);
    along += apart(line[0][x], line[5][x]);
    across += apart(sweep[1][x], sweep[5][0]);
  }
  EXPECT_GT(frames, 50);
  EXPECT_EQ(along, 0);
  EXPECT_EQ(across, 0);
  EXPECT_TRUE(apart(sweep[1][0], sweep[2][0]));
}

}  // namespace
}  // namespace ifov::sensor::test_memory
