#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/atmosphere/import_paths.h"
#include "io/atmosphere/uvspec.h"
#include "io/spectra_files.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "support/truth_data.h"

namespace ifov::io::test_uvspec {
namespace {

using Q = atmosphere::PathQuantity;

constexpr const char* kFolder = "atmosphere/libradtran/";

UvspecInput input(const std::string& text) { return parse_uvspec_input(TextFile("a.inp", text)); }

std::vector<atmosphere::ImportedPath> parse(const std::string& output, const std::string& text) {
  return parse_uvspec(TextFile("a.out", output), input(text));
}

std::string error_of(const std::string& output, const std::string& text) {
  try {
    parse(output, text);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(0, what.find('\n'));
  }
  return "no error";
}

TEST(Uvspec, DefaultRowsOfDisort) {
  const auto paths =
      parse("400.0 1e3 2e2 1e2 1 1 1\n500.0 1.2e3 1e2 1e2 1 1 1\n", "source solar a.dat # mW\nsza 30\n");
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_DOUBLE_EQ(paths[0].wavelength_um()[0], 0.4);
  EXPECT_DOUBLE_EQ(paths[0].column(Q::direct_irradiance)[0], 1000.0);  // mW m-2 nm-1 is W m-2 um-1
  EXPECT_DOUBLE_EQ(paths[0].column(Q::diffuse_irradiance)[1], 100.0);
  EXPECT_FALSE(paths[0].has(Q::total_radiance));
}

TEST(Uvspec, RadiancesByAngleAndAltitude) {
  const std::string block = "400 1 2 3 4 5 6\n      0.0   90.0\n-0.5  9.0  10.0 11.0\n 1.0  9.0  20.0 21.0\n";
  std::string second = block;
  second.replace(second.find("10.0"), 4, "30.0");
  const auto paths =
      parse(block + second, "source solar\numu -0.5 1\nphi 0 90\nzout 0 toa\nrte_solver disort\n");
  ASSERT_EQ(paths.size(), 8u);
  EXPECT_DOUBLE_EQ(paths[0].column(Q::total_radiance)[0], 10.0);
  EXPECT_DOUBLE_EQ(paths[3].column(Q::total_radiance)[0], 21.0);
  EXPECT_DOUBLE_EQ(paths[4].column(Q::total_radiance)[0], 30.0);
  EXPECT_NEAR(*paths[3].geometry.zenith_rad, M_PI, 1e-12);  // looks down
  EXPECT_NEAR(*paths[0].geometry.zenith_rad, M_PI / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(*paths[4].geometry.sensor_altitude_km, 120.0);
  EXPECT_EQ(paths[1].source(), "a.out, 0 km, umu -0.5, phi 90");
}

TEST(Uvspec, OutputUserThermalAndTransmittance) {
  const auto thermal = parse("10000 5 1.0\n10010 5 2.0\n",
                             "source thermal\noutput_process per_cm-1\noutput_user lambda sza eglo\n");
  EXPECT_NEAR(thermal[0].column(Q::global_irradiance)[0], 100.0, 1e-9);  // 1 cm-1 is 0.01 um at 10 um
  const auto clear = parse("400 0.5 0.0\n",
                           "source solar\nsza 60\noutput_quantity transmittance\n"
                           "output_user lambda edir edn\n");
  // uvspec divides by the irradiance across the beam.
  EXPECT_ANY_THROW(parse("400 0.7 0.1\n",
                         "source solar\nsza 60\noutput_quantity transmittance\n"
                         "output_user lambda edir edn\n"));
  EXPECT_NEAR(clear[0].column(Q::direct_sun_ground_transmittance)[0], 1.0, 1e-12);
  EXPECT_FALSE(clear[0].has(Q::direct_irradiance));
}

TEST(Uvspec, ErrorsShowThePlace) {
  EXPECT_EQ(
      error_of("400 1 2\n", "source solar\n"),
      "a.out:1: found 3 numbers; expected 7 (lambda edir edn eup uavgdir uavgdn uavgup), as a.inp asks for");
  EXPECT_EQ(error_of("400 1 2 x 4\n", "source solar\nrte_solver twostr\n"),
            "a.out:1:9: found 'x'; expected 5 (lambda edir edn eup uavg)");
  EXPECT_EQ(error_of("400 1 2 3 4 5 6\n0.9 1 2\n", "source solar\numu 0.8\nphi 0\n"),
            "a.out:2: found 3 numbers; expected 1 azimuths (phi), as a.inp asks for");
  EXPECT_EQ(error_of("400 1 2 3 4 5 6\n0.9 1\n", "source solar\numu 0.8\n"),
            "a.out:2:1: found umu 0.9; expected 0.8, as a.inp asks for");
  EXPECT_EQ(error_of("400 1 2 3 4 5 6\n", "source solar\numu 0.8\n"),
            "a.out:1: the file ends here; expected 2 (umu and radiances)");
  EXPECT_EQ(
      error_of("1ST SPECTRAL  LOS\n", "source solar\n"),
      "a.out:1:1: found '1ST'; expected 7 (lambda edir edn eup uavgdir uavgdn uavgup); the file looks like a "
      "MODTRAN channel file (.chn)");
  EXPECT_EQ(
      error_of("1 2\n", "sza 30\n"),
      "a.inp: found no source; expected 'source solar' or 'source thermal', as in the input file of uvspec");
  EXPECT_EQ(error_of("1 2\n", "source thermal\n"),
            "a.inp:1:8: found a thermal source without output_process; expected 'output_process per_nm' or "
            "'output_process per_cm-1', which says the unit");
  EXPECT_EQ(error_of("1 2\n", "source solar\noutput_user lambda eidr\n").substr(0, 52),
            "a.inp:2:20: found the column 'eidr'; expected 'lambd");
  EXPECT_EQ(
      error_of("1 2\n", "source solar\nrte_solver polradtran\n"),
      "a.inp:2:12: found the solver 'polradtran', whose output is not read; expected disort or twostr, or "
      "output_user with the columns");
  EXPECT_EQ(error_of("1 2\n", "source solar\noutput_quantity brightness\n"),
            "a.inp:2:17: found the output quantity 'brightness'; expected 'transmittance' or none");
  EXPECT_EQ(error_of("1 2\n", "source solar\noutput_process integrate\n"),
            "a.inp:2:16: found the output process 'integrate'; expected 'per_nm', 'per_cm-1' or none");
  EXPECT_EQ(error_of("", "source solar\n"), "a.out: found an empty file; expected the output of uvspec");
}

TEST(Uvspec, OutputWithoutItsInputIsRefused) {
  const test::ScratchFile file("a.out", "400 1 2 3 4 5 6\n");
  const std::string input = std::filesystem::path(file.path().filename()).replace_extension(".inp").string();
  EXPECT_EQ(
      test::input_error(file.path(), [](const auto& path) { import_paths(path); }),
      "FILE: found rows of numbers without headings; expected the input file of uvspec beside them, as " +
          input + ", or under 'uvspec_inputs'");
}

TEST(Uvspec, InputIsFoundBesideTheOutput) {
  const test::ScratchFile file("a.out", "400 1 2 3 4 5 6\n");
  for (const char* extension : {".inp", ".INP", ".in"}) {
    const auto beside = std::filesystem::path(file.path()).replace_extension(extension);
    std::ofstream(beside) << "source solar\nsza 30\n";
    EXPECT_EQ(import_paths(file.path()).size(), 1u) << extension;
    std::filesystem::remove(beside);
  }
}

std::vector<atmosphere::ImportedPath> reference(const std::string& name) {
  return read_uvspec(*test::truth_file(kFolder + name + ".OUT"), *test::truth_file(kFolder + name + ".INP"));
}

class UvspecReference : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::truth_file(kFolder)) GTEST_SKIP() << "reference data not found: " << kFolder;
  }
};

