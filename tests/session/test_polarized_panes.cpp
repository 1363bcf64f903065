// Polarized light by way of smooth boundaries, panes and mirrors, from a document to the sensor.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "core/format.h"
#include "session/polarized_run.h"

namespace ifov::session::test_polarized_panes {
namespace {

using test::rendered_once;
using test::stokes_of;

constexpr double kRad = std::numbers::pi / 180.0;

/// Reflectances of a smooth surface by Fresnel's own form.
struct Smooth {
  double p, s;
  Smooth(std::complex<double> n, double angle) {
    const std::complex<double> within = std::sqrt(1.0 - std::pow(std::sin(angle) / n, 2));
    const double c = std::cos(angle);
    p = std::norm((n * c - within) / (n * c + within));
    s = std::norm((c - n * within) / (c + n * within));
  }
};

/// One pixel that looks aslant from the south; x of the focal plane is level, so that p has Q < 0.
std::string aslant(double zenith_deg, const std::string& materials, const std::string& objects,
                   const std::string& light, const std::string& sensor, const std::string& channel,
                   const std::string& sampling) {
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{{}}}, "objects": [{}]}}, "light": {{{}}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "0.1 m", "pixels": [1, 1], "view_zenith": "{} deg", "view_azimuth": "180 deg"}}}},
        {} "channels": [{{"name": "c", "monochromatic": {{"at": "{}"}}}}]}},
      "sampling": {}}})",
      materials, objects, light, zenith_deg, sensor, channel, sampling);
}

constexpr const char* kStokes = R"("stokes": true,)";
constexpr const char* kRays = R"({"grid": {"elements": [24, 24]}})";
constexpr const char* kManyRays = R"({"grid": {"elements": [80, 80]}})";
constexpr const char* kNoSky = R"("sky": {"none": {}}, "surroundings": {"reflectance": 0})";
constexpr const char* kWarmSky =
    R"("sky": {"temperature": "300 K"}, "surroundings": {"reflectance": 0, "temperature": "300 K"})";

std::string level(double half_m, double z_m, const char* material) {
  return format(
      R"({{"polygon": {{"vertices": [["-{0} m", "-{0} m", "{1} m"], ["{0} m", "-{0} m", "{1} m"], ["{0} m", "{0} m", "{1} m"], ["-{0} m", "{0} m", "{1} m"]]}}, "material": "{2}"}})",
      half_m, z_m, material);
}
constexpr const char* kHotGround = R"("ground": {"reflectance": 0, "temperature": "300 K"})";

// Stokes (1862): a pile of m plates that do not absorb lets through (1 - R) / (1 + (2m - 1) R) of either polarization.
TEST(PolarizedPanes, APileOfPlatesIsStokess) {
  const double zenith_deg = 60.0;
  const Smooth glass(1.5, zenith_deg * kRad);
  const std::string pane =
      std::string(kHotGround) +
      R"(, "pane": {"reflectance": 1, "scattering": {"slab": {"n": 1.5, "k": 0, "thickness": "4 mm"}}})";
  for (int plates = 1; plates <= 2; ++plates) {
    std::string objects = R"({"plane": {}, "material": "ground"})";
    for (int m = 1; m <= plates; ++m) objects += ", " + level(400.0, 0.5 * m, "pane");
    const sampling::TileResult tile = rendered_once(
        aslant(zenith_deg, pane, objects, kNoSky, kStokes, "10 um", plates == 1 ? kRays : kManyRays));
    const auto through = [&](double r, int beams) { return (1.0 - r) / (1.0 + (beams - 1) * r); };
    const double p = through(glass.p, 2 * plates), s = through(glass.s, 2 * plates);
    const double found = stokes_of(tile, 0, 1) / stokes_of(tile, 0, 0);
    EXPECT_NEAR(found, -(p - s) / (p + s), plates == 1 ? 1e-4 : 2e-3) << plates;
    // Planted fault: plates that know of one passage alone.
    EXPECT_GT(std::abs(found + (through(glass.p, 1) - through(glass.s, 1)) /
                                   (through(glass.p, 1) + through(glass.s, 1))),
              0.03);
  }
}

