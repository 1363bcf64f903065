#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "io/spectra/envi_library.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_envi_library {
namespace {

std::string header(const std::string& type, const std::string& order = "0", const std::string& more = {}) {
  return "ENVI\nsamples = 3\nlines = 2\nbands = 1\nheader offset = 0\nfile type = ENVI Spectral Library\ndata type = " +
         type + "\ninterleave = bsq\nbyte order = " + order +
         "\nwavelength units = Nanometers\nspectra names = {\n roof, \n lawn}\nwavelength = {400, 500,\n 600}\n" +
         more;
}

template <class T>
std::string data_of(const std::vector<T>& values, bool swapped = false) {
  std::string bytes;
  for (const T value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (swapped) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

template <class T>
void expect_values(const std::string& type) {
  for (const bool swapped : {false, true}) {
    const EnviLibrary library(header(type, swapped ? "1" : "0", "reflectance scale factor = 100\n"), "a.hdr",
                              data_of<T>({T(1), T(2), T(3), T(40), T(50), T(60)}, swapped), "a.sli");
    EXPECT_EQ(library.names(), (std::vector<std::string>{"roof", "lawn"}));
    EXPECT_NEAR(library.spectrum(0).at(0.5), 0.02, 1e-9) << type;
    EXPECT_NEAR(library.spectrum(library.index_of("lawn")).at(0.6), 0.6, 1e-7) << type;
  }
}

std::string error_of(const std::string& head, const std::string& data) {
  try {
    const EnviLibrary library(head, "a.hdr", data, "a.sli");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EnviLibrary, EveryTypeAndByteOrder) {
  expect_values<std::uint8_t>("1");
  expect_values<std::int16_t>("2");
  expect_values<std::int32_t>("3");
  expect_values<float>("4");
  expect_values<double>("5");
  expect_values<std::uint16_t>("12");
  expect_values<std::uint32_t>("13");
}

TEST(EnviLibrary, BadChannelsAreLeftOut) {
  const EnviLibrary library(header("4", "0", "bbl = {1, 0, 1}\n"), "a.hdr",
                            data_of<float>({1, 99, 3, 4, 99, 6}), "a.sli");
  EXPECT_NEAR(library.spectrum(0).at(0.5), 2.0, 1e-6);
}

TEST(EnviLibrary, ErrorsNameTheFile) {
  const std::string data = data_of<float>({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(error_of(header("4"), data.substr(1)),
            "a.sli: the file has 23 bytes; 2 spectra of 3 values need 24");
  std::string plain = header("4");
  plain.replace(plain.find("ENVI Spectral Library"), 21, "ENVI Standard");
  EXPECT_NE(error_of(plain, data), "no error");
  std::string short_names = header("4");
  short_names.replace(short_names.find(", \n lawn"), 8, "");
  EXPECT_EQ(error_of(short_names, data), "a.hdr: \"spectra names\" has 1 items for 2 spectra");
  const EnviLibrary library(header("4"), "a.hdr", data, "a.sli");
  EXPECT_EQ(test::input_error(std::string(), [&](const auto&) { library.index_of("lown"); }),
            "no spectrum of 'a.hdr' is called 'lown'; did you mean 'lawn'? It holds 'roof' and 'lawn'");
  EXPECT_EQ(test::input_error(std::string(), [&](const auto&) { library.index_of("quartz"); }),
            "no spectrum of 'a.hdr' is called 'quartz'; it holds 'roof' and 'lawn'");
  EXPECT_EQ(test::input_error(std::string(), [&](const auto&) { library.index_of(3); }),
            "'a.hdr' has no spectrum 3; it holds 1 to 2");
}

TEST(EnviLibrary, ReferenceFiles) {
  const auto berlin = test::truth_file("spectra/envi-sli/library_berlin.sli");
  const auto gamsberg = test::truth_file("spectra/envi-sli/gamsberg_field_library.hdr");
  if (!berlin || !gamsberg) GTEST_SKIP() << "reference data not found: spectra/envi-sli";
  const EnviLibrary urban = read_envi_library(*berlin);
  ASSERT_EQ(urban.names().size(), 75u);
  EXPECT_EQ(urban.names()[15], "white roof material (polyethylene)");
  // Value 20 of row 30 as the file's own bytes have it.
  std::ifstream stream(*berlin, std::ios::binary);
  stream.seekg((30 * 177 + 20) * 8);
  double value = 0.0;
  stream.read(reinterpret_cast<char*>(&value), sizeof value);
  EXPECT_DOUBLE_EQ(urban.spectrum(30).values()[20], value);
  EXPECT_NEAR(urban.spectrum(30).first_um(), 0.46, 1e-9);
  EXPECT_NEAR(urban.spectrum(30).last_um(), 2.409, 1e-9);
  const EnviLibrary field = read_envi_library(*gamsberg);
  ASSERT_EQ(field.names().size(), 27u);
  EXPECT_EQ(field.names().back(), "05_03_12_1_C1_amphibolite");
  EXPECT_NEAR(field.spectrum(0).first_um(), 0.35, 1e-9);
  EXPECT_NEAR(field.spectrum(0).maximum(), 0.36162176728, 1e-9);
}

}  // namespace
}  // namespace ifov::io::test_spectra_envi_library
