#include "studies/surfaces/dome_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/shapes/round_primitives.h"
#include "materials/bsdf/rough_conductor.h"
#include "math/angle.h"
#include "radiometry/spectrum.h"
#include "sampling/random.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {
namespace {

using std::numbers::pi;

constexpr double kRadius_m = 0.4, kIrradiance_w_m2_um = 1000.0, kMetalN = 0.15, kMetalK = 3.5;
constexpr double kDome_um = 0.65, kDomeSunZenith_deg = 30.0;
constexpr int kApart_px = 13;
constexpr std::uint64_t kShifts = 3;  // seed of the places

io::SpectrumDocument constant_spectrum(double value, io::SpectrumOf quantity) {
  io::SpectrumDocument spectrum;
  spectrum.source = io::ConstantSpectrum{value};
  spectrum.quantity = quantity;
  return spectrum;
}

/// The pixel that a dome stands in.
std::pair<int, int> dome_pixel(int k, int across) {
  return {kApart_px * (k % across) + kApart_px / 2, kApart_px * (k / across) + kApart_px / 2};
}

}  // namespace

io::MaterialDocument dome_mirror(double reflectance) {
  io::MaterialDocument material = grey("dome", reflectance);
  material.scattering.model = "mirror";
  return material;
}

io::MaterialDocument dome_metal(double roughness) {
  io::MaterialDocument material = grey("dome", 1.0);
  material.scattering.model = "rough_conductor";
  material.scattering.values = {{"n", constant_spectrum(kMetalN, io::SpectrumOf::number)},
                                {"k", constant_spectrum(kMetalK, io::SpectrumOf::number)},
                                {"roughness", roughness}};
  return material;
}

double mirror_dome_radiance(double reflectance, const DomeLight& light) {
  return reflectance * kRadius_m * kRadius_m *
         (kIrradiance_w_m2_um / 4.0 + light.sky_radiance_w_m2_sr_um * 0.5 * pi);
}

double metal_dome_radiance(double roughness) {
  const materials::RoughConductor metal(
      radiometry::Spectrum::constant(kMetalN), radiometry::Spectrum::constant(kMetalK),
      radiometry::Spectrum::constant(1.0), {materials::FacetShape::ggx, roughness, roughness, 0.0});
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : metal.spectra())
    values.push_back(static_cast<float>(spectrum.at(kDome_um)));
  for (const float& value : values) rows.push_back(&value);
  // Polar coordinates about the highlight's middle, the radius by steps that grow with it.
  const double zenith = kDomeSunZenith_deg * math::kDegree;
  const math::Vec3 sun{std::sin(zenith), 0.0, std::cos(zenith)};
  const math::Vec3 half = math::normalized(sun + math::Vec3{0.0, 0.0, 1.0});
  constexpr int kRings = 1500, kTurns = 400;
  double sum = 0.0;
  const double least = 1e-3 * roughness, most = 2.0;
  const double ratio = std::log(most / least + 1.0) / kRings;
  for (int i = 0; i < kRings; ++i) {
    const double r = least * (std::exp((i + 0.5) * ratio) - 1.0), dr = (r + least) * ratio;
    for (int j = 0; j < kTurns; ++j) {
      const double turn = 2.0 * pi * (j + 0.5) / kTurns, x = half.x + r * std::cos(turn),
                   y = half.y + r * std::sin(turn);
      if (x * x + y * y >= 1.0) continue;
      materials::BsdfEvent event;
      event.outgoing = {0.0, 0.0, 1.0};
      event.incoming = sun;
      event.normal = math::as_normal({x, y, std::sqrt(1.0 - x * x - y * y)});
      if (!(event.incoming_cosine() > 0.0)) continue;
      float bsdf = 0.0f;
      metal.evaluate(event, rows, 1, &bsdf);
      sum += static_cast<double>(bsdf) * event.incoming_cosine() * r * dr * 2.0 * pi / kTurns;
    }
  }
  return sum * kIrradiance_w_m2_um * kRadius_m * kRadius_m;
}

io::Document dome_document(const io::MaterialDocument& surface, const DomeLight& light, int across,
                           double error, std::uint64_t seed) {
  const int pixels = kApart_px * across;
  io::Document document =
      nadir_document(nadir_camera(pixels, pixels, -0.5 * pixels, 0.5 * pixels), "red", kDome_um,
                     accuracy_sampling({error, io::ErrorSize::Unit::fraction}), seed);
  document.scene.materials = {grey("ground", 0.0), surface};
  document.scene.objects = {object_of(io::PlanePrimitive(), "ground")};
  for (int k = 0; k < across * across; ++k) {
    const auto shift = [&](std::uint64_t axis) {
      const std::uint64_t number = 2 * static_cast<std::uint64_t>(k) + axis;
      return 0.19 * (sampling::unit_double(sampling::hash(kShifts, number)) - 0.5);
    };
    const auto [column, row] = dome_pixel(k, across);
    io::HemispherePrimitive dome;
    dome.centre_m = {column + 0.5 - 0.5 * pixels + shift(0), 0.5 * pixels - row - 0.5 + shift(1), 0.0};
    dome.radius_m = kRadius_m;
    document.scene.objects.push_back(object_of(dome, surface.name));
  }
  io::SunDocument& sun = document.light.sun.emplace();
  sun.direction = io::CelestialDirection{kDomeSunZenith_deg * math::kDegree, 90.0 * math::kDegree};
  sun.diameter_rad = light.sun_is_disc ? 0.53 * math::kDegree : 0.0;
  sun.irradiance = constant_spectrum(kIrradiance_w_m2_um, io::SpectrumOf::irradiance);
  document.light.sky =
      io::SkyRadiance{constant_spectrum(light.sky_radiance_w_m2_sr_um, io::SpectrumOf::radiance)};
  document.light.surroundings.emplace().spectrum = constant_spectrum(0.0, io::SpectrumOf::reflectance);
  return document;
}

JudgedDomes judge_domes(const io::MaterialDocument& surface, const DomeLight& light, double truth, int across,
                        const StudyOptions& options) {
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(study_text(dome_document(surface, light, across, 0.01, options.seed)),
                  options.output_folder, choices, image);
  JudgedDomes judged;
  judged.count = across * across;
  for (int k = 0; k < judged.count; ++k) {
    const auto [column, row] = dome_pixel(k, across);
    const std::size_t p = image.index(column, row);
    const double value = static_cast<double>(image.mean()[p]), off = std::abs(value - truth);
    judged.within += off <= 0.01 * truth;
    judged.held += off <= static_cast<double>(image.half_width()[p]);
    judged.sure += image.converged(p);
    judged.wrong_and_sure += image.converged(p) && off > 0.03 * truth;
    judged.worst = std::max(judged.worst, off / truth);
    judged.mean += value / truth / judged.count;
    judged.samples += static_cast<double>(image.samples()[p]) / judged.count;
  }
  return judged;
}

}  // namespace ifov::studies
