// What `ifov brdf` prints, writes and draws of a report.
#include <gtest/gtest.h>

#include "io/brdf_report/brdf_report.h"
#include "math/angle.h"

namespace ifov::io::test_brdf_report {
namespace {

using math::kDegree;

/// A lobe about the mirror's direction, of this width, on a Lambertian floor.
BrdfReport lobe_report(double width_deg, double floor) {
  BrdfReport report;
  report.name = "panel";
  report.model = "ward";
  report.description = {"reflectance 0.3"};
  report.wavelength_um = 0.55;
  for (double deg = -89.0; deg <= 89.0; deg += 0.5) report.view_rad.push_back(deg * kDegree);
  const double peak = 1.0 / (width_deg * width_deg * kDegree * kDegree);
  const auto brdf = [&](double x_deg, double y_deg) {
    return floor + peak * std::exp(-(x_deg * x_deg + y_deg * y_deg) / (width_deg * width_deg));
  };
  for (const double light : {0.0, 30.0, 60.0}) {
    report.lobes.push_back({light * kDegree, {}});
    for (const double view : report.view_rad)
      report.lobes.back().brdf.push_back(brdf(view / kDegree + light, 0.0));
  }
  BrdfReport::Map map{30.0 * kDegree, 180, {}};
  for (int row = 0; row < map.side; ++row)
    for (int column = 0; column < map.side; ++column) {
      const double x = column + 0.5 - 90.0, y = 90.0 - (row + 0.5);
      map.brdf.push_back(std::hypot(x, y) > 90.0 ? std::nan("") : brdf(x + 30.0, y));
    }
  report.map = map;
  report.zenith_rad = {0.0, 30.0 * kDegree, 85.0 * kDegree};
  report.reflectance = {0.3, 0.31, 0.5};
  report.emissivity = {0.7, 0.69, 0.5};
  return report;
}

void add_spectra(BrdfReport& report) {
  report.spectrum_um = {0.4, 0.8, 2.0};
  report.spectra = {{0.0, {0.1, 0.3, 0.2}, {}, {0.9, 0.7, 0.8}},
                    {60.0 * kDegree, {0.2, 0.4, 0.3}, {}, {0.8, 0.6, 0.7}}};
}

int height_of(const std::string& png) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(png.at(at)); };
  return (byte(20) << 24) | (byte(21) << 16) | (byte(22) << 8) | byte(23);
}

TEST(BrdfReport, TableSaysAnglesAndNumbers) {
  const std::string text = brdf_text(lobe_report(10.0, 0.01));
  EXPECT_EQ(text.substr(0, text.find("\n\n")), "panel: ward, 0.55 um\n  reflectance 0.3");
  EXPECT_NE(text.find("  view deg   light from    0 deg     30 deg     60 deg\n"), std::string::npos) << text;
  // The mirror's direction of light from 30 deg is a view of -30 deg; 1 / (10 deg)^2 + 0.01.
  EXPECT_NE(text.find("\n       -30               0.014051     32.838   0.014051\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\n          85       0.50000       0.50000\n"), std::string::npos) << text;
}

TEST(BrdfReport, OfADeltaThereIsNoTableOfLobes) {
  BrdfReport report = lobe_report(10.0, 0.01);
  report.is_delta = true;
  report.lobes.clear();
  EXPECT_EQ(brdf_text(report).find("principal"), std::string::npos);
  EXPECT_NE(brdf_text(report).find("0.31000"), std::string::npos);
}

TEST(BrdfReport, CsvHasARowForEachNumber) {
  BrdfReport report = lobe_report(10.0, 0.01);
  add_spectra(report);
  report.spectra[1].transmittance = {0.01, 0.02, 0.03};
  const std::string csv = brdf_csv(report);
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = csv.find("\nbrdf,0.55,", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 3 * report.view_rad.size());
  EXPECT_NE(csv.find("\nreflectance,0.55,30,,0.31\n"), std::string::npos);
  EXPECT_NE(csv.find("\nemissivity,0.8,0,,0.7\n"), std::string::npos);
  EXPECT_NE(csv.find("\ntransmittance,2,60,,0.03\n"), std::string::npos);
  EXPECT_EQ(csv.find("transmittance,0.55"), std::string::npos);
}

TEST(BrdfReport, FigureShowsWhatThereIs) {
  BrdfReport report = lobe_report(10.0, 0.01);
  std::string png;
  try {
    png = brdf_figure(report);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png, brdf_figure(report));
  BrdfReport with_spectra = report;
  add_spectra(with_spectra);
  EXPECT_NE(png, brdf_figure(with_spectra));
  BrdfReport delta = report;
  delta.is_delta = true;
  delta.map.reset();
  EXPECT_LT(height_of(brdf_figure(delta)), height_of(png) / 2);
}

TEST(BrdfReport, FigureOfANarrowLobeShowsTheFloorBesideIt) {
  // On a linear axis both floors are a line at 0, and the pictures the same.
  const BrdfReport dim = lobe_report(0.5, 0.01), bright = lobe_report(0.5, 0.05);
  try {
    EXPECT_NE(brdf_figure(dim), brdf_figure(bright));
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
}

}  // namespace
}  // namespace ifov::io::test_brdf_report
