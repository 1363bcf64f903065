// Polarized light from a document to tiles: directions on the focal plane, intervals of Q and U, polarizers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/polarized/stokes_columns.h"
#include "render/tile_sink.h"
#include "render/tolerance/degree_limits.h"
#include "sampling/tile.h"
#include "session/loaded/parts.h"
#include "session/messages.h"
#include "session/polarized_run.h"
#include "session/session.h"

namespace ifov::session::test_polarization {
namespace {

using test::rendered_once;
using test::stokes_of;
using test::TheTile;

constexpr const char* kBlue = R"({"name": "blue", "monochromatic": {"at": "0.37 um"}})";

/// A pixel that looks straight down at a plane of a material through clear air; the Sun stands low in the azimuth 60 deg.
std::string nadir(const std::string& material, const std::string& altitude, const std::string& camera = "",
                  const std::string& sun = "60 deg") {
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{"ground": {}}}, "objects": [{{"plane": {{}}, "material": "ground"}}]}},
      "light": {{"sun": {{"point": {{"zenith": "78.463 deg", "azimuth": "{}"}}}}, "surroundings": {{"reflectance": 0}}}},
      "atmosphere": {{"profile": "US standard 1976", "aerosol": {{"type": "none"}}, "adjacency": false{}}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [1, 1]{}}}}}, "stokes": true, "channels": [{}]}},
      "sampling": {{"grid": {{"elements": [1, 1]}}}}}})",
      material, sun, altitude, camera, kBlue);
}

// Light scattered once at a right angle swings across the Sun's plane. With the Sun in the azimuth 60 deg, 30 deg
// counterclockwise from the image's right, that is 120 deg: Q < 0 and U < 0. Natraj, Li and Yung (2009) have 0.709 for an
// optical depth of 0.5 without depolarization; air's molecules depolarize to about 0.94 of it.
TEST(Polarization, SkyAndPathSwingAcrossTheSunsPlane) {
  const auto check = [](const sampling::TileResult& tile) {
    const double i = stokes_of(tile, 0, 0), q = stokes_of(tile, 0, 1), u = stokes_of(tile, 0, 2);
    const double degree = std::hypot(q, u) / i;
    EXPECT_GT(degree, 0.6);
    EXPECT_LT(degree, 0.72);
    const double angle = 0.5 * std::atan2(u, q) * 180.0 / std::numbers::pi + 180.0;
    EXPECT_NEAR(angle, 120.0, 0.3);
    // What a fault in the hand of the frames would show: the Sun on the other side.
    EXPECT_GT(std::abs(0.5 * std::atan2(-u, q) * 180.0 / std::numbers::pi + 180.0 - 120.0), 50.0);
  };
  check(rendered_once(nadir(R"({"reflectance": 0})", "")));
  // The sky that comes down, in a mirror seen from below the air.
  check(rendered_once(
      nadir(R"({"reflectance": 1, "scattering": "mirror"})", R"(, "sensor_altitude": "10 m")")));
}

// Seen aslant to the north, the Sun in the east and in the west make mirror images of each other, and neither is what
// the other is.
TEST(Polarization, TheSunOnEitherSideMakesMirrorImages) {
  const auto from = [](const std::string& sun) {
    return rendered_once(
        nadir(R"({"reflectance": 0})", "", R"(, "view_zenith": "40 deg", "view_azimuth": "180 deg")", sun));
  };
  const sampling::TileResult east = from("70 deg"), west = from("290 deg");
  const double i = stokes_of(east, 0, 0);
  EXPECT_NEAR(stokes_of(west, 0, 1), stokes_of(east, 0, 1), 1e-4 * i);
  EXPECT_NEAR(stokes_of(west, 0, 2), -stokes_of(east, 0, 2), 1e-4 * i);
  EXPECT_GT(std::abs(stokes_of(east, 0, 2)), 0.1 * i);
  // Across the plane of Sun and sight, (k cross sun) about x = east and y = k cross x; light scattered again turns it a little.
  const auto angle = [](const sampling::TileResult& tile) {
    const double half =
        0.5 * std::atan2(stokes_of(tile, 0, 2), stokes_of(tile, 0, 1)) * 180.0 / std::numbers::pi;
    return half < 0.0 ? half + 180.0 : half;
  };
  EXPECT_NEAR(angle(east), 112.7, 6.0);
  EXPECT_NEAR(angle(west), 67.3, 6.0);
}

