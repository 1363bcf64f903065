#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/ground_coupling.h"
#include "io/atmosphere/modtran_channels.h"
#include "io/spectra_files.h"
#include "radiometry/planck.h"
#include "support/truth_data.h"

namespace ifov::io::test_modtran_channels {
namespace {

using Q = atmosphere::PathQuantity;

constexpr const char* kFolder = "atmosphere/modtran6_isofit_pasadena/";

std::string heading() {
  return "\n1ST SPECTRAL  LOS CHAN        SPECTRAL  RADIANCE\n   MOMENT     NO.  NEL\n(NANOMETERS)       "
         "NO.\n"
         "------------  ---  ---  -------------  -------------  --------  -------------  ---------  "
         "---------  "
         "---------  ---------  -------------  -------------  -------------  -------------  -------------  "
         "-------------  -------------  -------------  -------------  -------------  ----------  ----------  "
         "----------  ----------  ----------  -----------\n";
}

std::string row() {
  return "   376.85995    1    1   3.167525E-08   2.230546E-06  1873.863   1.322378E-05   417.4798     "
         "5.9285   366.8400"
         "   386.8800   0.000000E+00   0.000000E+00   0.000000E+00   3.178563E-06   2.321252E-06   "
         "7.723960E-06   "
         "4.465127E-06   1.233416E-04   2.278096E-04   3.423688E-04   0.6066521   0.0709446   0.2789467   "
         "0.8558540   "
         "0.9000002  CENTER:  376.86 NM   FWHM:  5.57 NM\n";
}

std::string error_of(const std::string& text) {
  try {
    parse_modtran_channels(TextFile("a.chn", text));
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(0, what.find('\n'));
  }
  return "no error";
}

TEST(ModtranChannels, MeansOverChannels) {
  const double zenith = 52.0 * std::numbers::pi / 180.0;
  const auto paths = parse_modtran_channels(TextFile("a.chn", heading() + row()), zenith);
  ASSERT_EQ(paths.size(), 1u);
  const auto& path = paths[0];
  EXPECT_NEAR(path.wavelength_um()[0], 0.37685995, 1e-12);
  EXPECT_NEAR(path.width_um[0], 0.0059285, 1e-12);
  // The radiance per nanometre that the file states in another column.
  EXPECT_NEAR(path.column(Q::total_radiance)[0], 2.230546e-6 * 1e7, 1e-4);
  EXPECT_NEAR(path.column(Q::solar_path_radiance)[0], (3.178563e-6 + 2.321252e-6) * 1e4 / 0.0059285, 1e-9);
  EXPECT_NEAR(path.column(Q::sun_ground_transmittance)[0], 0.6066521 / 0.8558540, 1e-12);
  EXPECT_NEAR(*path.surface_albedo(), 0.1, 1e-6);
  const double sun = 1.233416e-4 * std::numbers::pi / std::cos(zenith);
  EXPECT_NEAR(path.column(Q::two_way_transmittance)[0], 2.278096e-4 / sun, 1e-12);
}

// Numbers may touch: they are cut where the dashes end.
TEST(ModtranChannels, TouchingNumbers) {
  std::string text = row();
  const std::string wide = "-14.465127E-06";  // fills the blanks to its left
  text.replace(text.find("   4.465127E-06") + 1, wide.size(), wide);
  const std::string digits = "17.723960E-006";
  const std::size_t left = text.find("   7.723960E-06");
  text.replace(left + 1, digits.size(), digits);
  const auto paths = parse_modtran_channels(TextFile("a.chn", heading() + text));
  EXPECT_NEAR(paths[0].column(Q::direct_reflected_radiance)[0], -14.465127e-6 * 1e4 / 0.0059285, 1e-6);
}

TEST(ModtranChannels, ErrorsShowThePlace) {
  std::string bad = row();
  bad.replace(bad.find("0.2789467"), 9, "0.27x9467");
  EXPECT_EQ(error_of(heading() + bad), "a.chn:6:299: found '0.27x9467' in column 24; expected a number");
  EXPECT_EQ(error_of(heading() + row().substr(0, 200)),
            "a.chn:6:212: found nothing in column 18; expected a number");
  EXPECT_EQ(error_of(heading() + row() + row()),
            "a.chn:7:1: found a channel at 376.86 twice; expected each once");
  EXPECT_EQ(error_of("FREQ TRANS\n"),
            "a.chn:1: found no heading '1ST SPECTRAL MOMENT'; expected a MODTRAN channel file (.chn)");
  EXPECT_EQ(error_of("    FREQ   TRANS     SOL TR  SOLAR\n"),
            "a.chn:1: found no heading '1ST SPECTRAL MOMENT'; expected a MODTRAN channel file (.chn); the "
            "file looks "
            "like a MODTRAN tape7");
  std::string other = row();
  other.replace(3, 9, "476.85995");
  EXPECT_EQ(error_of(heading() + row() + heading() + other),
            "a.chn:12:1: found a channel at 0.47686 um; expected one at 0.37686 um, as in the first block");
  EXPECT_EQ(error_of(heading() + row() + heading() + row() + other),
            "a.chn:12: found a block of 2 channels; expected 1, as in the first block");
  EXPECT_EQ(error_of(heading()), "a.chn:5: found no channels below this line");
  EXPECT_EQ(error_of(""), "a.chn: found an empty file; expected a MODTRAN channel file (.chn)");
}

// MODTRAN's own brightness temperatures hold for the radiance per wavenumber, hence at a wavelength of its
// own.
TEST(ModtranChannels, ReferenceChannels) {
  const auto file = test::truth_file(std::string(kFolder) + "AOT550-0.0100_H2OSTR-2.0000.chn");
  if (!file) GTEST_SKIP() << "reference data not found: " << kFolder;
  const auto paths = read_modtran_channels(*file);
  ASSERT_EQ(paths.size(), 1u);
  ASSERT_EQ(paths[0].wavelength_um().size(), 425u);
  const auto total = paths[0].column(Q::total_radiance);
  for (std::size_t i = 0; i < total.size(); ++i)
    EXPECT_NEAR(total[i],
                paths[0].column(Q::solar_path_radiance)[i] + paths[0].column(Q::thermal_path_radiance)[i] +
                    paths[0].column(Q::ground_reflected_radiance)[i] +
                    paths[0].column(Q::surface_emission)[i],
                2e-6 * total[i]);
}

class ThreeAlbedos : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto file = test::truth_file(std::string(kFolder) + "multi_AOT550-0.1000_H2OSTR-1.5000.chn");
    if (!file) GTEST_SKIP() << "reference data not found: " << kFolder;
    paths = read_modtran_channels(*file);
    ASSERT_EQ(paths.size(), 3u);
  }
  std::vector<atmosphere::ImportedPath> paths;
};

