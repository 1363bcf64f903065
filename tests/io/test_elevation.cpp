#include <gtest/gtest.h>

#include <cmath>

#include "io/raster/elevation.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_elevation {
namespace {

using test::ScratchFile;

const std::string kHeader = "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n";

Elevation read(const std::string& rows, UnknownHeights unknown, std::optional<double> unit_m = {}) {
  const ScratchFile file("dem.asc", kHeader + rows);
  return read_elevation(file.path(), 1, unit_m, unknown);
}

TEST(Elevation, UnknownCellsAreCounted) {
  const Elevation holes = read("1 2 3\n4 -9999 6\n7 8 -9999\n", UnknownHeights::holes);
  EXPECT_EQ(holes.unknown, 2u);
  EXPECT_FALSE(holes.filled);
  EXPECT_TRUE(std::isnan(holes.height_m[4]));
  EXPECT_FLOAT_EQ(holes.height_m[5], 6.0f);
  EXPECT_FALSE(read("1 2 3\n4 5 6\n7 8 9\n", UnknownHeights::fill).filled);
}

TEST(Elevation, FilledByTheNearestInFourQuadrants) {
  // The mean of neighbours of one height is that height, of others one between them.
  const Elevation flat = read("2 2 2\n2 -9999 2\n2 2 2\n", UnknownHeights::fill);
  EXPECT_EQ(flat.unknown, 1u);
  EXPECT_TRUE(flat.filled);
  EXPECT_FLOAT_EQ(flat.height_m[4], 2.0f);
  const Elevation slope = read("1 2 3\n1 -9999 3\n1 2 3\n", UnknownHeights::fill);
  EXPECT_GT(slope.height_m[4], 1.0f);
  EXPECT_LT(slope.height_m[4], 3.0f);
  EXPECT_FLOAT_EQ(slope.height_m[3], 1.0f);
}

TEST(Elevation, UnitsAreThoseOfTheDocument) {
  const Elevation feet = read("10 0 0\n0 0 0\n0 0 0\n", UnknownHeights::holes, 0.3048);
  EXPECT_FLOAT_EQ(feet.height_m[0], 3.048f);
}

TEST(Elevation, NothingKnownIsAnError) {
  const ScratchFile file("dem.asc", kHeader + "-9999 -9999 -9999\n-9999 -9999 -9999\n-9999 -9999 -9999\n");
  const auto read_it = [](const auto& p) { read_elevation(p, 1, {}, UnknownHeights::holes); };
  EXPECT_EQ(test::input_error(file.path(), read_it), "FILE: no cell has a height");
  EXPECT_EQ(
      test::input_error(file.path(), [](const auto& p) { read_elevation(p, 2, {}, UnknownHeights::holes); }),
      "FILE has no band 2; it has 1");
}

TEST(Elevation, ReferenceModels) {
  for (const char* name : {"scenes/dem/dem_hd.tif", "scenes/dem/dem.tif", "scenes/dem/roi.tif"}) {
    const auto file = test::truth_file(name);
    if (!file) GTEST_SKIP() << "reference data not found: " << name;
    const Elevation terrain = read_elevation(*file, 1, {}, UnknownHeights::holes);
    EXPECT_GT(terrain.width, 1) << name;
    EXPECT_LT(terrain.unknown, terrain.height_m.size()) << name;
    EXPECT_FALSE(terrain.projection.empty()) << name;
  }
}

}  // namespace
}  // namespace ifov::io::test_elevation