// A block of glass with two level faces is a plate, walked face by face.
TEST(PolarizedPanes, ABlockIsAPlate) {
  const double zenith_deg = 60.0;
  const Smooth glass(1.5, zenith_deg * kRad);
  const std::string materials =
      std::string(kHotGround) +
      R"(, "glass": {"reflectance": 1, "scattering": {"smooth": {"n": 1.5, "k": 0}}})";
  const sampling::TileResult tile = rendered_once(aslant(
      zenith_deg, materials,
      R"({"plane": {}, "material": "ground"}, {"box": {"low": ["-400 m", "-400 m", "0.5 m"], "high": ["400 m", "400 m", "0.9 m"]}, "material": "glass"})",
      kNoSky, kStokes, "10 um", kRays));
  const double p = (1.0 - glass.p) / (1.0 + glass.p), s = (1.0 - glass.s) / (1.0 + glass.s);
  EXPECT_NEAR(stokes_of(tile, 0, 1) / stokes_of(tile, 0, 0), -(p - s) / (p + s), 2e-3);
}

TEST(PolarizedPanes, AFrostedBlockIsAPlateAsRoughnessVanishes) {
  const double zenith_deg = 60.0;
  const Smooth glass(1.5, zenith_deg * kRad);
  const std::string materials =
      std::string(kHotGround) +
      R"(, "glass": {"reflectance": 1, "scattering": {"rough_boundary": {"n": 1.5, "k": 0, "roughness": 0.02, "distribution": "beckmann"}}})";
  const sampling::TileResult tile = rendered_once(aslant(
      zenith_deg, materials,
      R"({"plane": {}, "material": "ground"}, {"box": {"low": ["-400 m", "-400 m", "0.5 m"], "high": ["400 m", "400 m", "0.9 m"]}, "material": "glass"})",
      kNoSky, kStokes, "10 um", kManyRays));
  const double p = (1.0 - glass.p) / (1.0 + glass.p), s = (1.0 - glass.s) / (1.0 + glass.s);
  const double found = stokes_of(tile, 0, 1) / stokes_of(tile, 0, 0);
  EXPECT_NEAR(found, -(p - s) / (p + s), 6e-3);  // 3 standard errors
  // Planted fault: faces that pass light as it comes.
  EXPECT_LT(found, -0.1);
}

TEST(PolarizedPanes, AWarmPaneUnderAColdSkySwingsUpright) {
  const double zenith_deg = 60.0;
  const auto run = [&](const char* temperature, const std::string& light) {
    const std::string materials = format(
        R"("ground": {{"reflectance": 0, "temperature": "{0}"}},
           "pane": {{"reflectance": 1, "temperature": "{0}", "scattering": {{"slab": {{"n": 1.5, "k": 1e-3, "thickness": "1 mm"}}}}}})",
        temperature);
    return rendered_once(aslant(zenith_deg, materials,
                                R"({"plane": {}, "material": "ground"}, )" + level(400.0, 0.5, "pane"), light,
                                kStokes, "10 um", kRays));
  };
  const sampling::TileResult warm = run("300 K", kNoSky), cold = run("3 K", kWarmSky),
                             room = run("300 K", kWarmSky);
  const double all = stokes_of(room, 0, 0);
  // Ground and pane together emit what is not reflected: the front's and what comes back from within, polarization by polarization.
  const Smooth glass({1.5, 1e-3}, zenith_deg * kRad);
  const double within = std::cos(std::asin(std::sin(zenith_deg * kRad) / 1.5));
  const double passes = std::exp(-4.0 * std::numbers::pi * 1e-3 * 1e3 / (10.0 * within));
  const auto back = [&](double r) {
    return r + (1 - r) * (1 - r) * r * passes * passes / (1 - r * r * passes * passes);
  };
  const double expected = 0.5 * (back(glass.p) - back(glass.s));
  EXPECT_NEAR(stokes_of(cold, 0, 1) / all, -expected, 2e-4);
  EXPECT_NEAR(stokes_of(warm, 0, 1) / all, expected, 2e-4);
  EXPECT_LT(expected, -0.05) << "warm panes swing in the plane of the normal";
  for (int component = 1; component < 4; ++component)
    EXPECT_NEAR(stokes_of(room, 0, component), 0.0, 1e-4 * all) << component;
  // Planted fault: emission with the sign of what is reflected.
  EXPECT_GT(std::abs(stokes_of(warm, 0, 1) - stokes_of(cold, 0, 1)), 0.1 * all);
}

