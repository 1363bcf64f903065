#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "io/spectra/brdf_table.h"

namespace ifov::io {
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
  EXPECT_EQ(table.at(1, 0, 0, 0), 0.11);
  EXPECT_EQ(table.at(1, 0, 1, 0), 0.12);
  EXPECT_EQ(table.at(0, 0, 1, 0), 0.10);
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
}  // namespace ifov::io
