#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/imported_atmosphere.h"
#include "atmosphere/imported_light.h"
#include "core/error.h"

namespace ifov::atmosphere::test_imported_light {
namespace {

using Q = PathQuantity;
using Column = std::vector<double>;

const Column kWavelengths{0.5, 0.6, 0.7};
constexpr double kCos = 0.6, kPi = std::numbers::pi;
// What the runs below are made of. The beam's two-way transmittance is not the product of its two ways.
constexpr double kAbove = 1800.0, kDown = 0.5, kUp = 0.6, kTwoWay = 0.4, kDiffuseUp = 0.1, kSky = 200.0,
                 kAlbedo = 0.15, kPath = 12.0, kGlow = 0.3;
constexpr double kSeenBeam =
    kAbove * kCos * kTwoWay / kUp;  // irradiance of level ground as the sensor sees it

Column all(double value) { return Column(kWavelengths.size(), value); }

/// A run over ground of albedo r, which emits nothing.
ImportedPath run(double r) {
  ImportedPath path(format("run {:g}", r), kWavelengths);
  const double lit = (kSeenBeam + kSky) / kPi * r / (1.0 - r * kAlbedo);
  path.set(Q::ground_sensor_transmittance, all(kUp));
  path.set(Q::solar_path_radiance, all(kPath + lit * kDiffuseUp));
  path.set(Q::thermal_path_radiance, all(kGlow));
  path.set(Q::ground_reflected_radiance, all(lit * kUp));
  path.set(Q::direct_reflected_radiance, all(kSeenBeam / kPi * r * kUp));
  path.set(Q::total_radiance, all(kPath + kGlow + lit * (kUp + kDiffuseUp)));
  path.set(Q::two_way_transmittance, all(kTwoWay));
  path.set(Q::solar_irradiance, all(kAbove));
  return path;
}

const std::optional<SunAbove> kSun = SunAbove{kCos, radiometry::Spectrum::constant(1000.0)};

void expect_light(const ImportedLight& light, double tolerance = 1e-9) {
  ASSERT_EQ(light.sky.size(), kWavelengths.size());
  for (std::size_t i = 0; i < kWavelengths.size(); ++i) {
    EXPECT_NEAR(light.sun[i], kSeenBeam / kCos, tolerance * kAbove);
    EXPECT_NEAR(light.sky[i], kSky, tolerance * kAbove);
    EXPECT_NEAR(light.view[i], kUp, tolerance);
    EXPECT_NEAR(light.diffuse_transmittance[i], kDiffuseUp, tolerance);
    EXPECT_NEAR(light.path[i], kPath + kGlow, tolerance * kPath);
    EXPECT_NEAR(light.spherical_albedo[i], kAlbedo, tolerance);
  }
}

std::string error_of(const ImportedRuns& runs, const std::optional<SunAbove>& sun = kSun) {
  try {
    imported_light(runs, sun);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImportedLight, ThreeRunsAndTwo) {
  const ImportedLight three = imported_light({{run(0.5), run(0.0), run(0.1)}, {0.5, 0.0, 0.1}, {}}, kSun);
  expect_light(three);
  EXPECT_TRUE(three.remarks.empty());
  EXPECT_TRUE(three.own_irradiance);
  expect_light(imported_light({{run(0.5), run(0.2)}, {0.5, 0.2}, {}}, kSun));
}

// A run that was made over another ground than it is said to be shows in what comes out.
TEST(ImportedLight, AWrongAlbedoShows) {
  const ImportedLight light = imported_light({{run(0.5), run(0.0), run(0.1)}, {0.5, 0.0, 0.12}, {}}, kSun);
  EXPECT_GT(std::abs(light.spherical_albedo[0] - kAlbedo), 0.05);
}

TEST(ImportedLight, OneRunOverBrightGround) {
  ImportedPath bright = run(0.4);
  bright.set(Q::spherical_albedo, all(kAlbedo));
  bright.set(Q::diffuse_ground_sensor_transmittance, all(kDiffuseUp));
  expect_light(imported_light({{bright}, {0.4}, {}}, kSun));
}

TEST(ImportedLight, OneRunOverBlackGroundKeepsTheCorrelationOfBothWays) {
  ImportedPath dark = run(0.0);
  dark.set(Q::spherical_albedo, all(kAlbedo));
  dark.set(Q::diffuse_ground_sensor_transmittance, all(kDiffuseUp));
  dark.set(Q::sun_ground_transmittance, all((kSeenBeam + kSky) / (kAbove * kCos)));
  const ImportedLight light = imported_light({{dark}, {0.0}, {}}, kSun);
  expect_light(light);
  EXPECT_TRUE(light.own_irradiance);
  // Without the two-way transmittance the beam is that of its own way down.
  dark.set(Q::two_way_transmittance, {});
  dark.set(Q::direct_sun_ground_transmittance, all(kDown));
  EXPECT_NEAR(imported_light({{dark}, {0.0}, {}}, kSun).sun[0], kAbove * kDown, 1e-9 * kAbove);
}

TEST(ImportedLight, TotalsWithIrradiancesOfTheGround) {
  ImportedRuns runs;
  for (const double r : {0.0, 0.3, 0.6}) {
    ImportedPath path(format("run {:g}", r), kWavelengths);
    path.set(Q::total_radiance, all(run(r).column(Q::total_radiance)[0]));
    const double lit = (kSeenBeam + kSky) / (1.0 - r * kAlbedo);
    path.set(Q::direct_irradiance, all(kSeenBeam));
    path.set(Q::diffuse_irradiance, all(lit - kSeenBeam));
    runs.runs.push_back(path);
    runs.albedo.push_back(r);
  }
  const ImportedLight light = imported_light(runs, kSun);
  EXPECT_NEAR(light.view[1], kUp + kDiffuseUp, 1e-9);
  EXPECT_EQ(light.diffuse_transmittance[1], 0.0);
  EXPECT_NEAR(light.sun[1], kSeenBeam / kCos, 1e-6);
  EXPECT_NEAR(light.sky[1], kSky, 1e-6);
  ASSERT_EQ(light.remarks.size(), 1u);
  EXPECT_NE(light.remarks[0].find("run 0 has no ground_sensor_transmittance"), std::string::npos);
}

TEST(ImportedLight, LightsOfOtherFilesFillIn) {
  ImportedPath line_of_sight("sight", kWavelengths), beam("beam", {0.4, 0.8});
  line_of_sight.set(Q::ground_sensor_transmittance, all(kUp));
  line_of_sight.set(Q::solar_path_radiance, all(kPath));
  beam.set(Q::direct_sun_ground_transmittance, {0.4, 0.6});
  EXPECT_FALSE(sees_ground(beam));
  const ImportedLight light = imported_light({{line_of_sight}, {0.0}, {beam}}, kSun);
  EXPECT_NEAR(light.sun[1], 1000.0 * 0.5, 1e-9);  // the document's Sun, the transmittance at 0.6 um
  EXPECT_FALSE(light.own_irradiance);
  EXPECT_TRUE(light.sky.empty());
  EXPECT_EQ(light.remarks.size(), 2u);
}

TEST(ImportedLight, ErrorsNameTheQuantityAndTheRun) {
  ImportedPath empty("a.csv", kWavelengths);
  empty.set(Q::spherical_albedo, all(0.1));
  EXPECT_EQ(error_of({{empty}, {0.0}, {}}),
            "a.csv: has no ground_sensor_transmittance; there are 'spherical_albedo': the light of the "
            "ground cannot be "
            "carried to the sensor; give runs in radiance mode of MODTRAN, or two or three runs of different "
            "albedo that "
            "state irradiances");
  ImportedPath up = run(0.0);
  up.geometry.zenith_rad = 0.3;
  EXPECT_EQ(
      error_of({{up}, {0.0}, {}}),
      "run 0: the path looks up (17.2 deg from the zenith); expected one from the sensor down to the ground");
  ImportedPath other_sun = run(0.0);
  other_sun.geometry.sun_zenith_rad = 0.2;
  EXPECT_EQ(error_of({{other_sun}, {0.0}, {}}),
            "run 0: the Sun stands 11.5 deg from the zenith; expected 53.1 deg, as in the document");
  EXPECT_EQ(error_of({{run(0.0)}, {0.0}, {}}, std::nullopt),
            "run 0 holds direct sunlight, and the document has no Sun above the horizon; give light.sun with "
            "the zenith "
            "angle of the runs");
}

TEST(ImportedAtmosphere, ChannelsOfTheFileHaveItsOwnValues) {
  ImportedLight light = imported_light({{run(0.5), run(0.0), run(0.1)}, {0.5, 0.0, 0.1}, {}}, kSun);
  light.path = {10.0, 50.0, 10.0};
  light.width_um = all(0.0106);
  const radiometry::Channel channels[] = {radiometry::Channel::gaussian("same", 0.6, 0.01),
                                          radiometry::Channel::gaussian("beside", 0.65, 0.01)};
  const ImportedAtmosphere air(light, {channels, {}, {}});
  ASSERT_EQ(air.unmatched_channels(), std::vector<std::size_t>{1});
  const auto mean = [&](std::size_t channel) {
    double sum = 0.0;
    for (std::size_t n = air.nodes().first_node(channel); n < air.nodes().first_node(channel + 1); ++n)
      sum += air.nodes().node_weight(n) * air.view_radiance()[n];
    return sum;
  };
  EXPECT_NEAR(mean(0), 50.0, 1e-4);
  EXPECT_NEAR(mean(1), 30.0, 1e-4);  // halfway between the file's channels
  const radiometry::Channel beyond[] = {radiometry::Channel::gaussian("far", 0.7, 0.05)};
  EXPECT_THROW(ImportedAtmosphere(light, {beyond, {}, {}}), InputError);
}

}  // namespace
}  // namespace ifov::atmosphere::test_imported_light
