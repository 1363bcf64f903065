#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "io/spectra/channel_table.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_channels {
namespace {

std::vector<radiometry::Channel> read(const std::string& content) {
  const test::ScratchFile file("bands.txt", content);
  return read_channels(file.path());
}

std::string error_of(const std::string& content) {
  return test::input_error(content, [](const std::filesystem::path& path) { read_channels(path); });
}

TEST(ChannelTable, BlocksUnderBandComments) {
  const auto channels = read(
      ";; The Thermal Band RSR of x_band_average\n;; BAND 10\n;;\n9000 0 0.1\n10000 1 0.1\n11000 0 0.1\n"
      "# Satellite band 8A NIR\n\t12.0\t0\n\t13.0\t1\n\t14.0\t0\n");
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].name, "10");
  EXPECT_NEAR(channels[0].centre_um, 10.0, 1e-12);
  EXPECT_NEAR(channels[0].fwhm_um, 1.0, 1e-12);
  EXPECT_EQ(channels[1].name, "8A");
}

TEST(ChannelTable, ColumnsUnderAHeading) {
  const auto channels = read("nm,blue,red\n400,0,\n450,1,\n500,0,0\n600,,1\n700,,0\n");
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[1].name, "red");
  EXPECT_NEAR(channels[0].centre_um, 0.45, 1e-12);
  EXPECT_NEAR(channels[1].centre_um, 0.6, 1e-12);
}

TEST(ChannelTable, CentresAndWidths) {
  const auto channels = read("wavelength,fwhm\n402.0,2.4\n404.2,3.6\n");
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_NEAR(channels[1].centre_um, 0.4042, 1e-12);
  EXPECT_NEAR(channels[1].fwhm_um, 0.0036, 1e-12);
  EXPECT_EQ(channels[1].name, "2");
}

TEST(ChannelTable, ErrorsShowThePlace) {
  EXPECT_EQ(error_of("# BAND 1\n400 0\n450 x\n"), "FILE:3:5: found 'x'; expected a number\n  450 x\n      ^");
  EXPECT_EQ(error_of("# BAND 1\n400\n"),
            "FILE:2: found 1 numbers; expected a wavelength and a response\n  400");
  EXPECT_EQ(error_of("nm,a\n400,1\n410,1,2\n"),
            "FILE:3: found 3 columns; expected 2 as in the heading\n  410,1,2");
  EXPECT_EQ(error_of("nm,a,b\n400,1,\n410,1,\n"), "FILE:1: the channel 'b' has no values\n  nm,a,b");
  EXPECT_EQ(error_of("# BAND 3\n400 0\n410 0\n"),
            "FILE:2: channel '3': a response needs two wavelengths or more and a value above 0\n  400 0");
  EXPECT_EQ(error_of("wavelength,fwhm\n400,-1\n"),
            "FILE:2: channel '1': a Gaussian at 0.4 um with a width of -0.001 um is not possible\n  400,-1");
  EXPECT_EQ(error_of("# nothing\n"), "FILE: found no row of numbers; expected wavelengths and responses");
}

radiometry::Spectrum thuillier() {
  std::ifstream stream(*test::truth_file("sensors/solar/Thuillier2003.txt"));
  std::string line;
  std::getline(stream, line);
  std::vector<double> x, y;
  for (double a, b; stream >> a >> b;) {
    x.push_back(a / 1000.0);
    y.push_back(b);
  }
  return radiometry::Spectrum(x, y);
}

// Centroids and widths to 1e-5 um, solar irradiance to 0.1 %, radiance at 300 K to 0.01 %. The table treats
// gaps between rows (MODIS out of band, MODIS 1 and 9 to 11) and negative responses (ECOSTRESS) in another
// way than by a straight line and by 0, and thermal widths are of a finer grid: there the bounds are wider.
TEST(ChannelTable, ReferenceBands) {
  const auto table = test::truth_file("sensors/expected_bands.csv");
  if (!table) GTEST_SKIP() << "reference data not found: sensors/expected_bands.csv";
  const radiometry::Spectrum sun = thuillier();
  std::ifstream stream(*table);
  std::string line;
  std::getline(stream, line);
  std::map<std::string, std::vector<radiometry::Channel>> sensors;
  int bands = 0;
  while (std::getline(stream, line)) {
    std::erase(line, '\r');
    std::stringstream cells(line);
    std::string sensor, band, n, first, last, centroid, fwhm, esun, l300;
    for (std::string* cell : {&sensor, &band, &n, &first, &last, &centroid, &fwhm, &esun, &l300})
      std::getline(cells, *cell, ',');
    auto& channels = sensors[sensor];
    if (channels.empty())
      channels = read_channels(*test::truth_file("sensors/rsr-acolite/" + sensor + ".txt"));
    const auto found =
        std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == band; });
    ASSERT_NE(found, channels.end()) << sensor << ' ' << band;
    EXPECT_EQ(found->response.values().size(), std::stoul(n)) << sensor << ' ' << band;
    const bool differs = sensor == "Terra_MODIS" || sensor == "ISS_ECOSTRESS";
    EXPECT_NEAR(found->centre_um, std::stod(centroid), differs ? 4e-4 : 1e-5) << sensor << ' ' << band;
    EXPECT_NEAR(found->fwhm_um, std::stod(fwhm), esun == "nan" ? 3e-4 : 2e-5) << sensor << ' ' << band;
    if (esun != "nan") {
      EXPECT_NEAR(channel_mean(*found, sun) / std::stod(esun), 1.0, 1e-3) << sensor << ' ' << band;
    }
    if (!l300.empty()) {
      EXPECT_NEAR(channel_planck_w_m2_sr_um(*found, 300.0) / std::stod(l300), 1.0, 1e-4)
          << sensor << ' ' << band;
    }
    ++bands;
  }
  EXPECT_EQ(bands, 61);
}

TEST(ChannelTable, EveryReferenceFileReads) {
  const auto folder = test::truth_file("sensors/rsr-acolite");
  if (!folder) GTEST_SKIP() << "reference data not found: sensors/rsr-acolite";
  std::map<std::string, std::size_t> counts;
  for (const auto& entry : std::filesystem::directory_iterator(*folder))
    counts[entry.path().stem().string()] = read_channels(entry.path()).size();
  EXPECT_EQ(counts.at("WorldView3"), 17u);
  EXPECT_EQ(counts.at("PlanetScope_SD8"), 8u);
  EXPECT_EQ(counts.at("S3A_OLCI"), 21u);
  EXPECT_EQ(counts.at("L7_ETM"), 7u);
  EXPECT_EQ(counts.at("L5_TM_B6"), 1u);
  for (const char* name : {"desis", "emit", "enmap", "prisma"})
    EXPECT_GT(read_channels(*test::truth_file(std::string("sensors/channels/") + name + ".csv")).size(), 200u)
        << name;
}

}  // namespace
}  // namespace ifov::io::test_spectra_channels