// In a room of one temperature nothing is polarized, whatever stands in it.
TEST(PolarizedPanes, ThingsOfGlassInARoomOfTheirTemperature) {
  const std::string materials = R"("ground": {"reflectance": 0.3, "temperature": "300 K"},
      "water": {"reflectance": 1, "temperature": "300 K", "scattering": {"smooth": {"n": 1.4, "k": 1e-6}}},
      "metal": {"reflectance": 0.9, "temperature": "300 K", "scattering": {"smooth": {"n": 3, "k": 6, "over": "absorber"}}},
      "frosted": {"reflectance": 1, "temperature": "300 K", "scattering": {"rough_boundary": {"n": 1.5, "k": 1e-6, "roughness": 0.3}}},
      "film": {"reflectance": 1, "temperature": "300 K", "scattering": {"film": {"n": 2.2, "k": 0.02, "thickness": "1 um", "substrate_n": 1.5, "substrate_k": 1e-4, "pane": "3 mm"}}})";
  const sampling::TileResult tile = rendered_once(aslant(
      50.0, materials,
      R"({"plane": {}, "material": "ground"}, {"box": {"low": ["-4 m", "-4 m", "0.5 m"], "high": ["4 m", "4 m", "0.9 m"]}, "material": "water"},
                {"sphere": {"center": ["0 m", "0.1 m", "0.2 m"], "radius": "0.2 m"}, "material": "metal"},
                {"sphere": {"center": ["0 m", "-0.6 m", "1.05 m"], "radius": "0.12 m"}, "material": "frosted"}, )" +
          level(5.0, 1.2, "film"),
      kWarmSky, kStokes, "10 um", kRays));
  const double all = stokes_of(tile, 0, 0);
  for (int component = 1; component < 4; ++component)
    EXPECT_NEAR(stokes_of(tile, 0, component), 0.0, 3e-3 * all) << component;
}

/// The Sun at 45 deg in the east between two walls that face each other: the floor sees it by way of both, or of one of them twice.
constexpr const char* kGlass =
    R"({"reflectance": 1, "scattering": {"smooth": {"n": 1.5, "k": 0, "over": "absorber"}}})";
std::string between_mirrors(const char* sensor, const std::string& wall_material = kGlass) {
  const auto wall = [](double x, double top) {
    return format(
        R"({{"polygon": {{"vertices": [["{0} m", "-9 m", "0 m"], ["{0} m", "9 m", "0 m"], ["{0} m", "9 m", "{1} m"], ["{0} m", "-9 m", "{1} m"]]}}, "material": "glass"}})",
        x, top);
  };
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{"black": {{"reflectance": 0}}, "floor": {{"reflectance": 0.02}},
          "glass": {}}},
        "objects": [{{"plane": {{}}, "material": "black"}}, {}, {},
          {{"polygon": {{"vertices": [["-0.6 m", "-0.1 m", "0.01 m"], ["-0.4 m", "-0.1 m", "0.01 m"], ["-0.4 m", "0.1 m", "0.01 m"], ["-0.6 m", "0.1 m", "0.01 m"]]}}, "material": "floor"}}]}},
      "light": {{"sun": {{"point": {{"zenith": "45 deg", "azimuth": "90 deg"}}}}, {}}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "0.05 m", "pixels": [1, 1], "center": ["-0.5 m", "0 m"]}}}}, {} "channels": [{{"name": "c", "monochromatic": {{"at": "0.55 um"}}}}]}},
      "sampling": {{"grid": {{"elements": [4, 4]}}}}}})",
      wall_material, wall(-1.0, 6.0), wall(1.0, 3.0), kNoSky, sensor);
}