/// Glossy and matt balls on a glossy floor, aslant; `sensor` adds keys, `channels` are all of the list.
std::string glossy(const std::string& sensor, const std::string& channels, const std::string& sampling) {
  return format(R"({{"ifov": 1, "scene": {{"materials": {{
        "floor": {{"reflectance": 0.2, "scattering": {{"rough_dielectric": {{"index": 1.5, "roughness": 0.3}}}}}},
        "metal": {{"reflectance": 1, "scattering": {{"rough_conductor": {{"index": "aluminium", "roughness": 0.4}}}}}},
        "paint": {{"reflectance": 0.6}}}},
      "objects": [{{"plane": {{}}, "material": "floor"}},
        {{"sphere": {{"center": ["-1 m", "0 m", "1 m"], "radius": "1 m"}}, "material": "metal"}},
        {{"sphere": {{"center": ["1.3 m", "0.3 m", "0.8 m"], "radius": "0.8 m"}}, "material": "paint"}}]}},
      "light": {{"sun": {{"disc": {{"zenith": "40 deg", "azimuth": "110 deg"}}}}, "sky": {{"radiance": "40 W m-2 sr-1 um-1"}}}},
      "sensor": {{"camera": {{"frame": {{"pixels": [6, 6], "focal_length": "100 mm", "pitch": "5 mm",
          "position": ["0 m", "-14 m", "9 m"], "look_at": ["0 m", "0 m", "0.5 m"]}}}}, {} "channels": [{}]}},
      "sampling": {}}})",
                sensor, channels, sampling);
}

constexpr const char* kGreen = R"({"name": "green", "monochromatic": {"at": "0.55 um"}})";

TEST(Polarization, RadianceIsTheSameWhetherItIsAskedForOrNot) {
  const std::string rays = R"({"grid": {"elements": [8, 8]}})";
  const sampling::TileResult told = rendered_once(glossy(R"("stokes": true,)", kGreen, rays)),
                             plain = rendered_once(glossy("", kGreen, rays));
  ASSERT_EQ(told.mean.size(), plain.mean.size());
  double most = 0.0;
  for (std::size_t p = 0; p < plain.mean.size(); ++p) {
    // A surface polarizes what another then reflects as it is polarized: a few per cent here, which plain radiance has, too.
    EXPECT_NEAR(told.mean[p], plain.mean[p], 1e-5f * plain.mean[p]) << p;
    most = std::max(most, std::hypot(stokes_of(told, p, 1), stokes_of(told, p, 2)) / stokes_of(told, p, 0));
  }
  EXPECT_GT(most, 0.05);
}

TEST(Polarization, IntervalsOfQAndUHoldTheTruth) {
  const sampling::TileResult truth =
      rendered_once(glossy(R"("stokes": true,)", kGreen, R"({"accuracy": {"error": "0.7 %"}})"), 1000);
  int inside = 0, inside_half = 0, count = 0;
  const std::string document = glossy(R"("stokes": true,)", kGreen, R"({"accuracy": {"error": "5 %"}})");
  const Session session = Session::load(io::parse_document(document, "polarized.json"), nullptr);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    render::RenderJob job = session.parts().job();
    job.seed = seed;
    render::RenderControl control;
    control.threads = 1;
    TheTile tile;
    render::render_image(job, control, tile);
    const auto widths = tile.result.layer(render::StokesLayers::kHalfWidth)->values<float>();
    const auto own = truth.layer(render::StokesLayers::kStandardError)->values<float>();
    for (std::size_t p = 0; p < 36; ++p)
      for (int component = 1; component <= 2; ++component) {
        const double off = std::abs(stokes_of(tile.result, p, component) - stokes_of(truth, p, component)),
                     width = static_cast<double>(widths[3 * p + static_cast<std::size_t>(component) - 1]),
                     left = 2.0 * static_cast<double>(own[4 * p + static_cast<std::size_t>(component)]);
        inside += off <= width + left, ++count;
        inside_half += off <= 0.1 * width;
      }
  }
  EXPECT_GT(inside, 0.95 * count) << inside << " of " << count;
  EXPECT_LT(inside_half, 0.8 * count) << "intervals of a tenth of that hold it too: nothing was tested";
}

/// Of a pixel's degree of linear polarization in the one channel of a tile.
struct Degree {
  double value, half_width;
};
Degree degree(const sampling::TileResult& tile, std::size_t p) {
  const auto widths = tile.layer(render::StokesLayers::kHalfWidth)->values<float>();
  const double i = stokes_of(tile, p, 0), q = stokes_of(tile, p, 1), u = stokes_of(tile, p, 2);
  return {std::hypot(q, u) / i, render::degree_half_width(i, q, u, static_cast<double>(tile.half_width[p]),
                                                          static_cast<double>(widths[3 * p]),
                                                          static_cast<double>(widths[3 * p + 1]))};
}

