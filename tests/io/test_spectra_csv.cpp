#include <gtest/gtest.h>

#include "io/spectra/csv_spectrum.h"
#include "io/spectra_files.h"

namespace ifov::io::test_spectra_csv {
namespace {

using test::ScratchFile;

radiometry::Spectrum read(const std::string& content, const CsvSpectrumOptions& options = {}) {
  const ScratchFile file("table.csv", content);
  return read_csv_spectrum(file.path(), options);
}

std::string error_of(const std::string& content, const CsvSpectrumOptions& options = {}) {
  return test::input_error(content,
                           [&](const std::filesystem::path& path) { read_csv_spectrum(path, options); });
}

TEST(CsvSpectrum, AnySeparator) {
  for (const char* content :
       {"0.4,0.1\n0.5,0.3\n", "0.4;0.1\n0.5;0.3\n", "0.4\t0.1\n0.5\t0.3\n", "  0.4   0.1\r\n  0.5 \t 0.3\r\n",
        "# a comment\n\nwavelength, reflectance\n0.4 , 0.1\n// another\n0.5 , 0.3",
        "\xef\xbb\xbf"
        "0.4,\"0.1\"\r0.5,\"0.3\"\r",
        "Reflectance of a leaf, measured in 2001; see text\nwavelength value\n0.4 0.1\n0.5 0.3\n",
        "0.5,0.3\n0.4,0.1\n"}) {
    const auto s = read(content);
    EXPECT_DOUBLE_EQ(s.at(0.45), 0.2) << content;
    EXPECT_DOUBLE_EQ(s.first_um(), 0.4) << content;
  }
}

TEST(CsvSpectrum, UnitsColumnsAndScale) {
  CsvSpectrumOptions options;
  options.unit = WavelengthUnit::nanometres;
  options.value_name = "oak";
  options.scale = 0.01;
  EXPECT_NEAR(read("nm,grass,oak\n400,1,10\n500,2,30\n", options).at(0.45), 0.2, 1e-15);
  options.unit = parse_wavelength_unit("cm-1");
  options.value_name.clear();
  options.value_column = 3;
  EXPECT_NEAR(read("1000,0,10\n2000,0,30\n", options).at(5.0), 0.3, 1e-15);
  options.wavelength_column = 2;
  options.value_column = 1;
  EXPECT_NEAR(read("10,1000\n30,2000\n", options).at(10.0), 0.1, 1e-15);
}

TEST(CsvSpectrum, ErrorsShowThePlace) {
  EXPECT_EQ(error_of("0.4,0.1\n0.5,O.3\n"), "FILE:2:5: found 'O.3'; expected a number\n  0.5,O.3\n      ^");
  EXPECT_EQ(error_of("0.4,0.1\n0.5\n"), "FILE:2: found 1 columns; column 2 is wanted\n  0.5");
  EXPECT_EQ(
      error_of("0.4,0.1\n0.5,0.2\n0.45,0.3\n"),
      "FILE:3: found a wavelength out of order; expected rows that ascend or descend throughout\n  0.45,0.3");
  EXPECT_EQ(error_of("0.5,0.1\n0.4,0.2\n0.4,0.3\n"),
            "FILE:3: found a wavelength twice; expected each once\n  0.4,0.3");
  EXPECT_EQ(error_of("-0.4,0.1\n"),
            "FILE:1:1: found a wavelength of -0.4; expected one above 0\n  -0.4,0.1\n  ^");
  EXPECT_EQ(error_of("nothing here\n"), "FILE: found no row of numbers; expected wavelengths and values");
  EXPECT_EQ(error_of(""), "FILE: found no row of numbers; expected wavelengths and values");
  EXPECT_EQ(error_of("0.4,nan\n"), "FILE:1:5: found 'nan'; expected a number\n  0.4,nan\n      ^");
  CsvSpectrumOptions options;
  options.value_name = "elm";
  EXPECT_EQ(error_of("um,grass,oak\n0.4,1,2\n", options),
            "FILE:1: no column is called 'elm'; there are 'um', 'grass', 'oak'\n  um,grass,oak");
}

TEST(CsvSpectrum, MissingFilesAndUnits) {
  EXPECT_THROW(read_csv_spectrum("/nowhere/at/all.csv"), SystemError);
  EXPECT_THROW(read_csv_spectrum(std::filesystem::temp_directory_path()), SystemError);
  EXPECT_THROW(parse_wavelength_unit("inch"), InputError);
}

// Every way of cutting or spoiling a small file by one byte either reads or is an InputError.
TEST(CsvSpectrum, SpoiledFilesNeverCrash) {
  const std::string good = "# c\nwl;r\n400;0.1\n500;0.2\n600;0.3\n";
  int read_ones = 0, refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char symbol : {'\0', '\n', ';', '-', 'x', '9', '\xff'}) {
      std::string spoiled = good;
      spoiled[at] = symbol;
      for (const std::string& text : {spoiled, good.substr(0, at)})
        (error_of(text) == "no error" ? read_ones : refused)++;
    }
  EXPECT_GT(read_ones, 100);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace ifov::io::test_spectra_csv
