#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/round_primitives.h"
#include "studies/common/study_document.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr double kSunDegree = std::numbers::pi / 180.0;
constexpr std::array<const char*, 5> kParts = {"emitted_radiance", "sun_radiance", "sky_radiance",
                                               "scene_radiance", "path_radiance"};

io::MaterialDocument warm(io::MaterialDocument material, double kelvin, const char* model = "lambertian") {
  material.temperature = io::TemperatureDocument{kelvin, {}};
  material.scattering.model = model;
  return material;
}

io::SpectrumDocument even(double value, io::SpectrumOf quantity) {
  io::SpectrumDocument spectrum;
  spectrum.source = io::ConstantSpectrum{value};
  spectrum.quantity = quantity;
  return spectrum;
}

}  // namespace

PartsSum parts_sum(const StudyOptions& options, double planted_factor) {
  constexpr int kPixels = 24;
  io::Document document =
      nadir_document(frame_above(kPixels, kPixels, 12.0, 0.02, 2e-4), "middle", 3.9,
                     accuracy_sampling({0.03, io::ErrorSize::Unit::fraction}), options.seed);
  document.scene.materials = {warm(grey("lawn", 0.2), 290.0), warm(grey("stove", 0.1), 420.0),
                              warm(grey("wall", 0.5), 305.0), warm(grey("mirror", 0.9), 285.0, "mirror")};
  io::BoxPrimitive stove, wall;
  stove.low_m = {-1.0, -1.0, 0.0}, stove.high_m = {-0.6, -0.5, 0.5};
  wall.low_m = {-0.4, 0.6, 0.0}, wall.high_m = {0.9, 0.8, 1.0};
  io::SpherePrimitive ball;
  ball.centre_m = {0.5, -0.4, 0.4}, ball.radius_m = 0.4;
  document.scene.objects = {level_ground("lawn"), object_of(stove, "stove"), object_of(wall, "wall"),
                            object_of(ball, "mirror")};
  io::SunDocument& sun = document.light.sun.emplace();
  sun.direction = io::CelestialDirection{35.0 * kSunDegree, 160.0 * kSunDegree};
  document.light.sky = io::SkyRadiance{even(0.4, io::SpectrumOf::radiance)};
  document.atmosphere.tabulated =
      io::TabulatedAtmosphere{even(0.8, io::SpectrumOf::fraction), even(0.1, io::SpectrumOf::radiance), {}};
  ask_for(document, {"emitted_radiance", "sun_radiance", "sky_radiance", "scene_radiance", "path_radiance"});
  const std::filesystem::path folder = run_sensor(document, "parts", options);
  const CubeValues radiance = read_product(folder, "radiance");
  std::vector<CubeValues> parts;
  for (const char* part : kParts) parts.push_back(read_product(folder, part));
  for (float& value : parts[1].values) value *= static_cast<float>(planted_factor);
  PartsSum result;
  result.shares.assign(kParts.size(), 0.0);
  double whole = 0.0;
  for (std::size_t p = 0; p < radiance.values.size(); ++p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double value = static_cast<double>(parts[k].values[p]);
      sum += value, result.shares[k] += value;
    }
    const double all = static_cast<double>(radiance.values[p]);
    whole += all;
    result.worst = std::max(result.worst, std::abs(sum / all - 1.0));
  }
  for (double& share : result.shares) share /= whole;
  return result;
}

ReportSection parts_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "What the radiance is made of";
  section.text =
      "A yard at 3.9 um, where emission and sunlight are alike: a mirror ball, a stove of 420 K, a wall, lawn, Sun, sky and air that adds light. "
      "What surfaces emit, what they reflect of the Sun, of the sky and of each other, and the light of the air add up to the radiance.";
  const PartsSum found = parts_sum(options.study);
  section.figures.at_most("parts_sum", found.worst, 1e-6, "",
                          "sum of the parts against the radiance: largest relative difference of a pixel");
  for (std::size_t k = 0; k < kParts.size(); ++k) {
    std::string what = kParts[k];
    std::replace(what.begin(), what.end(), '_', ' ');
    section.figures.report(format("share_{}", kParts[k]), 100.0 * found.shares[k], "%",
                           format("share of the image's radiance: {}", what));
  }
  return section;
}

}  // namespace ifov::studies