// What is asked of the degree of polarization is reached, and its intervals hold what a finer run finds.
TEST(Polarization, AnErrorOfTheDegreeIsReachedAndItsIntervalsHoldTheTruth) {
  const auto asking = [](const char* error) {
    return glossy(R"("stokes": true,)", kGreen, format(R"({{"accuracy": {{"error": "{}"}}}})", error));
  };
  constexpr double kAsked = 0.04;
  const sampling::TileResult truth = rendered_once(asking("0.8 % DoLP"), 1000);
  const Session session = Session::load(io::parse_document(asking("4 % DoLP"), "polarized.json"), nullptr);
  int inside = 0, inside_tenth = 0, count = 0;
  double widest = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    render::RenderJob job = session.parts().job();
    job.seed = seed;
    render::RenderControl control;
    control.threads = 1;
    TheTile tile;
    render::render_image(job, control, tile);
    for (std::size_t p = 0; p < 36; ++p) {
      EXPECT_TRUE(tile.result.converged(p)) << p;
      const Degree found = degree(tile.result, p), exact = degree(truth, p);
      EXPECT_LE(found.half_width, kAsked * 1.001) << p;
      widest = std::max(widest, found.half_width);
      const double off = std::abs(found.value - exact.value);
      EXPECT_LE(off, 2.0 * kAsked) << p;
      inside += off <= found.half_width + exact.half_width, ++count;
      inside_tenth += off <= 0.1 * found.half_width;
    }
  }
  EXPECT_GT(inside, 0.95 * count) << inside << " of " << count;
  EXPECT_LT(inside_tenth, 0.9 * count) << "intervals of a tenth of that hold it too: nothing was tested";
  EXPECT_GT(widest, 0.3 * kAsked) << "far more rays than were asked for";
  // Planted fault: Q and U within a tenth of I, as a looser error of the radiance leaves them, tell less of the degree.
  const sampling::TileResult other = rendered_once(asking("10 %"), 1);
  double of_other = 0.0;
  for (std::size_t p = 0; p < 36; ++p) of_other = std::max(of_other, degree(other, p).half_width);
  EXPECT_GT(of_other, 1.1 * kAsked);
}

TEST(Polarization, PolarizersPassWhatTheStokesVectorSays) {
  const std::string polarized = format(
      R"({}, {{"name": "a", "monochromatic": {{"at": "0.55 um"}}, "polarizer": {{"angle": "0 deg", "extinction": 1e9}}}},
         {{"name": "b", "monochromatic": {{"at": "0.55 um"}}, "polarizer": {{"angle": "45 deg", "extinction": 1e9}}}},
         {{"name": "c", "monochromatic": {{"at": "0.55 um"}}, "polarizer": {{"angle": "90 deg", "extinction": 4}}}})",
      kGreen);
  const sampling::TileResult tile =
      rendered_once(glossy(R"("stokes": true,)", polarized, R"({"grid": {"elements": [4, 4]}})"));
  double turned_wrong = 0.0;
  for (std::size_t p = 0; p < 36; ++p) {
    const double i = stokes_of(tile, p, 0), q = stokes_of(tile, p, 1), u = stokes_of(tile, p, 2);
    EXPECT_NEAR(tile.mean[4 * p + 1], 0.5 * (i + q), 1e-5 * i);
    EXPECT_NEAR(tile.mean[4 * p + 2], 0.5 * (i + u), 1e-5 * i);
    EXPECT_NEAR(tile.mean[4 * p + 3], 0.5 * (i - q) + 0.125 * (i + q), 1e-5 * i);
    turned_wrong =
        std::max(turned_wrong, std::abs(static_cast<double>(tile.mean[4 * p + 2]) - 0.5 * (i - u)) / i);
  }
  EXPECT_GT(turned_wrong, 0.01) << "an axis turned the other way passes";
}

