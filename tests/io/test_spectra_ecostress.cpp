#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "io/spectra/ecostress.h"
#include "io/spectra/sample_spectrum.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_ecostress {
namespace {

const std::string kGood =
    "Name: Beach sand, 60\xb5m\n"
    "Description:  Sand from the shore\n"
    "that goes on: over a second line\n"
    "Measurement: Directional hemispherical\n\n"
    "X Units: Wavelength (micrometers)\nY Units:Reflectance (percent)\n"
    "First X Value: 14.0\nLast X Value: 0.4\nNumber of X Values: 3\nAdditional Information: none\n\n"
    "  14.0000\t   2.5\n   2.0000\t  40.0\n   0.4000\t  -0.1\n";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string error_of(const std::string& content) {
  return test::input_error(content, [](const std::filesystem::path& path) { read_ecostress(path); });
}

TEST(Ecostress, DescendingPercentLatin1WrappedHeader) {
  const test::ScratchFile file("a.spectrum.txt", kGood);
  const LibrarySpectrum s = read_ecostress(file.path());
  EXPECT_EQ(s.name, "Beach sand, 60\xc2\xb5m");
  EXPECT_EQ(s.measurement, "Directional hemispherical");
  EXPECT_DOUBLE_EQ(s.reflectance.first_um(), 0.4);
  EXPECT_DOUBLE_EQ(s.reflectance.at(14.0), 0.025);
  EXPECT_DOUBLE_EQ(s.reflectance.at(0.4), 0.0);  // noise below 0
}

TEST(Ecostress, ErrorsShowThePlace) {
  EXPECT_EQ(error_of(replaced("Number of X Values: 3", "Number of X Values: 4")),
            "FILE:10: the header states '4' values; found 3\n  Number of X Values: 4");
  EXPECT_EQ(error_of(replaced("40.0", "4o.0")),
            "FILE:14:13: found '4o.0'; expected a number\n     2.0000   4o.0\n              ^");
  EXPECT_EQ(error_of(replaced("40.0", "140.0")),
            "FILE:14:13: found a reflectance of 1.4; expected 0 to 1\n     2.0000   140.0\n              ^");
  EXPECT_EQ(error_of(replaced("(percent)", "(furlongs)")),
            "FILE:7: found an unknown unit of reflectance; expected percent or a fraction\n"
            "  Y Units:Reflectance (furlongs)");
  EXPECT_EQ(error_of(replaced("Reflectance (percent)", "Transmittance (percent)")),
            "FILE:7: found a transmittance; expected a reflectance\n  Y Units:Transmittance (percent)");
  EXPECT_EQ(error_of(replaced("First X Value: 14.0", "First X Value: 15.0")),
            "FILE:8: the header states '15.0'; found 14 um\n  First X Value: 15.0");
  EXPECT_EQ(error_of(replaced("X Units: Wavelength (micrometers)\n", "")),
            "FILE: the header has no 'X Units:' line");
  EXPECT_EQ(error_of(replaced("2.0000", "15.000")),
            "FILE:15: found a wavelength out of order; expected rows that ascend or descend throughout\n"
            "     0.4000   -0.1");
  EXPECT_EQ(error_of("Name: x\n"), "FILE: the header has no 'X Units:' line");
}

TEST(Ecostress, FractionsStay) {
  std::string text = replaced("Reflectance (percent)", "Reflectance (fraction)");
  text.replace(text.find("2.5"), 3, "0.2");
  text.replace(text.find("40.0"), 4, "0.40");
  text.replace(text.find("-0.1"), 4, "0.01");
  const test::ScratchFile file("f.spectrum.txt", text);
  EXPECT_DOUBLE_EQ(read_ecostress(file.path()).reflectance.at(2.0), 0.4);
}

TEST(Ecostress, JoinTakesTheThermalPartFromItsStart) {
  const radiometry::Spectrum vswir({0.4, 2.4, 2.5}, {0.1, 0.2, 0.3}), tir({2.45, 14.0}, {0.6, 0.7});
  const radiometry::Spectrum both = join(vswir, tir);
  EXPECT_EQ(both.wavelength_um().size(), 4u);
  EXPECT_DOUBLE_EQ(both.at(2.4), 0.2);
  EXPECT_DOUBLE_EQ(both.at(2.45), 0.6);
  EXPECT_DOUBLE_EQ(both.at(14.0), 0.7);
  EXPECT_THROW(join(tir, vswir), InputError);
  EXPECT_THROW(join(radiometry::Spectrum::constant(0.1), tir), InputError);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  cells.resize(17);  // an empty last cell makes none
  return cells;
}

TEST(Ecostress, ReferenceValues) {
  const auto table = test::truth_file("spectra/expected_ecostress.csv");
  if (!table) GTEST_SKIP() << "reference data not found: spectra/expected_ecostress.csv";
  std::ifstream stream(*table);
  std::string line;
  std::getline(stream, line);
  int files = 0, values = 0;
  while (std::getline(stream, line)) {
    std::erase(line, '\r');
    const auto cells = cells_of(line);
    const auto reflectance = read_ecostress(*test::truth_file("spectra/ecostress/" + cells[0])).reflectance;
    EXPECT_EQ(reflectance.values().size(), std::stoul(cells[1])) << cells[0];
    EXPECT_NEAR(reflectance.first_um(), std::stod(cells[4]), 6e-5) << cells[0];
    EXPECT_NEAR(reflectance.last_um(), std::stod(cells[5]), 6e-5) << cells[0];
    EXPECT_NEAR(reflectance.minimum(), std::stod(cells[8]) / 100.0, 1e-5) << cells[0];
    EXPECT_NEAR(reflectance.maximum(), std::stod(cells[9]) / 100.0, 1e-5) << cells[0];
    const double wavelengths[] = {0.55, 0.86, 1.65, 2.2, 10.9};
    for (std::size_t i = 0; i < 5; ++i)
      if (!cells[11 + i].empty()) {
        EXPECT_NEAR(reflectance.at(wavelengths[i]), std::stod(cells[11 + i]), 1e-5) << cells[0];
        ++values;
      }
    if (!cells[16].empty()) {
      EXPECT_NEAR(1.0 - radiometry::integral(reflectance, 8.0, 12.0) / 4.0, std::stod(cells[16]), 1e-5)
          << cells[0];
    }
    ++files;
  }
  EXPECT_EQ(files, 45);
  EXPECT_GT(values, 150);
}

TEST(Ecostress, AsterFilesHaveEmptyLinesInTheHeader) {
  const char* name = "spectra/aster-v2/jhu.becknic.vegetation.trees.conifers.solid.conifer.spectrum.txt";
  const auto file = test::truth_file(name);
  if (!file) GTEST_SKIP() << "reference data not found: " << name;
  const LibrarySpectrum s = read_ecostress(*file);
  EXPECT_EQ(s.reflectance.values().size(), 550u);
  EXPECT_NEAR(s.reflectance.maximum(), 0.52485, 1e-9);
}

TEST(Ecostress, HalvesJoin) {
  const auto vswir =
      test::truth_file("spectra/ecostress/vegetation.grass.avena.fatua.vswir.vh352.ucsb.asd.spectrum.txt");
  const auto tir =
      test::truth_file("spectra/ecostress/vegetation.grass.avena.fatua.tir.vh352.ucsb.nicolet.spectrum.txt");
  if (!vswir || !tir) GTEST_SKIP() << "reference data not found: spectra/ecostress";
  const auto joined = join(read_ecostress(*vswir).reflectance, read_ecostress(*tir).reflectance);
  EXPECT_NEAR(joined.first_um(), 0.35, 1e-9);
  EXPECT_GT(joined.last_um(), 15.0);
  EXPECT_EQ(joined.values().size(), 2151u + 1736u);
}

TEST(Ecostress, CutFilesNeverCrash) {
  for (std::size_t length = 0; length < kGood.size(); ++length) {
    const std::string error = error_of(kGood.substr(0, length));
    // The last number may lose its last digit and still be one.
    if (length + 3 < kGood.size()) {
      EXPECT_NE(error, "no error") << length;
    }
  }
}

}  // namespace
}  // namespace ifov::io::test_spectra_ecostress
