// Radiance alone has what surfaces make of the polarization of skylight, which a sensor need not tell for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>

#include "atmosphere/survey/sky_view.h"
#include "core/format.h"
#include "io/document/document.h"
#include "sampling/tile.h"
#include "session/polarized_run.h"
#include "session/surveys/atmosphere_survey.h"

namespace ifov::session::test_polarized_skylight {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Scene {
  std::string material, more_objects = "";
  double zenith_deg = 56.0, azimuth_deg = 130.0;  ///< of the camera
  std::string sensor = "", sampling = R"({"grid": {"elements": [2, 2]}})";
  std::string sky =
      R"("atmosphere": {"profile": "US standard 1976", "aerosol": {"type": "none"}, "adjacency": false},)";
};

/// A pixel at the origin, seen from 20 m away. The Sun stands in the azimuth 130 deg, 40 deg above the horizon.
std::string document(const Scene& scene) {
  const double zenith = scene.zenith_deg * kDegree, azimuth = scene.azimuth_deg * kDegree;
  const double away_m = 20.0 * std::sin(zenith);
  return format(R"({{"ifov": 1, "scene": {{"materials": {{
        "glass": {{"scattering": {{"smooth": {{"n": 1.5, "k": 0, "over": "absorber"}}}}}},
        "mirror": {{"reflectance": 1, "scattering": "mirror"}},
        "varnish": {{"reflectance": 0.3, "scattering": {{"rough_dielectric": {{"index": 1.5, "roughness": 0.3}}}}}},
        "plaster": {{"reflectance": 0.5}}}},
      "objects": [{{"plane": {{}}, "material": "{}"}}{}]}},
      "light": {{"sun": {{"disc": {{"zenith": "50 deg", "azimuth": "130 deg"}}}}, "surroundings": {{"reflectance": 0}}}}, {}
      "sensor": {{"camera": {{"frame": {{"pixels": [1, 1], "focal_length": "1 m", "pitch": "1 mm",
          "position": ["{} m", "{} m", "{} m"], "look_at": ["0 m", "0 m", "0 m"]}}}}, {}
        "channels": [{{"name": "blue", "monochromatic": {{"at": "0.45 um"}}}}]}},
      "sampling": {}}})",
                scene.material, scene.more_objects, scene.sky, away_m * std::sin(azimuth),
                away_m * std::cos(azimuth), 20.0 * std::cos(zenith), scene.sensor, scene.sampling);
}

/// Mean of so many runs.
double radiance(const Scene& scene, std::uint64_t seeds = 1) {
  const Session session = Session::load(io::parse_document(document(scene), "pane.json"), nullptr);
  render::RenderJob job = session.parts().job();
  render::RenderControl control;
  control.threads = 1;
  double sum = 0.0;
  for (job.seed = 1; job.seed <= seeds; ++job.seed) {
    test::TheTile tile;
    render::render_image(job, control, tile);
    sum += static_cast<double>(tile.result.mean[0]);
  }
  return sum / static_cast<double>(seeds);
}

/// |r_p|^2 and |r_s|^2 of a boundary into n = 1.5.
std::array<double, 2> fresnel(double zenith_rad) {
  const double c = std::cos(zenith_rad), g = std::sqrt(1.5 * 1.5 - std::pow(std::sin(zenith_rad), 2));
  return {std::pow((2.25 * c - g) / (2.25 * c + g), 2), std::pow((c - g) / (c + g), 2)};
}

