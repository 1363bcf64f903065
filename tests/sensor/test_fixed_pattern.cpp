#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sensor/detector/detector.h"
#include "sensor/detector/detector_checks.h"
#include "sensor/detector/one_over_f.h"

namespace ifov::sensor::test_fixed_pattern {
namespace {

/// Bright enough for photons to be no matter.
constexpr double kBright = 1e10;

Detector patterned() {
  Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.prnu = 0.01;
  detector.row_gain = 0.004;
  detector.column_gain = 0.006;
  detector.dsnu = 40.0;
  detector.row_offset = 25.0;
  detector.column_offset = 60.0;
  return detector;
}

/// Of what is put in: wide images for columns, tall ones for rows.
void expect_out_as_put_in(const Detector& detector, double radiance, const PatternSpreads& in,
                          bool is_as_put_in) {
  const PatternSpreads wide = pattern_spreads(signal_image(detector, radiance, 40, 16000));
  const PatternSpreads tall = pattern_spreads(signal_image(detector, radiance, 16000, 40));
  const auto within = [](double found, double expected) { return std::abs(found / expected - 1.0) < 0.03; };
  EXPECT_TRUE(within(wide.pixel, in.pixel));
  EXPECT_TRUE(within(tall.row, in.row)) << tall.row;
  EXPECT_EQ(within(wide.column, in.column), is_as_put_in) << wide.column;
  EXPECT_EQ(within(tall.row / wide.column, in.row / in.column), is_as_put_in);
}

TEST(FixedPattern, IsOutAsPutInInLight) {
  Detector detector = patterned();
  detector.dsnu = detector.row_offset = detector.column_offset = 0.0;
  expect_out_as_put_in(detector, kBright, {1e8, 4e7, 6e7}, true);
}

TEST(FixedPattern, IsOutAsPutInInDarkness) { expect_out_as_put_in(patterned(), 0.0, {40, 25, 60}, true); }

TEST(FixedPattern, OfColumnsSixPercentMoreIsSeen) {
  Detector detector = patterned();
  detector.column_offset *= 1.06;
  expect_out_as_put_in(detector, 0.0, {40, 25, 60}, false);
}

TEST(FixedPattern, StaysFromExposureToExposureAndIsOfTheSpecimen) {
  const Detector detector = patterned();
  EXPECT_EQ(signal_image(detector, 0.0, 3, 50, 1).values, signal_image(detector, 0.0, 3, 50, 2).values);
  Detector other = detector;
  other.specimen = 2.0;
  EXPECT_NE(signal_image(detector, 0.0, 3, 50, 1).values, signal_image(other, 0.0, 3, 50, 1).values);
}

TEST(FixedPattern, DeadAndHotElementsAreAsMany) {
  Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.dead_share = 0.02;
  detector.hot_share = 0.01;
  detector.hot_dark = 1e6;
  const SignalImage found = signal_image(detector, 1000.0, 400, 1000);
  double dead = 0.0, hot = 0.0;
  for (const double value : found.values) dead += value == 0.0, hot += value > 1e5;
  EXPECT_NEAR(dead / 8000.0, 1.0, 4.0 / std::sqrt(8000.0));
  EXPECT_NEAR(hot / 4000.0, 1.0, 4.0 / std::sqrt(4000.0));
}

// ---------- 1/f

constexpr int kLines = 512, kColumns = 6000;

Detector drifting(double corner) {
  Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.read_noise = 10.0;
  detector.one_over_f = corner;
  return detector;
}

/// Largest departure of octaves from read_noise^2 corner / f, relative.
double farthest(const std::vector<double>& power, double corner) {
  double most = 0.0;
  for (std::size_t low = 4; low < power.size(); low *= 2) {
    double found = 0.0, expected = 0.0;
    for (std::size_t k = low; k < 2 * low && k < power.size(); ++k)
      found += power[k], expected += 100.0 * corner * kLines / static_cast<double>(k);
    most = std::max(most, std::abs(found / expected - 1.0));
  }
  return most;
}

TEST(OneOverF, HasTheSpectrumThatWasPutIn) {
  const std::vector<double> power =
      column_spectrum(one_over_f_noise(drifting(0.05), 1, 0, kLines, kColumns, 2), kLines);
  EXPECT_LT(farthest(power, 0.05), 0.03);
  EXPECT_GT(farthest(power, 0.05 / 1.06), 0.03);
}

TEST(OneOverF, ThatIsWhiteIsSeen) {
  std::vector<float> white(static_cast<std::size_t>(kLines) * kColumns);
  for (std::size_t k = 0; k < white.size(); ++k) white[k] = static_cast<float>(k % 2 ? 10.0 : -10.0);
  EXPECT_GT(farthest(column_spectrum(white, kLines), 0.05), 0.5);
}

TEST(OneOverF, IsTheSameForAnyThreadsAndNothingWhereNoiseIsWhite) {
  const Detector detector = drifting(0.1);
  const std::vector<float> one = one_over_f_noise(detector, 5, 2, 100, 33, 1);
  EXPECT_EQ(one, one_over_f_noise(detector, 5, 2, 100, 33, 7));
  EXPECT_NE(one, one_over_f_noise(detector, 6, 2, 100, 33, 1));
  EXPECT_TRUE(one_over_f_noise(drifting(0.0), 5, 2, 100, 33, 1).empty());
}

/// The two columns of one series have nothing to do with each other.
TEST(OneOverF, ColumnsAreIndependent) {
  const std::vector<float> noise = one_over_f_noise(drifting(0.05), 1, 0, 64, kColumns, 2);
  for (const std::size_t apart : {1u, 2u}) {
    double product = 0.0, square = 0.0;
    for (std::size_t y = 0; y < 64; ++y)
      for (std::size_t x = 0; x + apart < kColumns; x += 2) {
        product += noise[y * kColumns + x] * noise[y * kColumns + x + apart];
        square += noise[y * kColumns + x] * noise[y * kColumns + x];
      }
    // Neighbouring lines are alike: as many independent columns as there are, no more.
    EXPECT_LT(std::abs(product / square), 4.0 / std::sqrt(kColumns / 2)) << apart;
  }
}

}  // namespace
}  // namespace ifov::sensor::test_fixed_pattern