// The spherical albedo and the reflectance coefficients that MODTRAN states itself.
TEST_F(ThreeAlbedos, CouplingTermsAreModtrans) {
  const atmosphere::AlbedoRun runs[] = {{0.0, &paths[0]}, {0.1, &paths[1]}, {0.5, &paths[2]}};
  const auto coupling = atmosphere::ground_coupling(runs);
  const auto stated = paths[0].column(Q::spherical_albedo);
  double worst_albedo = 0.0, worst_reflected = 0.0;
  const TextFile text(*test::truth_file(std::string(kFolder) + "multi_AOT550-0.1000_H2OSTR-1.5000.chn"));
  for (std::size_t i = 0; i < stated.size(); ++i) {
    worst_albedo = std::max(worst_albedo, std::abs(coupling.spherical_albedo[i] - stated[i]));
    EXPECT_NEAR(coupling.path_radiance[i], paths[0].column(Q::solar_path_radiance)[i],
                1e-9 + 1e-6 * coupling.path_radiance[i]);
    // cos TOA_SUN / pi times A + B, from the columns of the first block.
    const std::string_view line = text.line(static_cast<int>(i) + 6);
    const double cos_sun = *number_in(split(line.substr(226, 15), ' ')[0].text);
    const double direct = *number_in(split(line.substr(271, 12), ' ')[0].text);
    const double diffuse = *number_in(split(line.substr(283, 12), ' ')[0].text);
    const double expected = cos_sun * (direct + diffuse) * 1e4 / paths[0].width_um[i];
    if (direct > 0.05) {
      worst_reflected = std::max(worst_reflected, std::abs(coupling.reflected[i] / expected - 1.0));
      EXPECT_NEAR(coupling.direct_reflected[i] / (expected * direct / (direct + diffuse)), 1.0, 0.02) << i;
    }
  }
  EXPECT_LT(worst_albedo, 0.0004);
  EXPECT_LT(worst_reflected, 0.006);
  EXPECT_EQ(coupling.cut, 0u);
  RecordProperty("worst_spherical_albedo", std::to_string(worst_albedo));
  RecordProperty("worst_reflected", std::to_string(worst_reflected));
}

// Two runs and the column of spherical albedos, or what two grounds reflect, tell the third run.
TEST_F(ThreeAlbedos, TwoRunsPredictTheThird) {
  const atmosphere::AlbedoRun with_column[] = {{0.0, &paths[0]}, {0.1, &paths[1]}};
  const auto first = atmosphere::ground_coupling(with_column);
  auto stripped = paths;
  for (auto& path : stripped) path.set(Q::spherical_albedo, {});
  const atmosphere::AlbedoRun reflecting[] = {{0.5, &stripped[2]}, {0.1, &stripped[1]}};
  const auto second = atmosphere::ground_coupling(reflecting);
  for (std::size_t i = 0; i < first.wavelength_um.size(); ++i) {
    const double third =
        paths[2].column(Q::solar_path_radiance)[i] + paths[2].column(Q::ground_reflected_radiance)[i];
    EXPECT_NEAR(first.radiance(i, 0.5), third, 2e-3 * third + 1e-9) << i;
    EXPECT_NEAR(second.radiance(i, 0.0), paths[0].column(Q::solar_path_radiance)[i], 5e-3 * third + 1e-9)
        << i;
  }
}

}  // namespace
}  // namespace ifov::io::test_modtran_channels
