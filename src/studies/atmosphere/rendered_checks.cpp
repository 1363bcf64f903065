#include "studies/atmosphere/rendered_checks.h"

#include <cmath>
#include <numbers>
#include <string>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/channel_light.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "core/format.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/document.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "math/angle.h"
#include "radiometry/solar_spectrum.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {
namespace {

/// `center` and `fwhm` in micrometres.
struct Band {
  double center_um, fwhm_um;
};
constexpr Band kThermal[] = {{4.3, 0.1}, {6.3, 0.3}, {10.0, 0.5}, {13.5, 0.5}};
constexpr Band kSolar[] = {{0.865, 0.02}, {0.94, 0.02}, {1.38, 0.02}};
constexpr double kReflectance = 0.3, kSunZenith_deg = 40.0;

io::Document document_of(const io::CameraDocument& camera, std::span<const Band> bands, std::uint64_t seed) {
  io::Document document;
  document.seed = seed;
  document.sensor.camera = camera;
  for (const Band& band : bands)
    document.sensor.channels.push_back(
        {format("{:g}", band.center_um), io::GaussianChannel{band.center_um, band.fwhm_um}, {}, {}, {}});
  document.atmosphere.modelled.emplace();
  return document;
}

struct Moments {
  double mean = 0.0, deviation = 0.0;
};

Moments moments_of(const ImageStore& image, std::size_t channel) {
  const std::size_t columns = static_cast<std::size_t>(image.columns()),
                    pixels = image.mean().size() / columns;
  double sum = 0.0, squares = 0.0;
  for (std::size_t p = 0; p < pixels; ++p) {
    const double value = image.mean()[p * columns + channel];
    sum += value;
    squares += value * value;
  }
  const double mean = sum / static_cast<double>(pixels);
  return {mean, std::sqrt(std::max(0.0, squares / static_cast<double>(pixels) - mean * mean))};
}

}  // namespace

std::vector<EnclosureChannel> render_enclosure(const StudyOptions& options, double air_k) {
  const auto five_digits = [](double value) { return std::stod(format("{:.5g}", value)); };
  io::FrameCamera camera;
  camera.focal_length_m = 0.02;
  camera.pitch_m = 0.25e-3;
  camera.size = {32, 32};
  camera.position_m = {0.0, 0.0, 50.0};
  camera.orientation = io::LookAt{{5.0, 0.0, 0.0}, {}};
  io::Document document = document_of(
      {std::string(io::FrameCamera::kModel.key), std::make_shared<const io::FrameCamera>(camera), {}},
      kThermal, options.seed);
  io::MaterialDocument floor = black("floor", {300.0, {}}), wall = black("wall", {300.0, {}});
  floor.spectrum.source = io::ConstantSpectrum{0.6};
  wall.spectrum.source = io::ConstantSpectrum{0.8};
  document.scene.materials = {floor, wall};
  io::BoxPrimitive box;
  box.low_m = {-50.0, -50.0, -1.0};
  box.high_m = {50.0, 50.0, 60.0};
  document.scene.objects = {object_of(io::PlanePrimitive(), "floor"), object_of(box, "wall")};
  auto& air = document.atmosphere.modelled->description;
  air.aerosol.type = "none";
  for (const double z_km : {0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 99.9}) {
    atmosphere::UserLevel level;
    level.altitude_km = z_km;
    level.pressure_hPa = five_digits(1013.0 * std::exp(-z_km / 8.0));
    level.temperature_K = air_k;
    level.mixing_ratio_g_kg = five_digits(8.0 * std::exp(-z_km / 2.0));
    air.air.levels.push_back(level);
  }
  document.sampling = grid_sampling(4);
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(study_text(document), options.output_folder, choices, image);
  std::vector<EnclosureChannel> result;
  for (std::size_t c = 0; c < std::size(kThermal); ++c) {
    const Moments found = moments_of(image, c);
    const auto channel = radiometry::Channel::gaussian("", kThermal[c].center_um, kThermal[c].fwhm_um);
    const double pixels = static_cast<double>(image.width()) * image.height();
    result.push_back({kThermal[c].center_um, found.mean, found.deviation / std::sqrt(pixels),
                      radiometry::channel_planck_w_m2_sr_um(channel, 300.0)});
    // What the band model's steps of 5 cm-1 leave of Planck's law.
    result.back().standard_error = std::max(result.back().standard_error, 1e-4 * result.back().planck);
  }
  return result;
}

std::vector<PlainChannel> render_plain(const StudyOptions& options) {
  io::Document document = document_of(nadir_camera(100, 100, -50.0, 50.0), kSolar, options.seed);
  document.scene.materials = {grey("plain", kReflectance)};
  document.scene.objects = {object_of(io::PlanePrimitive(), "plain")};
  document.light.sun.emplace().direction =
      io::CelestialDirection{kSunZenith_deg * math::kDegree, 150.0 * math::kDegree};
  document.light.sun->diameter_rad = 0.53 * math::kDegree;
  document.light.surroundings.emplace().spectrum.source = io::ConstantSpectrum{kReflectance};
  document.sampling = single_sampling();
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(study_text(document), options.output_folder, choices, image);

  const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
  std::vector<radiometry::Channel> channels;
  for (const Band& band : kSolar)
    channels.push_back(radiometry::Channel::gaussian("", band.center_um, band.fwhm_um));
  atmosphere::ScatteringOptions rough;
  rough.nodes_per_hemisphere = 4;
  rough.polarized = false;
  std::vector<PlainChannel> result;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Moments found = moments_of(image, c);
    atmosphere::SensorGeometry geometry;
    geometry.sun_zenith_rad = kSunZenith_deg * std::numbers::pi / 180.0;
    const auto parts = atmosphere::solve_all_terms(column, channels[c], radiometry::solar_irradiance_1au(),
                                                   geometry, rough, options.threads);
    double mean = 0.0, square = 0.0;
    for (atmosphere::ChannelLight part : parts) {
      const double weight = part.weight, reflectance[] = {kReflectance};
      part.weight = 1.0;
      const double radiance = atmosphere::lambertian_radiance({&part, 1}, geometry, reflectance);
      mean += weight * radiance;
      square += weight * radiance * radiance;
    }
    result.push_back({kSolar[c].center_um, found.deviation / found.mean,
                      std::sqrt(std::max(0.0, square / (mean * mean) - 1.0))});
  }
  return result;
}

}  // namespace ifov::studies
