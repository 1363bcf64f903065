#include <gtest/gtest.h>

#include <cmath>

#include "io/atmosphere/import_paths.h"
#include "io/atmosphere/modtran_tape7.h"
#include "io/spectra_files.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "support/truth_data.h"

namespace ifov::io::test_modtran_tape7 {
namespace {

using Q = atmosphere::PathQuantity;

const std::string kCards =
    "T F 6    2    2    0    6    6    6    6    6    6    1    0    0 300.000   0.00\n"
    "    1    1    1    0    0    0  23.00000   0.00000   0.00000   0.00000   0.00000\n"
    " -99.000 -99.000 -99.000\n"
    " -99.00000 -99.00000 -99.00000  1.416445  0.000736 ! H2O & O3 COLUMNS [GM/CM2]\n"
    "   361976 U S STANDARD\n"
    "   2.00000  10.00000  30.00000   9.23590   0.04147   0.00000    0        0.00000\n"
    "    0    0    1    0\n"
    "  25.00000   0.00000  23.00000  45.00000   0.00000   0.00000   0.00000   0.00000\n"
    "    2050.0    2052.0       1.0       1.0NW\n"
    "    0   0    0.000  0    0.000  0    1.000\n";
const std::string kHeading =
    "    FREQ  TOT_TRANS  PTH_THRML  THRML_SCT  SURF_EMIS   SOL_SCAT  SING_SCAT  GRND_RFLT  DRCT_RFLT  "
    "TOTAL_RAD  "
    "REF_SOL  SOL@OBS   DEPTH DIR_EM    TOA_SUN BBODY_T[K]\n";
const std::string kRow1 =
    " 2050.00 0.88372636 1.5936E-08 0.0000E+00 4.8713E-07 1.9724E-10 1.9724E-10 0.0000E+00 0.0000E+00 "
    "5.0326E-07 "
    "8.27E-07 8.13E-07   0.124 1.0000 9.6338E-07    297.248\n";
const std::string kRow2 =
    " 2051.00 0.74512768 3.7338E-08 0.0000E+00 4.0936E-07 1.6479E-10 1.6479E-10 0.0000E+00 0.0000E+00 "
    "4.4687E-07 "
    "6.94E-07 6.78E-07   0.294 1.0000 9.6265E-07    293.831\n";
const std::string kThermalRow =
    " 2052.00 0.78261590 4.8945E-08 0.0000E+00 0.0000E+00                       0.0000E+00            "
    "4.8945E-08    "
    "                 0.245 1.0000               240.893\n";
const std::string kEnd = " -9999.\n";

std::vector<ModtranRun> parse(const std::string& text, const std::string& name = "tape7") {
  return parse_modtran_tape7(TextFile(name, text));
}

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<ModtranRun> reference(const std::string& name) {
  const auto file = test::truth_file("atmosphere/modtran_tape7_pyradi/" + name);
  return file ? read_modtran_tape7(*file) : std::vector<ModtranRun>();
}

TEST(ModtranTape7, RadiancesPerMicrometreInRisingWavelengths) {
  const auto runs = parse(kCards + kHeading + kRow1 + kRow2 + kEnd);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].mode, ModtranMode::radiance);
  const atmosphere::ImportedPath& path = runs[0].path;
  ASSERT_EQ(path.wavelength_um().size(), 2u);
  EXPECT_DOUBLE_EQ(path.wavelength_um()[0], 1e4 / 2051.0);
  // 1 W cm-2 per cm-1 is 1e4 W m-2, and a wavenumber of 1 cm-1 is 1e4 / nu^2 um wide.
  EXPECT_NEAR(path.column(Q::total_radiance)[1], 5.0326e-7 * 2050.0 * 2050.0, 1e-12);
  EXPECT_DOUBLE_EQ(path.column(Q::ground_sensor_transmittance)[1], 0.88372636);
  EXPECT_NEAR(path.column(Q::two_way_transmittance)[1], 8.27e-7 / 9.6338e-7, 1e-12);
  EXPECT_DOUBLE_EQ(*path.water_vapour_g_cm2, 1.416445);
  EXPECT_DOUBLE_EQ(*path.geometry.sensor_altitude_km, 2.0);
  EXPECT_NEAR(*path.geometry.zenith_rad, 30.0 * M_PI / 180.0, 1e-12);
  EXPECT_NEAR(*path.surface_albedo(), 0.0, 1e-12);
}

