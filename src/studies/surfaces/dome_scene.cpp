#include "studies/surfaces/dome_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/shapes/round_primitives.h"
#include "math/angle.h"
#include "sampling/random.h"
#include "studies/common/study_document.h"
#include "studies/surfaces/surface_rendering.h"

namespace ifov::studies {
namespace {

using std::numbers::pi;

using namespace domes;

constexpr int kApart_px = 13;
constexpr int kMostAcross = 4;        // domes of one picture
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

io::Document dome_document(const io::MaterialDocument& surface, const DomeLight& light, int across, int first,
                           double error, std::uint64_t seed) {
  const int pixels = kApart_px * across;
  io::Document document =
      nadir_document(nadir_camera(pixels, pixels, -0.5 * pixels, 0.5 * pixels), "red", kDome_um,
                     accuracy_sampling({error, io::ErrorSize::Unit::fraction}), seed);
  document.scene.materials = {grey("ground", 0.0), surface};
  document.scene.objects = {object_of(io::PlanePrimitive(), "ground")};
  for (int k = 0; k < across * across; ++k) {
    const auto shift = [&](std::uint64_t axis) {
      const std::uint64_t number = 2 * static_cast<std::uint64_t>(first + k) + axis;
      return 0.19 * (sampling::unit_double(sampling::hash(kShifts, number)) - 0.5);
    };
    const auto [column, row] = dome_pixel(k, across);
    io::HemispherePrimitive dome;
    dome.centre_m = {column + 0.5 - 0.5 * pixels + shift(0), 0.5 * pixels - row - 0.5 + shift(1), 0.0};
    dome.radius_m = kRadius_m;
    document.scene.objects.push_back(object_of(dome, surface.name));
  }
  io::SunDocument& sun = document.light.sun.emplace();
  sun.direction = io::CelestialDirection{kSunZenith_deg * math::kDegree, 90.0 * math::kDegree};
  sun.diameter_rad = light.sun_is_disc ? 0.53 * math::kDegree : 0.0;
  sun.irradiance = constant_spectrum(kIrradiance_w_m2_um, io::SpectrumOf::irradiance);
  document.light.sky =
      io::SkyRadiance{constant_spectrum(light.sky_radiance_w_m2_sr_um, io::SpectrumOf::radiance)};
  document.light.surroundings.emplace().spectrum = constant_spectrum(0.0, io::SpectrumOf::reflectance);
  return document;
}

JudgedDomes judge_domes(const io::MaterialDocument& surface, const DomeLight& light, double truth, int shifts,
                        const StudyOptions& options) {
  const int across = std::clamp(static_cast<int>(std::ceil(std::sqrt(shifts))), 1, kMostAcross);
  JudgedDomes judged;
  for (std::uint64_t picture = 0; judged.count < shifts; ++picture) {
    if (options.cancel != nullptr && options.cancel->cancelled()) throw Cancelled();
    const SurfaceImage image = render_surface(
        dome_document(surface, light, across, judged.count, 0.01, options.seed + picture), options);
    for (int k = 0; k < across * across; ++k) {
      const auto [column, row] = dome_pixel(k, across);
      const std::size_t p = image.index(column, row);
      const double value = static_cast<double>(image.radiance[p]), off = std::abs(value - truth);
      judged.within += off <= 0.01 * truth;
      judged.held += off <= static_cast<double>(image.half_width[p]);
      judged.sure += image.converged[p];
      judged.wrong_and_sure += image.converged[p] && off > 0.03 * truth;
      judged.worst = std::max(judged.worst, off / truth);
      judged.mean += value / truth;
      judged.samples += static_cast<double>(image.samples[p]);
    }
    judged.count += across * across;
  }
  judged.mean /= judged.count;
  judged.samples /= judged.count;
  return judged;
}

}  // namespace ifov::studies
