#include <gtest/gtest.h>

#include "io/spectra/ems.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_ems {
namespace {

std::string weights() {
  std::string text;
  for (int degree = 0; degree <= 90; ++degree) text += "1.0\n";
  return text;
}

std::string error_of(const std::string& text) {
  return test::input_error(text, [](const std::filesystem::path& path) { read_ems(path); });
}

TEST(Ems, BothForms) {
  const EmsFile young =
      parse_ems(TextFile("n.ems", "1\n" + weights() + "CURVE_BEGIN\t\n0.35\t0.98\n14.9\t0.9\n\n\n"));
  ASSERT_EQ(young.curves.size(), 1u);
  EXPECT_EQ(young.weights.size(), 91u);
  EXPECT_DOUBLE_EQ(young.curves[0].at(0.35), 0.98);
  const EmsFile old =
      parse_ems(TextFile("o.ems", "2\n" + weights() + "0\n20000 0.5\n1000 0.9\n1\n20000 0.4\n1000 0.8\n"));
  ASSERT_EQ(old.curves.size(), 2u);
  EXPECT_DOUBLE_EQ(old.curves[0].at(10.0), 0.9);
  EXPECT_DOUBLE_EQ(old.curves[1].at(0.5), 0.4);
}

TEST(Ems, ErrorsShowThePlace) {
  EXPECT_EQ(error_of(""), "FILE: the file ends; expected the number of curves");
  EXPECT_EQ(error_of("1\n1.0\n"), "FILE: the file ends; expected the weight at 1 degrees");
  EXPECT_EQ(error_of("0\n" + weights()),
            "FILE:1: found 0 curves; expected a whole number from 1 to 100000\n  0");
  EXPECT_EQ(error_of("2\n" + weights() + "CURVE_BEGIN\n0.4 1\n"),
            "FILE: the file ends; expected curve 2 of 2");
  EXPECT_EQ(error_of("1\n" + weights() + "CURVE_BEGIN\n0.4 1 1\n"),
            "FILE:94: found 3 columns; expected a wavelength and an emissivity\n  0.4 1 1");
  EXPECT_EQ(error_of("1\n" + weights() + "CURVE_BEGIN\n0.4 1\nCURVE_BEGIN\n0.4 1\n"),
            "FILE:95: found more after the last of 1 curves\n  CURVE_BEGIN");
}

TEST(Ems, ReferenceFiles) {
  const auto grass = test::truth_file("scenes/dirsig-format/grass_texture.ems");
  const auto water = test::truth_file("scenes/dirsig-format/muddy_water.ems");
  const auto ideal = test::truth_file("scenes/dirsig-format/ideal_mat_5.ems");
  if (!grass || !water || !ideal) GTEST_SKIP() << "reference data not found: scenes/dirsig-format";
  const EmsFile many = read_ems(*grass);
  ASSERT_EQ(many.curves.size(), 43u);
  for (const radiometry::Spectrum& curve : many.curves) EXPECT_EQ(curve.values().size(), 396u);
  EXPECT_NEAR(many.curves.back().at(1e4 / 350.0), 0.950167, 1e-9);
  EXPECT_EQ(read_ems(*water).curves.size(), 1u);
  EXPECT_DOUBLE_EQ(read_ems(*ideal).curves.at(0).at(0.35), 0.6);
}

}  // namespace
}  // namespace ifov::io::test_spectra_ems