TEST(ModtranTape7, BlankColumnsAreAbsent) {
  std::string cards = kCards;
  cards[14] = '1';
  const auto runs = parse(cards + kHeading + kThermalRow + kEnd);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].mode, ModtranMode::thermal_radiance);
  EXPECT_FALSE(runs[0].path.has(Q::solar_path_radiance));
  EXPECT_FALSE(runs[0].path.has(Q::solar_irradiance));
  EXPECT_NEAR(runs[0].path.column(Q::thermal_path_radiance)[0], 4.8945e-8 * 2052.0 * 2052.0, 1e-12);
  EXPECT_DOUBLE_EQ(runs[0].path.column(Q::surface_emissivity)[0], 1.0);
}

// Version 4 heads columns with two words, version 6 gives the parts of path radiance alone.
TEST(ModtranTape7, OtherVersions) {
  std::string old_words = kHeading;
  for (char& symbol : old_words)
    if (symbol == '_' && old_words.substr(static_cast<std::size_t>(&symbol - old_words.data()), 4) != "_T[K")
      symbol = ' ';
  EXPECT_NEAR(parse(kCards + old_words + kRow1 + kEnd)[0].path.column(Q::total_radiance)[0],
              5.0326e-7 * 2050.0 * 2050.0, 1e-12);

  std::string version_6 = kHeading;
  version_6.replace(version_6.find("PTH_THRML"), 9, " THRML_EM");
  version_6.replace(version_6.find(" SOL_SCAT"), 9, "MULT_SCAT");
  std::string row = kRow1;
  row.replace(row.find("1.9724E-10"), 10, "2.0000E-13");  // the total is dominated by emission
  const auto path = parse(kCards + version_6 + row + kEnd)[0].path;
  EXPECT_NEAR(path.column(Q::solar_path_radiance)[0], (2e-13 + 1.9724e-10) * 2050.0 * 2050.0, 1e-12);
}

TEST(ModtranTape7, ConvolvedFilesHaveTheUnitOfCard4) {
  std::string cards = kCards;
  const std::size_t card_4 = cards.find("    2050.0");
  std::string line = "    4878.0    4880.0       1.0       1.0NN        N1    ";
  cards.replace(card_4, cards.find('\n', card_4) - card_4, line);
  std::string row = kRow1;
  row.replace(0, 8, " 4878.00");
  const auto runs = parse(cards + kHeading + row + kEnd, "run.7sc");
  EXPECT_NEAR(runs[0].path.wavelength_um()[0], 4.878, 1e-12);
  EXPECT_NEAR(runs[0].path.column(Q::total_radiance)[0], 5.0326e-7 * 1e4 * 1e3, 1e-9);
  // The same rows in a tape7 are wavenumbers.
  EXPECT_NEAR(parse(cards + kHeading + row + kEnd)[0].path.wavelength_um()[0], 1e4 / 4878.0, 1e-12);
  // A heading says it wherever it stands.
  std::string heading = kHeading;
  heading.replace(0, 8, "WAVLEN(uM)");
  row.replace(0, 8, "     4.878");
  EXPECT_NEAR(parse(cards + heading + row + kEnd)[0].path.wavelength_um()[0], 4.878, 1e-12);
}

TEST(ModtranTape7, SeveralRunsAndLinesOfSight) {
  const std::string run = kCards + kHeading + kRow1 + kRow2 + kEnd;
  const auto runs = parse(run + run);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[1].path.source(), "tape7, run at line 15");

  std::string heading = kHeading, row1 = kRow1, row2 = kRow1;
  heading.insert(8, " LOS");
  row1.insert(8, "   1");
  row2.insert(8, "   2");
  const auto lines_of_sight = parse(kCards + heading + row1 + row2 + kEnd);
  ASSERT_EQ(lines_of_sight.size(), 2u);
  EXPECT_EQ(lines_of_sight[1].path.source(), "tape7, line of sight 2");
}

