#include <gtest/gtest.h>

#include "io/atmosphere/import_paths.h"
#include "io/atmosphere/path_csv.h"
#include "io/files/input_file.h"
#include "io/spectra_files.h"

namespace ifov::io::test_path_csv {
namespace {

using Q = atmosphere::PathQuantity;

std::string error_of(const std::string& text) {
  try {
    parse_path_csv(TextFile("a.csv", text));
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(0, what.find('\n'));
  }
  return "no error";
}

TEST(PathCsv, ReadsWhatItWrites) {
  atmosphere::ImportedPath path("a", {0.4, 0.55, 2.5});
  path.set(Q::solar_path_radiance, {50.25, 20.5, 0.001});
  path.set(Q::spherical_albedo, {0.25, 0.125, 0.0});
  const atmosphere::ImportedPath read = parse_path_csv(TextFile("a.csv", path_csv(path)));
  for (const Q quantity : path.quantities())
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read.column(quantity)[i], path.column(quantity)[i]);
  EXPECT_EQ(read.quantities(), path.quantities());
}

TEST(PathCsv, UnitsOfTheSpectralColumnLeaveDensitiesAlone) {
  const test::ScratchFile file(
      "a.csv", "# by hand\nwavenumber_cm-1, total_radiance, spherical_albedo\n1000, 8.5,\n1010, 8.4,\n");
  const auto paths = import_paths(file.path());
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_DOUBLE_EQ(paths[0].column(Q::total_radiance)[1], 8.5);
  EXPECT_DOUBLE_EQ(paths[0].wavelength_um()[1], 10.0);
  EXPECT_FALSE(paths[0].has(Q::spherical_albedo));
}

// The example of the page on formats is read as it stands there.
TEST(PathCsv, ExampleInTheDocs) {
  const std::string page = read_input(IFOV_SOURCE_DIR "/docs/formats/atmosphere_import.md");
  const std::size_t begin = page.find("```\n") + 4;
  const auto path = parse_path_csv(TextFile("example", page.substr(begin, page.find("```", begin) - begin)));
  EXPECT_EQ(path.wavelength_um().size(), 2u);
  EXPECT_DOUBLE_EQ(path.column(Q::spherical_albedo)[1], 0.11);
  for (const std::string& name : atmosphere::path_quantity_names())
    EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name;
}

TEST(PathCsv, ErrorsShowThePlace) {
  EXPECT_EQ(error_of("lambda,total_radiance\n"),
            "a.csv:1:1: found the heading 'lambda'; expected 'wavelength_um', 'wavelength_nm' or "
            "'wavenumber_cm-1'");
  const std::string unknown = error_of("wavelength_um,total_radience\n");
  EXPECT_EQ(unknown.substr(0, 86),
            "a.csv:1:15: found the heading 'total_radience'; expected 'ground_sensor_transmittance'");
  EXPECT_EQ(unknown.substr(unknown.size() - 32), "; did you mean 'total_radiance'?");
  EXPECT_EQ(error_of("wavelength_um,total_radiance,total_radiance\n"),
            "a.csv:1:30: found 'total_radiance' twice; expected each column once");
  EXPECT_EQ(error_of("wavelength_um\n0.4\n"), "a.csv:1: found one column; expected at least two");
  EXPECT_EQ(error_of("wavelength_um,total_radiance\n"), "a.csv:1: found no rows below the heading");
  EXPECT_EQ(error_of("wavelength_um,total_radiance\n0.4,1,2\n"),
            "a.csv:2: found 3 columns; expected 2, as in the heading");
  EXPECT_EQ(error_of("wavelength_um,total_radiance\n0.4,1\n0.5,\n"),
            "a.csv:3:5: found nothing under total_radiance; expected a number, as in line 2");
  EXPECT_EQ(error_of("wavelength_um,total_radiance\n400,1\n-1,2\n"),
            "a.csv:3:1: found -1; expected a wavelength (um) between 0.01 and 100000 um");
  EXPECT_EQ(error_of("wavelength_um,spherical_albedo\n0.4,1.5\n"),
            "a.csv: found a spherical_albedo of 1.5 at 0.4 um; expected 0 to 1");
  EXPECT_EQ(error_of("FREQ TOT_TRANS DEPTH\n").find("a.csv:1:1: found the heading 'FREQ TOT_TRANS DEPTH'"),
            0u);
}

}  // namespace
}  // namespace ifov::io::test_path_csv
