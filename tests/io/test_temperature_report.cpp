#include <gtest/gtest.h>

#include "io/temperature_report/temperature_report.h"

namespace ifov::io::test_temperature_report {
namespace {

/// Two materials that change places twice, at a third of the first step and in the middle of the third.
TemperatureReport made() {
  TemperatureReport report;
  report.document = "a.json";
  report.notes = {"weather: by hand"};
  for (int i = 0; i < 5; ++i) {
    report.time_s.push_back(1451606400.0 + 1800.0 * i);
    report.air_k.push_back(280.0);
  }
  const auto add = [&](const char* name, std::vector<double> kelvins) {
    TemperatureReport::Material material;
    material.name = name;
    material.description = {"a layer"};
    material.sunlit.surface_k = kelvins;
    material.shaded.surface_k = std::vector<double>(5, 275.0);
    thermal::Fluxes fluxes;
    fluxes.sun = 500.0;
    fluxes.emitted = -400.0;
    material.sunlit.fluxes = material.shaded.fluxes = std::vector<thermal::Fluxes>(5, fluxes);
    report.materials.push_back(material);
  };
  add("road", {279.0, 282.0, 282.0, 280.0, 279.0});
  add("lawn", {280.0, 280.0, 281.0, 281.0, 280.0});
  report.crossovers = crossovers_of(report);
  return report;
}

TEST(TemperatureReport, CrossoversBetweenRows) {
  const TemperatureReport report = made();
  ASSERT_EQ(report.crossovers.size(), 2u);
  EXPECT_NEAR(report.crossovers[0].time_s, 1451606400.0 + 600.0, 1e-6);
  EXPECT_EQ(report.crossovers[0].warmer, 0u);
  EXPECT_NEAR(report.crossovers[1].time_s, 1451606400.0 + 2.5 * 1800.0, 1e-6);
  EXPECT_EQ(report.crossovers[1].warmer, 1u);
}

TEST(TemperatureReport, TextHourByHour) {
  const std::string text = temperature_text(made());
  EXPECT_NE(
      text.find(
          "a.json: surfaces from 2016-01-01T00:00:00.000Z to 2016-01-01T02:00:00.000Z\n  weather: by hand\n"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("  01:00     6.85    8.85    1.85 |                      500.0     -400.0"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("  00:30"), std::string::npos) << text;
  EXPECT_NE(
      text.find("  00:10  'road' becomes warmer than 'lawn'\n  01:15  'lawn' becomes warmer than 'road'\n"),
      std::string::npos)
      << text;
}

TEST(TemperatureReport, CsvHasAllFluxes) {
  const std::string csv = temperature_csv(made());
  EXPECT_NE(
      csv.find(
          "\n\"road\",sunlit,2016-01-01T00:30:00.000Z,280.000,282.000,500.000,0.000,0.000,0.000,0.000,-400.000,"
          "0.000,0.000,0.000,-100.000\n"),
      std::string::npos)
      << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 1 + 2 + 2 + 2 + 1 + 20);
}

TEST(TemperatureReport, FigureIsAPicture) { EXPECT_EQ(temperature_figure(made()).substr(1, 3), "PNG"); }

}  // namespace
}  // namespace ifov::io::test_temperature_report
