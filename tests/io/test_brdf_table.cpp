#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/format.h"
#include "io/spectra/brdf_table.h"

namespace ifov::io::test_brdf_table {
namespace {

constexpr const char* kTable =
    "# a tile\n"
    "light, view, azimuth, wavelength, BRDF\n"
    "30, 0, 0, 0.5, 0.11\n"
    "0, 0, 0, 0.5, 0.10\n"
    "0, 0, 180, 0.5, 0.10\n"
    "30, 0, 180, 0.5, 0.12\n";

std::string complaint(const std::string& text) {
  try {
    parse_brdf_table(TextFile("tile.csv", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BrdfTable, RowsMayStandInAnyOrder) {
  const materials::MeasuredBrdf table = parse_brdf_table(TextFile("tile.csv", kTable));
  ASSERT_EQ(table.zenith_in_rad.size(), 2u);
  EXPECT_NEAR(table.zenith_in_rad[1], std::numbers::pi / 6.0, 1e-12);
  ASSERT_EQ(table.zenith_out_rad.size(), 1u);
  ASSERT_EQ(table.azimuth_rad.size(), 2u);
  EXPECT_NEAR(table.azimuth_rad[1], std::numbers::pi, 1e-12);
  ASSERT_EQ(table.brdf.size(), 4u);
  EXPECT_EQ(table.at(1, 0, 0, 0, 0), 0.11);
  EXPECT_EQ(table.at(1, 0, 0, 1, 0), 0.12);
  EXPECT_EQ(table.at(0, 0, 0, 1, 0), 0.10);
}

TEST(BrdfTable, SixColumnsAreNotIsotropic) {
  std::string text = "light, azimuth, view, azimuth, wavelength, BRDF\n";
  for (const int light : {0, 30})
    for (const int azimuth : {270, 0, 90, 180})
      for (const int view : {10, 60, 80})
        for (const int other : {0, 180})
          text += format("{}, {}, {}, {}, 0.5, {:g}\n", light, azimuth, view, other,
                         1e-3 * (light + azimuth + view) + other);
  const materials::MeasuredBrdf table = parse_brdf_table(TextFile("cloth.csv", text));
  EXPECT_FALSE(table.is_isotropic());
  EXPECT_EQ(table.zenith_out_rad.size(), 3u);
  ASSERT_EQ(table.azimuth_in_rad.size(), 4u);
  EXPECT_NEAR(table.azimuth_in_rad[1], 0.5 * std::numbers::pi, 1e-12);
  EXPECT_EQ(table.azimuth_out_rad.size(), 2u);
  EXPECT_NEAR(table.at(1, 3, 2, 1, 0), 1e-3 * (30 + 270 + 80) + 180, 1e-9);
  EXPECT_NE(
      complaint(text + "30, 0, 10, 0.5, 0.1\n").find("found 5 columns; expected 6 as in the rows before"),
      std::string::npos);
  EXPECT_NE(complaint(text + "30, 360, 10, 0, 0.5, 0.1\n")
                .find("expected azimuth of the light in deg, 0 to below 360"),
            std::string::npos);
  EXPECT_NE(
      complaint(text + "30, 90, 10, 90, 0.5, 0.1\n")
          .find(
              "no row for light 0 deg in azimuth 0 deg, view 10 deg in azimuth 90 deg, 0.5 um: 49 rows, where every "
              "combination of 2 and 3 zenith angles, 4 and 3 azimuths and 1 wavelengths makes 72"),
      std::string::npos);
}

TEST(BrdfTable, MistakesAreLocated) {
  const std::string table = kTable;
  EXPECT_NE(complaint(table + "30, 0, 200, 0.5, 0.1\n").find("tile.csv:7:8: found '200'; expected azimuth"),
            std::string::npos)
      << complaint(table + "30, 0, 200, 0.5, 0.1\n");
  EXPECT_NE(complaint(table + "90, 0, 0, 0.5, 0.1\n").find("zenith angle of the light in deg, 0 to below 90"),
            std::string::npos);
  EXPECT_NE(
      complaint(table + "10, 0, 0, 0.5, -0.1\n").find("found '-0.1'; expected BRDF in 1/sr, at least 0"),
      std::string::npos);
  EXPECT_NE(complaint(table + "10, 0, 0, 0.5\n").find("tile.csv:7: found 4 columns; expected 5"),
            std::string::npos);
  EXPECT_NE(complaint(table + "30, 0, 0, 0.5, 0.11\n")
                .find("tile.csv:7: light 30 deg, view 0 deg, azimuth 0 deg, 0.5 um: given before, in line 3"),
            std::string::npos);
  EXPECT_NE(
      complaint(table + "30, 0, 0, 0.6, 0.11\n")
          .find(
              "no row for light 0 deg, view 0 deg, azimuth 0 deg, 0.6 um: 5 rows, where every combination of 2 and 1 "
              "zenith angles, 2 azimuths and 2 wavelengths makes 8"),
      std::string::npos)
      << complaint(table + "30, 0, 0, 0.6, 0.11\n");
  EXPECT_NE(complaint("# nothing\n").find("no row of numbers"), std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_brdf_table