// Whoever gives a sky without its polarization is told where that matters: on glass, not on plaster.
TEST(PolarizedSkylight, SkiesOfOnesOwnAreSaidToBeUnpolarized) {
  const auto said = [](const std::string& material, const std::string& sky) {
    Scene scene{.material = material};
    std::string text = document(scene);
    const bool of_light = sky.starts_with("\"sky\"");
    text.replace(text.find(scene.sky), scene.sky.size(), of_light ? "" : sky);
    if (of_light) text.replace(text.find("\"surroundings\""), 0, sky);
    if (material == "plaster")
      text.erase(text.find("\"glass\""), text.find("\"plaster\"") - text.find("\"glass\""));
    return Session::load(io::parse_document(text, "pane.json"), nullptr).description();
  };
  const std::string words =
      "is taken to be unpolarized; what glass, water and metal reflect of it may be off";
  const std::string
      light = R"("sky": {"radiance": "60 W m-2 sr-1 um-1"}, )",
      uniform = R"("atmosphere": {"uniform": {"direct": "900 W m-2 um-1", "diffuse": "100 W m-2 um-1"}},)";
  EXPECT_NE(said("glass", light).find("the sky of 'light.sky' " + words), std::string::npos);
  EXPECT_NE(said("glass", uniform).find("the sky of 'uniform' " + words), std::string::npos);
  EXPECT_EQ(said("plaster", light).find(words), std::string::npos);
  EXPECT_EQ(said("glass", Scene{}.sky).find(words), std::string::npos);  // twin: a sky that is polarized
}

// At Brewster's angle a pane shows of skylight what swings level, across the plane of incidence. What it shows over what a mirror does
// follows from Fresnel's equations and the sky's Q/I, which a solution tells that was checked against tables.
TEST(PolarizedSkylight, APaneShowsItByFresnelsEquations) {
  for (const double azimuth_deg : {40.0, 130.0, 220.0}) {
    const Scene pane{"glass", "", 56.0, azimuth_deg};
    Scene mirror = pane;
    mirror.material = "mirror";
    AtmosphereQuestion question;
    question.sky = true;
    const io::AtmosphereReport told =
        survey_atmosphere(io::parse_document(document(pane), "pane.json"), question);
    const double path = told.channels[0].light.solar_path;
    // The sky behind the pane stands opposite the camera; azimuths count from the Sun's.
    const auto index = [](const std::vector<double>& at, double value) {
      return static_cast<std::size_t>(
          std::ranges::find_if(at, [&](double a) { return std::abs(a - value) < 1e-9; }) - at.begin());
    };
    const double from_sun = std::abs(std::remainder(azimuth_deg + 180.0 - 130.0, 360.0));
    const auto sky = told.sky->at(index(told.sky->zenith_rad, 56.0 * kDegree),
                                  index(told.sky->azimuth_rad, from_sun * kDegree));
    const auto [p, s] = fresnel(56.0 * kDegree);
    const double q = sky.q / sky.i, wanted = 0.5 * (p * (1.0 + q) + s * (1.0 - q));
    const double found = (radiance(pane) - path) / (radiance(mirror) - path);
    EXPECT_NEAR(found / wanted, 1.0, 4e-3) << azimuth_deg;
    // Planted: of unpolarized skylight.
    EXPECT_GT(std::abs(0.5 * (p + s) / wanted - 1.0), 0.05) << azimuth_deg;
    // Planted: of what swings upright.
    EXPECT_GT(std::abs(0.5 * (p * (1.0 - q) + s * (1.0 + q)) / wanted - 1.0), 0.1) << azimuth_deg;
  }
}

/// An upright pane beyond the pixel.
constexpr const char* kPane = R"(,
        {"box": {"low": ["-9 m", "3 m", "-1 m"], "high": ["9 m", "4 m", "9 m"]}, "material": "glass"})";

// Samplers take apart what they trace: with Q and U and without they have the same radiance.
TEST(PolarizedSkylight, RadianceIsThatOfARunThatTellsPolarization) {
  const std::string air =
      R"("atmosphere": {"profile": "mid-latitude summer", "aerosol": {"type": "rural", "visibility": "23 km"}},)";
  for (const char* ground : {"plaster", "varnish", "glass"}) {
    for (const char* sampling :
         {R"({"grid": {"elements": [24, 24]}})", R"({"accuracy": {"error": "1 %"}})"}) {
      Scene plain{ground, kPane, 50.0, 170.0, "", sampling, air}, told = plain;
      told.sensor = R"("stokes": true,)";
      constexpr std::uint64_t kSeeds = 8;
      EXPECT_NEAR(radiance(plain, kSeeds) / radiance(told, kSeeds), 1.0, 3e-3) << ground << sampling;
    }
  }
}

}  // namespace
}  // namespace ifov::session::test_polarized_skylight