TEST(ModtranTape7, ErrorsShowThePlace) {
  const std::string start = kCards + kHeading + kRow1;
  EXPECT_EQ(error_of(start).substr(0, 81),
            "tape7:12: the file ends within a run; expected a line of -9999.\n   2050.00 0.8837");
  std::string row = kRow2;
  row.replace(9, 10, "0.7x512768");
  EXPECT_EQ(error_of(start + row + kEnd),
            "tape7:13:10: found '0.7x512768' under TOT_TRANS; expected a number\n  " + row.substr(0, 100) +
                "\n           ^");
  EXPECT_NE(error_of(start + kThermalRow + kEnd)
                .find("tape7:13: found nothing under SOL_SCAT; expected a number, as in line 12"),
            std::string::npos);
  EXPECT_NE(error_of(start + kRow1 + kEnd).find("tape7:13:2: found 2050 twice; expected each once"),
            std::string::npos);
  std::string cards = kCards;
  cards[14] = '3';
  EXPECT_NE(
      error_of(cards + kHeading + kRow1 + kEnd)
          .find("tape7:11: found headings of thermal and solar radiance; expected those of solar irradiance, "
                "since card 1 (line 1) states IEMSCT 3"),
      std::string::npos);
  std::string twice = kHeading;
  twice.replace(twice.find("SING_SCAT"), 9, " SOL_SCAT");
  EXPECT_NE(error_of(kCards + twice + kRow1 + kEnd).find("found SOL_SCAT twice; expected each column once"),
            std::string::npos);
  EXPECT_EQ(error_of(""), "tape7: found an empty file; expected a MODTRAN tape7");
  // Columns that are taken for others are noticed by their sum.
  std::string wrong = kRow1;
  wrong.replace(wrong.find("4.8713E-07"), 10, "4.8713E-08");
  EXPECT_NE(error_of(kCards + kHeading + wrong + kEnd).find("the parts of the radiance add up to"),
            std::string::npos);
}

TEST(ModtranTape7, OtherFilesAreToldApart) {
  EXPECT_EQ(
      error_of("wavelength_um,total_radiance\n0.4,1\n"),
      "tape7:1: found no line of headings that begins with FREQ or WAVLEN after this one; expected a run of "
      "MODTRAN 4 or later; the file looks like a table of paths (.csv)\n  wavelength_um,total_radiance");
  const auto channels =
      test::truth_file("atmosphere/modtran6_isofit_pasadena/AOT550-0.0100_H2OSTR-2.0000.chn");
  if (!channels) GTEST_SKIP() << "reference data not found: atmosphere/modtran6_isofit_pasadena";
  EXPECT_NE(test::input_error(*channels, [](const auto& path) { read_modtran_tape7(path); })
                .find("; the file looks like a MODTRAN channel file (.chn)"),
            std::string::npos);
}

TEST(ModtranTape7, LowtranTransmittancesAreRefused) {
  const auto file = test::truth_file("atmosphere/lowtran7/A_MLS_vertical_noaerosol_trans.tape7.txt");
  if (!file) GTEST_SKIP() << "reference data not found: atmosphere/lowtran7";
  EXPECT_EQ(test::input_error(*file, [](const auto& path) { read_modtran_tape7(path); }).substr(0, 130),
            "FILE:11: found headings of no MODTRAN run mode; expected COMBIN (transmittance), TOTAL_RAD "
            "(radiance) or "
            "SOL TR (solar irradiance)");
}

