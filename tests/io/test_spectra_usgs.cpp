#include <gtest/gtest.h>

#include "io/spectra/usgs.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_usgs {
namespace {

const std::string kRows =
    "USGS Digital Spectral Library splib06a\n\nButlerite GDS25              W1R1Ba AREF\ncopy of splib05a r 1439\n"
    "       0.205100      -1.23e34        0.010460\n"
    "       0.221100       0.015736       0.001491\n"
    "       0.229100       0.013988       0.001296\n";
const std::string kWavelengths =
    " splib07a Record=1: Wavelengths ASD 0.35-2.5 microns 3 ch\n 0.35\n 0.36\n 0.37\n";
const std::string kColumn = " splib07a Record=13: Grass ASDFRa AREF\n 0.1\n -1.23e34\n 0.3\n";

std::string error_of(const std::string& text) {
  return test::input_error(text, [](const std::filesystem::path& path) { read_usgs(path); });
}

std::string column_error_of(const std::string& column, const std::string& wavelengths) {
  try {
    parse_usgs(TextFile("COLUMN", column), TextFile("WAVELENGTHS", wavelengths));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Usgs, Version6LeavesDeletedPointsOut) {
  const SampleSpectrum s = parse_usgs(TextFile("a.asc", kRows));
  EXPECT_EQ(s.name, "Butlerite GDS25              W1R1Ba AREF");
  EXPECT_EQ(s.quantity, SampleQuantity::reflectance);
  ASSERT_EQ(s.values.values().size(), 2u);
  EXPECT_DOUBLE_EQ(s.values.at(0.2211), 0.015736);
}

TEST(Usgs, Version7TakesWavelengthsFromTheirOwnFile) {
  const SampleSpectrum s = parse_usgs(TextFile("a.txt", kColumn), TextFile("w.txt", kWavelengths));
  EXPECT_EQ(s.name, "splib07a Record=13: Grass ASDFRa AREF");
  ASSERT_EQ(s.values.values().size(), 2u);
  EXPECT_DOUBLE_EQ(s.values.at(0.36), 0.2);  // a line across the deleted point
  const SampleSpectrum t =
      parse_usgs(TextFile("a.txt", "title TRAN\n0.1\n0.2\n0.3\n"), TextFile("w.txt", kWavelengths));
  EXPECT_EQ(t.quantity, SampleQuantity::transmittance);
}

TEST(Usgs, ErrorsShowThePlace) {
  EXPECT_EQ(
      error_of(kColumn),
      "FILE: found no row of wavelength, reflectance and standard deviation; a file of version 7 needs its file of "
      "wavelengths");
  EXPECT_EQ(error_of(kRows + " 0.24 0.1\n"),
            "FILE:8: found 2 columns; expected wavelength, reflectance and standard deviation\n   0.24 0.1");
  EXPECT_EQ(error_of(kRows + " 0.24 x 0.1\n"),
            "FILE:8:7: found 'x'; expected a number\n   0.24 x 0.1\n        ^");
  EXPECT_EQ(column_error_of(kColumn + "0.4\n", kWavelengths),
            "COLUMN: found 4 values; the file of wavelengths 'WAVELENGTHS' has 3");
  EXPECT_EQ(column_error_of("title\n", kWavelengths), "COLUMN: found no number below the title");
  EXPECT_EQ(column_error_of("", kWavelengths),
            "COLUMN: the file is empty; expected a title and a number a line");
  EXPECT_EQ(column_error_of("t\n-1.23e34\n-1.23e34\n-1.23e34\n", kWavelengths),
            "COLUMN: every point is marked as deleted");
}

TEST(Usgs, ReferenceFile) {
  const char* name = "spectra/usgs/butlerite_gds25.3947.asc";
  const auto file = test::truth_file(name);
  if (!file) GTEST_SKIP() << "reference data not found: " << name;
  const SampleSpectrum s = read_usgs(*file);
  EXPECT_DOUBLE_EQ(s.values.at(0.2211), 0.015736);
  EXPECT_DOUBLE_EQ(s.values.at(0.2291), 0.013988);
  EXPECT_NEAR(s.values.first_um(), 0.2211, 1e-9);
  EXPECT_DOUBLE_EQ(s.values.minimum(), -0.002868);  // noise of the measurement, at 2.912 um
  EXPECT_DOUBLE_EQ(s.values.at(2.912), -0.002868);
}

}  // namespace
}  // namespace ifov::io::test_spectra_usgs