TEST_F(UvspecReference, SolarUnits) {
  for (const char* name :
       {"UVSPEC_CLEAR", "UVSPEC_DISORT", "UVSPEC_LOWTRAN_SOLAR", "spectrum_solar_sbdart"}) {
    const auto paths = reference(name);
    ASSERT_EQ(paths.size(), 1u) << name;
    EXPECT_TRUE(paths[0].has(Q::direct_irradiance)) << name;
  }
  // At 1.04 um the clear air of the case without aerosol takes little: direct light on a level plane is
  // nearly that of the Sun times the cosine of 32 degrees.
  const auto sbdart = reference("spectrum_solar_sbdart")[0];
  const double direct = radiometry::integral(sbdart.spectrum(Q::direct_irradiance), 1.03, 1.05);
  const double above = radiometry::integral(radiometry::solar_irradiance_1au(), 1.03, 1.05);
  EXPECT_NEAR(direct / above / std::cos(32.0 * M_PI / 180.0), 0.985, 0.02);
}

TEST_F(UvspecReference, TransmittanceAndThermal) {
  const auto clear = reference("transmittance_reptran")[0];
  EXPECT_NEAR(clear.column(Q::direct_sun_ground_transmittance)[0], 0.6816935, 1e-9);
  EXPECT_NEAR(clear.column(Q::sun_ground_transmittance)[0], 0.8367690, 1e-9);
  // The sky's radiation in the middle of the carbon dioxide band is that of a black body at the air's
  // temperature near the ground (subarctic summer, 287 K).
  const auto sky = reference("spectrum_terrestrial_reptran")[0];
  EXPECT_NEAR(
      sky.spectrum(Q::global_irradiance).at(15.0) / (M_PI * radiometry::planck_w_m2_sr_um(15.0, 287.0)), 1.0,
      0.01);
}