// Light from the sky that a crossed polarizer leaves little of is as unsure as all of it: Q and U may be off by 2 % of I.
TEST(Polarization, CrossedPolarizersLeaveTheAirsErrorOfAllLight) {
  const auto at = [](double angle_deg) {
    std::string document =
        nadir(R"({"reflectance": 1, "scattering": "mirror"})", R"(, "sensor_altitude": "10 m")");
    const std::string plain = "[" + std::string(kBlue) + "]";
    document.replace(
        document.find(plain), plain.size(),
        format(
            R"([{}, {{"name": "c", "monochromatic": {{"at": "0.37 um"}}, "polarizer": {{"angle": "{} deg", "extinction": 1e6}}}}])",
            kBlue, angle_deg));
    document.replace(document.find(R"({"grid": {"elements": [1, 1]}})"), 30,
                     R"({"accuracy": {"error": "1 %"}})");
    return rendered_once(document);
  };
  const sampling::TileResult crossed = at(30.0), along = at(120.0);
  const double i = static_cast<double>(crossed.mean[0]), rest = static_cast<double>(crossed.mean[1]);
  EXPECT_NEAR(rest / i, 0.5 * (1.0 - std::hypot(stokes_of(crossed, 0, 1), stokes_of(crossed, 0, 2)) / i),
              0.01);
  EXPECT_LT(rest, 0.22 * i);
  EXPECT_GT(static_cast<double>(crossed.half_width[1]), 0.5 * 0.02 * 0.95 * i);
  // Planted fault: as much of what is left, as if that were half of all.
  EXPECT_GT(0.5 * 0.02 * 0.95 * i, 1.5 * 0.02 * rest);
  EXPECT_GT(along.mean[1], 3.0f * crossed.mean[1]);
}

double degree_of(const sampling::TileResult& tile) {
  return std::hypot(stokes_of(tile, 0, 1), stokes_of(tile, 0, 2)) / stokes_of(tile, 0, 0);
}

/// The sky at a zenith angle of 60 deg and an azimuth from the Sun, by way of a mirror on ground of 0.2; seen from the south.
sampling::TileResult sky_at_60_deg(double from_sun_deg, double sun_zenith_deg, double um, double ozone_du) {
  return rendered_once(format(
      R"({{"ifov": 1, "scene": {{"materials": {{"mirror": {{"reflectance": 1, "scattering": "mirror"}}}}, "objects": [{{"plane": {{}}, "material": "mirror"}}]}},
      "light": {{"sun": {{"point": {{"zenith": "{} deg", "azimuth": "{} deg"}}}}, "surroundings": {{"reflectance": 0.2}}}},
      "atmosphere": {{"profile": "US standard 1976", "aerosol": {{"type": "none"}}, "adjacency": false, "ozone": "{} DU", "sensor_altitude": "10 m"}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [1, 1], "view_zenith": "60 deg", "view_azimuth": "180 deg"}}}}, "stokes": true,
                  "channels": [{{"name": "uv", "monochromatic": {{"at": "{} um"}}}}]}},
      "sampling": {{"grid": {{"elements": [1, 1]}}}}}})",
      sun_zenith_deg, -from_sun_deg, ozone_du, um));
}

TEST(Polarization, TheSkyIsThatOfOtherPrograms) {
  // libRadtran's examples POLRADTRAN (350 nm, 8 streams: I, Q, U from below by azimuth from the Sun) and UVSPEC_MC_POL (310 nm, by
  // chance: 1e5 photons).
  struct Row {
    double from_sun_deg, i, q, u;
  };
  const Row rows[] = {{0.0, 130.1478, -5.494042, 0.0},
                      {90.0, 101.3086, -9.090019, 38.74593},
                      {180.0, 91.40182, -44.23997, 0.0}};
  // Their radiance is in units of another solar spectrum, their Q across ours; a mirror turns U about, as our frame does, seen against
  // the light. Molecules depolarize by 0.4 % more here.
  double unit = 0.0;
  for (const Row& row : rows) {
    const sampling::TileResult tile = sky_at_60_deg(row.from_sun_deg, 32.0, 0.35, 325.0);
    const double i = stokes_of(tile, 0, 0);
    if (unit == 0.0) unit = i / row.i;
    EXPECT_NEAR(i / row.i / unit, 1.0, 2e-3) << row.from_sun_deg;
    EXPECT_NEAR(degree_of(tile), std::hypot(row.q, row.u) / row.i, 2.5e-3) << row.from_sun_deg;
    EXPECT_NEAR(stokes_of(tile, 0, 1) / i, -row.q / row.i, 2.5e-3) << row.from_sun_deg;
    EXPECT_NEAR(stokes_of(tile, 0, 2) / i, -row.u / row.i, 2.5e-3) << row.from_sun_deg;
  }
  // Seen on the Sun's other side U has the other sign: 0.76 off.
  const double other = stokes_of(sky_at_60_deg(270.0, 32.0, 0.35, 325.0), 0, 2);
  EXPECT_GT(other, 0.0);
  const sampling::TileResult by_chance = sky_at_60_deg(140.0, 30.0, 0.31, 300.0);
  const double mystic = std::hypot(0.0123138, 0.0106521) / 0.037213;
  EXPECT_NEAR(degree_of(by_chance), mystic, 0.015 * mystic);
}