// Every run mode, with the brightness temperature that MODTRAN states as the judge of units: the radiance per
// micrometre at a wavelength must be that of a black body of this temperature.
TEST(ModtranTape7, BrightnessTemperaturesOfReferenceRuns) {
  if (reference("tape7-02").empty())
    GTEST_SKIP() << "reference data not found: atmosphere/modtran_tape7_pyradi";
  int compared = 0;
  for (const char* name : {"tape7-02", "tape7-02b", "tape7-02c", "tape7-03", "tape7-03b", "tape7-05",
                           "tape7-05b", "tape7.LWIRSun", "tape7.MWIRSun"}) {
    const auto runs = reference(name);
    ASSERT_EQ(runs.size(), 1u) << name;
    const TextFile text(*test::truth_file(std::string("atmosphere/modtran_tape7_pyradi/") + name));
    const auto um = runs[0].path.wavelength_um();
    const auto radiance = runs[0].path.need(Q::total_radiance);
    for (int number = 12; number < text.line_count(); ++number) {
      const std::string_view line = text.line(number);
      if (line.size() < 150) continue;
      const double nu = *number_in(split(line.substr(0, 8), ' ')[0].text);
      const double kelvin = *number_in(split(line.substr(line.size() - 11), ' ')[0].text);
      const auto at = std::min_element(um.begin(), um.end(), [&](double a, double b) {
        return std::abs(a - 1e4 / nu) < std::abs(b - 1e4 / nu);
      });
      // Five digits of radiance, six of temperature, and MODTRAN's radiation constants, which differ in the
      // fifth.
      EXPECT_NEAR(
          radiometry::planck_w_m2_sr_um(*at, kelvin) / radiance[static_cast<std::size_t>(at - um.begin())],
          1.0, 4e-4)
          << name << " " << nu;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(ModtranTape7, TransmittanceAndSunOfReferenceRuns) {
  const auto transmittance = reference("tape7-01");
  if (transmittance.empty()) GTEST_SKIP() << "reference data not found: atmosphere/modtran_tape7_pyradi";
  EXPECT_EQ(transmittance[0].mode, ModtranMode::transmittance);
  EXPECT_DOUBLE_EQ(transmittance[0].path.column(Q::ground_sensor_transmittance).back(), 0.9100);
  const auto cut_off = reference("horizon5kmtropical_first12cols.txt");
  EXPECT_GT(cut_off[0].path.wavelength_um().size(), 7900u);
  EXPECT_DOUBLE_EQ(*cut_off[0].path.geometry.range_km, 5.0);

  // Direct sun: 11995 to 13405 cm-1 across the beam, against the built-in solar spectrum at about 1 au.
  const auto sun = reference("tape7-sunE");
  EXPECT_EQ(sun[0].mode, ModtranMode::solar_irradiance);
  const auto& path = sun[0].path;
  const double first = path.wavelength_um().front(), last = path.wavelength_um().back();
  const double above = radiometry::integral(path.spectrum(Q::solar_irradiance), first, last);
  EXPECT_NEAR(above / radiometry::integral(radiometry::solar_irradiance_1au(), first, last), 1.0, 0.04);
  for (std::size_t i = 0; i < path.wavelength_um().size(); i += 100)
    EXPECT_NEAR(path.column(Q::sun_at_sensor)[i],
                path.column(Q::solar_irradiance)[i] * path.column(Q::direct_sun_ground_transmittance)[i],
                0.01 * path.column(Q::solar_irradiance)[i]);
  EXPECT_EQ(reference("tape7-04").size(), 1u);
}

TEST(ModtranTape7, ImportTellsTheFormat) {
  const test::ScratchFile file("a.tp7", kCards + kHeading + kRow1 + kRow2 + kEnd);
  EXPECT_EQ(import_paths(file.path()).size(), 1u);
  const test::ScratchFile other("a.txt", "Lorem ipsum\n");
  EXPECT_EQ(
      test::input_error(other.path(), [](const auto& path) { import_paths(path); }),
      "FILE: found no file that is known here; expected a MODTRAN tape7 (.tp7, .7sc), channel file (.chn) or "
      "table (.csv), the output of libRadtran's uvspec, or a table of paths (.csv)");
}

}  // namespace
}  // namespace ifov::io::test_modtran_tape7