TEST(PolarizedPanes, TheSunByWayOfTwoMirrorsIsNotTheProductOfTheirShares) {
  const Smooth glass(1.5, 45.0 * kRad);
  // Ideal mirrors of as much reflectance polarize nothing: theirs is the product of shares.
  const double share = 0.5 * (glass.p + glass.s);
  const std::string ideal = format(R"({{"reflectance": {}, "scattering": "mirror"}})", share);
  const double product = stokes_of(rendered_once(between_mirrors("", ideal)), 0, 0);
  ASSERT_GT(product, 0.0);
  // By way of two mirrors, and of three where light meets the other one first.
  const auto ways = [](double r) { return r * r + r * r * r; };
  for (const char* sensor : {kStokes, ""}) {
    const double told = stokes_of(rendered_once(between_mirrors(sensor)), 0, 0) / product;
    EXPECT_NEAR(told, 0.5 * (ways(glass.p) + ways(glass.s)) / ways(share), 2e-3) << sensor;
    EXPECT_GT(told, 1.5) << "nothing was tested";
  }
}

// One surface that polarizes, met by unpolarized light: its radiance is what it is without polarization.
TEST(PolarizedPanes, OneSurfaceOnAWayChangesNoRadiance) {
  const auto run = [](const char* sensor) {
    const std::string materials =
        R"("ground": {"reflectance": 0.4}, "hot": {"reflectance": 0, "temperature": "2000 K"},
        "pane": {"reflectance": 1, "scattering": {"slab": {"n": 1.5, "k": 1e-6, "thickness": "4 mm"}}},
        "metal": {"reflectance": 1, "scattering": {"smooth": {"n": 1.4, "k": 5, "over": "absorber"}}})";
    return rendered_once(aslant(
        20.0, materials,
        R"({"plane": {}, "material": "ground"},
           {"sphere": {"center": ["1 m", "2 m", "2 m"], "radius": "0.1 m"}, "material": "hot"},
           {"polygon": {"vertices": [["-3 m", "1 m", "0.1 m"], ["-3 m", "1 m", "3 m"], ["3 m", "1 m", "3 m"], ["3 m", "1 m", "0.1 m"]]}, "material": "pane"},
           {"polygon": {"vertices": [["2 m", "-1 m", "0 m"], ["2 m", "4 m", "0 m"], ["2 m", "4 m", "3 m"], ["2 m", "-1 m", "3 m"]]}, "material": "metal"})",
        R"("sun": {"disc": {"zenith": "50 deg", "azimuth": "20 deg"}}, "sky": {"radiance": "40 W m-2 sr-1 um-1"}, "surroundings": {"reflectance": 0})",
        sensor, "0.6 um", R"({"grid": {"elements": [6, 6]}, "max_depth": 2})"));
  };
  const sampling::TileResult told = run(kStokes), plain = run("");
  EXPECT_NEAR(stokes_of(told, 0, 0) / stokes_of(plain, 0, 0), 1.0, 2e-5);
}

// The Sun's glint on a polished ball, found by its shape.
TEST(PolarizedPanes, GlintsOnPolishedBallsAreFresnels) {
  const std::complex<double> index(1.4, 0.5);
  const sampling::TileResult tile = rendered_once(aslant(
      60.0,
      R"("ball": {"reflectance": 1, "scattering": {"smooth": {"n": 1.4, "k": 0.5, "over": "absorber"}}})",
      R"({"sphere": {"center": ["0 m", "0 m", "0 m"], "radius": "0.02 m"}, "material": "ball"})",
      R"("sun": {"disc": {"zenith": "60 deg", "azimuth": "0 deg"}}, "sky": {"none": {}}, "surroundings": {"reflectance": 0})",
      kStokes, "0.6 um", R"({"grid": {"elements": [4, 4]}})"));
  const Smooth ball(index, 60.0 * kRad);
  ASSERT_GT(stokes_of(tile, 0, 0), 0.0);
  EXPECT_NEAR(stokes_of(tile, 0, 1) / stokes_of(tile, 0, 0), (ball.s - ball.p) / (ball.s + ball.p), 1e-3);
  EXPECT_NEAR(stokes_of(tile, 0, 2) / stokes_of(tile, 0, 0), 0.0, 2e-3);
  EXPECT_GT((ball.s - ball.p) / (ball.s + ball.p), 0.5);
}

}  // namespace
}  // namespace ifov::session::test_polarized_panes