/// A nearly smooth plate seen 60 deg aslant, for a channel at 10 um; `plate` and `sky` are what they have of warmth.
sampling::TileResult plate(const std::string& metal, const std::string& sky) {
  return rendered_once(format(
      R"({{"ifov": 1, "scene": {{"materials": {{"plate": {{"reflectance": 0{},
              "scattering": {{"rough_dielectric": {{"index": 1.5, "roughness": 0.02}}}}}}}}, "objects": [{{"plane": {{}}, "material": "plate"}}]}},
      "light": {{"sky": {}, "surroundings": {{"reflectance": 0}}}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [1, 1], "view_zenith": "60 deg", "view_azimuth": "180 deg"}}}}, "stokes": true,
                  "channels": [{{"name": "tir", "monochromatic": {{"at": "10 um"}}}}]}},
      "sampling": {{"grid": {{"elements": [64, 64]}}}}}})",
      metal, sky));
}

TEST(Polarization, WhatAPlateEmitsIsOppositeToWhatItReflects) {
  const sampling::TileResult emits = plate(R"(, "temperature": "300 K")", R"({"none": {}})"),
                             reflects = plate(R"(, "temperature": "3 K")", R"({"temperature": "300 K"})"),
                             room = plate(R"(, "temperature": "300 K")", R"({"temperature": "300 K"})");
  const double all = stokes_of(room, 0, 0), emitted = stokes_of(emits, 0, 1),
               reflected = stokes_of(reflects, 0, 1);
  // Waves that swing level are reflected best, and emitted least: 60 deg from the normal R_s = 0.177, R_p = 0.0018.
  EXPECT_NEAR(stokes_of(reflects, 0, 0) / all, 0.0892, 1e-3);
  EXPECT_NEAR(reflected / all, 0.0875, 1e-3);
  EXPECT_NEAR(emitted / all, -0.0875, 1e-3);
  EXPECT_NEAR(stokes_of(room, 0, 1), 0.0, 1e-4 * all);
  EXPECT_NEAR(stokes_of(room, 0, 2), 0.0, 1e-4 * all);
  // Planted fault: emission whose sign is that of what is reflected.
  EXPECT_GT(std::abs(reflected - emitted), 0.1 * all);
}

/// The Sun's glint on the sea, seen where calm water would show it.
TEST(Polarization, GlintsOnTheSeaArePolarizedByFresnelsLaw) {
  {
    constexpr double angle_deg = 30.0;
    const sampling::TileResult tile = rendered_once(format(
        R"({{"ifov": 1, "scene": {{"materials": {{"water": {{"reflectance": 0, "scattering": {{"sea": {{"wind": 5, "whitecaps": 0}}}}}}}}, "objects": [{{"plane": {{}}, "material": "water"}}]}},
      "light": {{"sun": {{"point": {{"zenith": "{} deg", "azimuth": "0 deg"}}}}, "sky": {{"none": {{}}}}, "surroundings": {{"reflectance": 0}}}},
      "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [1, 1], "view_zenith": "{} deg", "view_azimuth": "180 deg"}}}}, "stokes": true,
                  "channels": [{{"name": "green", "monochromatic": {{"at": "0.55 um"}}}}]}},
      "sampling": {{"grid": {{"elements": [4, 4]}}}}}})",
        angle_deg, angle_deg));
    const double n = 1.3405, angle = angle_deg * std::numbers::pi / 180.0,
                 inner = std::asin(std::sin(angle) / n);
    const double s = std::pow(std::sin(angle - inner) / std::sin(angle + inner), 2),
                 p = std::pow(std::tan(angle - inner) / std::tan(angle + inner), 2);
    EXPECT_NEAR(stokes_of(tile, 0, 1) / stokes_of(tile, 0, 0), (s - p) / (s + p), 5e-4);
    EXPECT_NEAR(stokes_of(tile, 0, 2) / stokes_of(tile, 0, 0), 0.0, 1e-4);
    // Planted fault: facets that are met at the angle from the vertical of another glint.
    EXPECT_GT(std::abs((s - p) / (s + p) - 0.4), 0.03);
  }
}

}  // namespace
}  // namespace ifov::session::test_polarization