// Files that belong to other inputs, or whose rows are not what the input asks for.
TEST_F(UvspecReference, MixedFilesAreToldApart) {
  const auto read = [](const std::string& output, const std::string& in) {
    return test::input_error(*test::truth_file(kFolder + output),
                             [&](const auto& path) { read_uvspec(path, *test::truth_file(kFolder + in)); });
  };
  EXPECT_NE(read("UVSPEC_LOWTRAN_SOLAR.OUT", "UVSPEC_CLEAR.INP")
                .find("FILE:1: found 5 numbers; expected 7 (lambda"),
            std::string::npos);
  EXPECT_NE(read("UVSPEC_LOWTRAN_THERMAL.OUT", "UVSPEC_LOWTRAN_THERMAL.INP")
                .find("FILE:1: found 2 numbers; expected 5 (lambda edir edn eup uavg)"),
            std::string::npos);
  EXPECT_NE(read("POLRADTRAN.OUT", "POLRADTRAN.INP").find("found the solver 'polradtran'"),
            std::string::npos);
  EXPECT_NE(read("UVSPEC_BRDF.OUT", "UVSPEC_BRDF.INP").find("found radiances as transmittances"),
            std::string::npos);
}

// The shape of radiances by angle, with the line that makes their unit unknown taken out of the input.
TEST_F(UvspecReference, RadiancesByAngle) {
  std::string text;
  const TextFile given(*test::truth_file(std::string(kFolder) + "UVSPEC_BRDF.INP"));
  for (int number = 1; number <= given.line_count(); ++number)
    if (given.line(number).find("output_quantity") == std::string_view::npos)
      text += std::string(given.line(number)) + "\n";
  const auto paths =
      parse_uvspec(TextFile(*test::truth_file(std::string(kFolder) + "UVSPEC_BRDF.OUT")), input(text));
  ASSERT_EQ(paths.size(), 34u * 3u);
  EXPECT_DOUBLE_EQ(paths[1].column(Q::total_radiance)[0], 2.142575830e-01);
  EXPECT_DOUBLE_EQ(*paths[0].geometry.sensor_altitude_km, 50.0);
}

}  // namespace
}  // namespace ifov::io::test_uvspec
