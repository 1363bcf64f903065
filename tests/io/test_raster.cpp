#include <gtest/gtest.h>

#include <string>

#include "core/format.h"
#include "io/raster/raster.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_raster {
namespace {

using test::ScratchFile;

/// Whether this build reads files of GDAL's driver: IFOV_GDAL_DRIVERS may leave it out.
bool reads(const std::string& driver) {
  return (", " + raster_driver_list() + ",").find(", " + driver + ",") != std::string::npos;
}

const std::string kGrid =
    "ncols 3\nnrows 2\nxllcorner 100.0\nyllcorner 200.0\ncellsize 10.0\nNODATA_value -9\n1 2 3\n4 5.5 -9\n";

TEST(Raster, ReadsAnAsciiGrid) {
  const ScratchFile file("grid.asc", kGrid);
  const Raster raster = read_raster(file.path());
  EXPECT_EQ(raster.width, 3);
  EXPECT_EQ(raster.height, 2);
  EXPECT_EQ(raster.bands, 1);
  EXPECT_FLOAT_EQ(raster.at(0, 0, 2), 3.0f);
  EXPECT_FLOAT_EQ(raster.at(0, 1, 1), 5.5f);
  ASSERT_TRUE(raster.nodata.has_value());
  EXPECT_DOUBLE_EQ(*raster.nodata, -9.0);
  ASSERT_TRUE(raster.geotransform.has_value());
  EXPECT_DOUBLE_EQ((*raster.geotransform)[0], 100.0);
  EXPECT_DOUBLE_EQ((*raster.geotransform)[3], 220.0);
  EXPECT_DOUBLE_EQ((*raster.geotransform)[5], -10.0);
}

TEST(Raster, ABarePictureHasNoMap) {
  if (!reads("PNM")) GTEST_SKIP() << "built without GDAL's driver PNM (IFOV_GDAL_DRIVERS)";
  const ScratchFile file("p.pgm", std::string("P5\n2 2\n255\n") + '\x01' + '\x02' + '\x03' + '\x04');
  const Raster raster = read_raster(file.path());
  EXPECT_FALSE(raster.geotransform.has_value());
  EXPECT_FALSE(raster.nodata.has_value());
  EXPECT_FLOAT_EQ(raster.at(0, 1, 0), 3.0f);
}

TEST(Raster, OneBandOfSeveral) {
  if (!reads("PNM")) GTEST_SKIP() << "built without GDAL's driver PNM (IFOV_GDAL_DRIVERS)";
  const ScratchFile file("p.ppm", std::string("P6\n2 1\n255\n") + "\x01\x02\x03\x04\x05\x06");
  const Raster green = read_band(file.path(), 2, 2);
  EXPECT_EQ(green.bands, 1);
  EXPECT_EQ(green.values, (std::vector<float>{2.0f, 5.0f}));
  EXPECT_EQ(green.units.size(), 1u);
  EXPECT_EQ(read_raster(file.path()).values, (std::vector<float>{1.0f, 4.0f, 2.0f, 5.0f, 3.0f, 6.0f}));
  for (const int band : {0, 4})
    EXPECT_EQ(test::input_error(file.path(), [&](const auto& p) { read_band(p, band); }),
              "FILE has no band " + std::to_string(band) + "; it has 3");
  const RasterFrame frame = read_raster_frame(file.path());
  EXPECT_EQ(frame.cells(), 2u);
  EXPECT_EQ(frame.bands, 3);
  EXPECT_FALSE(frame.geotransform.has_value());
}

TEST(Raster, SizeIsCheckedFirst) {
  const ScratchFile file("grid.asc", kGrid);
  EXPECT_EQ(test::input_error(file.path(), [](const std::filesystem::path& p) { read_raster(p, 5); }),
            "FILE: a raster of 3 x 2 x 1 numbers is larger than the 5 that are read");
  EXPECT_NO_THROW(read_raster(file.path(), 6));
  const ScratchFile huge("huge.asc",
                         "ncols 2000000000\nnrows 2000000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
  EXPECT_THROW(read_raster(huge.path()), InputError);
}

TEST(Raster, OtherDriversAndVirtualFilesAreNotTried) {
  const ScratchFile grid("grid.asc", kGrid);
  const ScratchFile vrt("a.vrt",
                        "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Float32\" "
                        "band=\"1\"><SimpleSource><SourceFilename>" +
                            grid.path().string() +
                            "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>");
  EXPECT_NE(test::input_error(vrt.path(), [](const auto& p) { read_raster(p); })
                .find(format("not a raster of a kind that is read ({})", raster_driver_list())),
            std::string::npos);
  EXPECT_THROW(read_raster("/vsizip/a.zip/b.tif"), SystemError);
  EXPECT_THROW(read_raster("/nowhere/a.tif"), SystemError);
  EXPECT_THROW(read_raster(std::filesystem::temp_directory_path()), SystemError);
}

TEST(Raster, DamagedFilesAreErrors) {
  const auto file = test::truth_file("malformed/rasterio/corrupt.tif");
  if (!file) GTEST_SKIP() << "reference data not found: malformed/rasterio/corrupt.tif";
  EXPECT_NE(test::input_error(*file, [](const auto& p) { read_raster(p); }).find("the raster is damaged"),
            std::string::npos);
}

TEST(Raster, Jpeg2000IsRefusedWithAWayOut) {
  const ScratchFile file("a.jp2", std::string("\0\0\0\x0cjP  \r\n\x87\n", 12));
  EXPECT_EQ(test::input_error(file.path(), [](const auto& p) { read_raster(p); }),
            "FILE: JPEG 2000 is not read; turn it into a GeoTIFF first: gdal_translate a.jp2 a.tif");
}

TEST(Raster, BlocksMuchLargerThanTheRasterAreNotTakenMemoryFor) {
  EXPECT_EQ(
      test::input_error(
          std::filesystem::path(IFOV_SOURCE_DIR "/tests/fuzz/finds/geotiff/tile_much_larger_than_image.tif"),
          [](const auto& p) { read_raster(p); }),
      "FILE: the raster is damaged: its blocks have 16 x 65280 cells, it has 8 x 8");
}

TEST(Raster, ASmallFileThatAnnouncesALargeRasterIsRefusedFirst) {
  if (!reads("GSBG")) GTEST_SKIP() << "built without GDAL's driver GSBG (IFOV_GDAL_DRIVERS)";
  const std::filesystem::path find =
      IFOV_SOURCE_DIR "/tests/fuzz/finds/elevation/small_file_announces_165_million.grd";
  EXPECT_EQ(
      test::input_error(find, [](const auto& p) { read_raster(p); }),
      "FILE: the raster is damaged: " + find.string() +
          ", band 1: IReadBlock failed at X offset 0, Y offset 13156: Unable to read block from grid file.");
}

TEST(Raster, ATextTooShortForItsNumbersIsRefusedAtOnce) {
  EXPECT_EQ(test::input_error(
                std::filesystem::path(IFOV_SOURCE_DIR
                                      "/tests/fuzz/finds/elevation/small_file_announces_5_million_rows.asc"),
                [](const auto& p) { read_raster(p); }),
            "FILE: the raster is damaged: 323 bytes cannot hold 8 x 5399920 numbers");
}

TEST(Raster, CutFilesNeverCrash) {
  for (std::size_t length = 0; length < kGrid.size(); length += 3) {
    const ScratchFile file("cut.asc", kGrid.substr(0, length));
    try {
      read_raster(file.path());
    } catch (const InputError&) {
    }
  }
}

TEST(Raster, ReferenceElevations) {
  const auto file = test::truth_file("scenes/dem/dem.tif");
  if (!file) GTEST_SKIP() << "reference data not found: scenes/dem/dem.tif";
  const Raster raster = read_raster(*file);
  EXPECT_GT(raster.width, 1);
  EXPECT_FALSE(raster.projection.empty());
  EXPECT_TRUE(raster.geotransform.has_value());
}

}  // namespace
}  // namespace ifov::io::test_raster
