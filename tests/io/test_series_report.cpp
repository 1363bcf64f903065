#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "io/series_report/series_report.h"

namespace ifov::io::test_series_report {
namespace {

constexpr double kHour_s = 3600.0, kMidnight_s = 1782000000.0;

/// A day each quarter of an hour.
SeriesReport a_day() {
  SeriesReport report;
  for (int i = 0; i <= 96; ++i) report.time_s.push_back(kMidnight_s + 900.0 * i);
  return report;
}

template <class Curve>
void add(SeriesReport& report, const char* name, const Curve& kelvin) {
  SeriesReport::Material material;
  material.name = name;
  for (const double time_s : report.time_s) {
    material.pixels.push_back(9);
    material.brightness.mean_k.push_back(kelvin((time_s - kMidnight_s) / kHour_s));
    material.brightness.deviation_k.push_back(0.0);
  }
  report.materials.push_back(material);
}

double wave(double hour, double mean_k, double swing_k) {
  return mean_k - swing_k * std::cos(2.0 * std::numbers::pi * hour / 24.0);
}

TEST(SeriesCrossovers, WhereTwoWavesMeet) {
  SeriesReport report = a_day();
  add(report, "stone", [](double hour) { return wave(hour, 292.0, 5.0); });
  add(report, "metal", [](double hour) { return wave(hour, 290.0, 11.0); });
  const std::vector<SeriesReport::Crossover> found = crossovers_of(report);
  // 2 K = 6 K cos: a third.
  const double quarter_h = std::acos(-1.0 / 3.0) * 12.0 / std::numbers::pi;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].time_s, kMidnight_s + quarter_h * kHour_s, 3.0);
  EXPECT_NEAR(found[1].time_s, kMidnight_s + (24.0 - quarter_h) * kHour_s, 3.0);
  EXPECT_EQ(found[0].warmer, 1u);
  EXPECT_EQ(found[0].cooler, 0u);
  EXPECT_EQ(found[1].warmer, 0u);
  EXPECT_EQ(found[1].cooler, 1u);
}

TEST(SeriesCrossovers, NoiseOfEqualCurvesIsNone) {
  SeriesReport report = a_day();
  int i = 0;
  add(report, "one", [](double hour) { return wave(hour, 290.0, 5.0); });
  add(report, "another",
      [&](double hour) { return wave(hour, 290.0, 5.0) + (++i % 2 == 0 ? 0.9 : -0.9) * kApart_k; });
  EXPECT_TRUE(crossovers_of(report).empty());
  // A fault: without a least distance each time would be one.
  SeriesReport apart = a_day();
  i = 0;
  add(apart, "one", [](double hour) { return wave(hour, 290.0, 5.0); });
  add(apart, "another",
      [&](double hour) { return wave(hour, 290.0, 5.0) + (++i % 2 == 0 ? 1.1 : -1.1) * kApart_k; });
  EXPECT_EQ(crossovers_of(apart).size(), 96u);
}

TEST(SeriesCrossovers, TimesWithoutPixelsAreLeftOut) {
  SeriesReport report = a_day();
  add(report, "one", [](double) { return 290.0; });
  add(report, "another", [](double hour) {
    return hour > 5.9 && hour < 6.1 ? std::numeric_limits<double>::quiet_NaN() : 284.0 + hour;
  });
  const std::vector<SeriesReport::Crossover> found = crossovers_of(report);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].time_s, kMidnight_s + 6.0 * kHour_s, 1e-3);
}

TEST(SeriesCrossovers, OfTheSurfacesWhereTheseAreTold) {
  SeriesReport report = a_day();
  add(report, "one", [](double) { return 290.0; });
  add(report, "another", [](double) { return 291.0; });
  EXPECT_TRUE(crossovers_of(report).empty());
  report.tells_surface = true;
  for (SeriesReport::Material& material : report.materials) material.surface = material.brightness;
  for (std::size_t t = 50; t < report.time_s.size(); ++t) report.materials[1].surface.mean_k[t] = 289.0;
  const std::vector<SeriesReport::Crossover> found = crossovers_of(report);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].time_s, report.time_s[49] + 450.0, 1e-3);
  report.crossovers = found;
  EXPECT_NE(series_csv(report).find(": 'one' becomes warmer than 'another'\n"), std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_series_report
