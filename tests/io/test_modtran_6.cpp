#include <gtest/gtest.h>

#include <numbers>

#include "io/atmosphere/import_paths.h"
#include "io/atmosphere/modtran_csv.h"
#include "io/atmosphere/modtran_json.h"
#include "io/spectra_files.h"
#include "support/truth_data.h"

namespace ifov::io::test_modtran_6 {
namespace {

using Q = atmosphere::PathQuantity;

std::vector<ModtranRun> parse(const std::string& text) { return parse_modtran_csv(TextFile("a.csv", text)); }

template <class Act>
std::string error_of(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(0, what.find('\n'));
  }
  return "no error";
}

std::string csv_error(const std::string& text) {
  return error_of([&] { parse(text); });
}

std::string json_error(const std::string& text) {
  return error_of([&] { parse_modtran_json(text, "a.json"); });
}

const std::string kNames =
    "Freq (cm-1), tot_trans, thrml_em, thrml_sct, surf_emis, mult_scat, sing_scat, grnd_rflt, total_rad\n";
const std::string kRows =
    "2050.0, 0.9, 1.0e-8, 2.0e-9, 3.0e-8, 1.0e-9, 5.0e-10, 4.0e-9, 4.75e-8\n"
    "2051.0, 0.8, 2.0e-8, 2.0e-9, 3.0e-8, 1.0e-9, 5.0e-10, 4.0e-9, 5.75e-8\n";

TEST(Modtran6Csv, PartsAddUp) {
  const auto runs = parse(kNames + kRows);
  ASSERT_EQ(runs.size(), 1u);
  const auto& path = runs[0].path;
  EXPECT_NEAR(path.column(Q::thermal_path_radiance)[1], 1.2e-8 * 2050.0 * 2050.0, 1e-9);
  EXPECT_NEAR(path.column(Q::solar_path_radiance)[1], 1.5e-9 * 2050.0 * 2050.0, 1e-9);
  EXPECT_NEAR(path.column(Q::single_scatter_path_radiance)[1], 5e-10 * 2050.0 * 2050.0, 1e-9);
}

// Where MULT_SCAT holds all of the scattered light, the total says so.
TEST(Modtran6Csv, TheTotalTellsWhatThePartsHold) {
  const auto runs = parse(
      "Freq (cm-1), tot_trans, thrml_em, thrml_sct, surf_emis, mult_scat, sing_scat, grnd_rflt, total_rad\n"
      "20000, 0.9, 0, 0, 0, 5.0e-9, 4.0e-9, 4.0e-9, 9.0e-9\n");
  EXPECT_NEAR(runs[0].path.column(Q::solar_path_radiance)[0], 5e-9 * 2e4 * 2e4, 1e-9);
  EXPECT_NEAR(runs[0].path.column(Q::single_scatter_path_radiance)[0], 4e-9 * 2e4 * 2e4, 1e-9);
}

// Names of the JSON output and of the spectral libraries, a line of units, several cases in one file.
TEST(Modtran6Csv, OtherSpellingsUnitsAndCases) {
  const std::string text =
      "case 0: nadir\nwavelength,total transmittance,path emission,path multiple scat,path single scat,total "
      "radiance,\n"
      "nm,,W cm-2 sr-1 nm-1,W cm-2 sr-1 nm-1,W cm-2 sr-1 nm-1,W cm-2 sr-1 nm-1,\n"
      "400,0.5,0,1e-7,2e-7,3e-7,\n401,0.5,0,1e-7,2e-7,3e-7,\n\n"
      "case 1: slant\nwavelength,total transmittance,path emission,path multiple scat,path single scat,total "
      "radiance,\n"
      "nm,,,,,,\n400,0.4,0,2e-7,2e-7,4e-7,\n401,0.4,0,2e-7,2e-7,4e-7,\n-9999,,,,,,\n";
  const auto runs = parse(text);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_NEAR(runs[0].path.column(Q::total_radiance)[0], 3.0, 1e-12);  // 1e4 cm2 per m2, 1e3 nm per um
  EXPECT_NEAR(runs[1].path.column(Q::solar_path_radiance)[1], 4.0, 1e-12);
  EXPECT_EQ(runs[1].path.source(), "a.csv, case at line 8");
  const test::ScratchFile file("a.csv", text);
  EXPECT_EQ(import_paths(file.path()).size(), 2u);
}

TEST(Modtran6Csv, ErrorsShowThePlace) {
  EXPECT_EQ(csv_error("wavelength,total_rad\n1,2\n"),
            "a.csv:1:1: found no unit of the spectral column; expected cm-1, nm or um in its heading or in "
            "the line "
            "below");
  EXPECT_EQ(csv_error(kNames + "2050.0, 0.9\n"),
            "a.csv:2: found 2 columns; expected 9, as in the heading of line 1");
  EXPECT_EQ(csv_error(kNames), "a.csv:1: found no rows below this heading");
  EXPECT_EQ(
      csv_error("Freq (cm-1), depth\n1,2\n"),
      "a.csv:1: found headings without total transmittance, total radiance or transmitted solar irradiance; "
      "expected one of them");
  EXPECT_EQ(
      csv_error("wavelength,total_rad\nnm,W m-2 sr-1 um-1\n400,1\n"),
      "a.csv:2:4: found the unit 'W m-2 sr-1 um-1'; expected W cm-2 (sr-1) per nm, the unit of the spectral "
      "column");
  EXPECT_EQ(
      csv_error("1,2\n3,4\n"),
      "a.csv:1: found numbers where a heading was expected, such as 'Freq (cm-1), tot_trans, total_rad'");
  EXPECT_EQ(csv_error("1ST SPECTRAL  LOS CHAN\n"),
            "a.csv: found no heading that begins with Freq or Wavelength; expected a table of MODTRAN 6 "
            "(.csv); the "
            "file looks like a MODTRAN channel file (.chn)");
  std::string wrong = kNames + kRows;
  wrong.replace(wrong.find("4.75e-8"), 7, "4.75e-9");
  EXPECT_NE(csv_error(wrong).find("the parts of the radiance add up to"), std::string::npos);
}

TEST(Modtran6Json, ReferenceCases) {
  const auto file =
      test::truth_file("atmosphere/modtran6_isofit_pasadena/multi_LUT_AOT550-0.1000_H2OSTR-1.5000.json");
  if (!file) GTEST_SKIP() << "reference data not found: atmosphere/modtran6_isofit_pasadena";
  const auto cases = read_modtran_json(*file);
  ASSERT_EQ(cases.size(), 3u);
  const double albedos[] = {0.0, 0.1, 0.5};
  for (int k = 0; k < 3; ++k) {
    const ModtranCase& each = cases[static_cast<std::size_t>(k)];
    EXPECT_EQ(each.case_number, k);
    EXPECT_EQ(each.model, "ATM_MIDLAT_SUMMER");
    EXPECT_EQ(each.run_mode, "RT_SOLAR_AND_THERMAL");
    EXPECT_DOUBLE_EQ(*each.water_vapour, 1.5);
    EXPECT_EQ(each.water_vapour_unit, "g cm-2");
    EXPECT_DOUBLE_EQ(*each.ozone, 0.3);
    EXPECT_EQ(each.ozone_unit, "cm atm");
    EXPECT_DOUBLE_EQ(*each.co2_ppm, 450.0);
    EXPECT_EQ(each.aerosol, "AER_RURAL");
    EXPECT_DOUBLE_EQ(*each.aerosol_optical_depth_550, 0.1);
    EXPECT_FALSE(each.visibility_km);
    EXPECT_DOUBLE_EQ(*each.sensor_altitude_km, 2.3);
    EXPECT_DOUBLE_EQ(*each.ground_altitude_km, 0.35);
    EXPECT_NEAR(*each.zenith_rad, std::numbers::pi, 1e-12);
    EXPECT_EQ(*each.day_of_year, 312);
    EXPECT_DOUBLE_EQ(*each.time_utc_h, 18.708);
    EXPECT_DOUBLE_EQ(*each.surface_albedo, albedos[k]);
    EXPECT_EQ(each.spectral_unit, "nm");
    EXPECT_DOUBLE_EQ(*each.first, 350.0);
  }
}

TEST(Modtran6Json, ErrorsShowThePlace) {
  EXPECT_EQ(json_error("[]"),
            "a.json:1:1: the document is an empty list, expected an object with the key MODTRAN");
  EXPECT_EQ(json_error("{\"MODTRAN\": []}"),
            "a.json:1:13: 'MODTRAN' is an empty list, expected a list of cases");
  EXPECT_EQ(json_error("{\"MODTRAN\": [{}]}"),
            "a.json:1:14: 'MODTRAN[0]' is an empty object, expected an object with the key MODTRANINPUT");
  EXPECT_EQ(json_error("{\"MODTRAN\": [{\"MODTRANINPUT\": {\"GEOMETRY\": {\n\"H1ALT\": \"2 km\"}}}]}"),
            "a.json:2:10: 'MODTRAN[0].MODTRANINPUT.GEOMETRY.H1ALT' is the text \"2 km\", expected a number");
  const test::ScratchFile file("a.json", "{\"MODTRAN\": []}");
  EXPECT_EQ(test::input_error(file.path(), [](const auto& path) { import_paths(path); }),
            "FILE: found a MODTRAN 6 input file; expected its output (tape7, .chn or .csv)");
}

}  // namespace
}  // namespace ifov::io::test_modtran_6
