#include "studies/atmosphere/rendered_checks.h"

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/channel_light.h"
#include "core/format.h"
#include "radiometry/solar_spectrum.h"
#include "studies/common/study_document.h"

namespace ifov::studies {
namespace {

/// `center` and `fwhm` in micrometres.
struct Band {
  double center_um, fwhm_um;
};
constexpr Band kThermal[] = {{4.3, 0.1}, {6.3, 0.3}, {10.0, 0.5}, {13.5, 0.5}};
constexpr Band kSolar[] = {{0.865, 0.02}, {0.94, 0.02}, {1.38, 0.02}};
constexpr double kReflectance = 0.3, kSunZenith_deg = 40.0;

std::string channels_text(std::span<const Band> bands) {
  std::string text;
  for (const Band& band : bands)
    text += format("{}{{\"gaussian\": {{\"center\": \"{} um\", \"fwhm\": \"{} um\"}}}}",
                   text.empty() ? "" : ", ", band.center_um, band.fwhm_um);
  return "[" + text + "]";
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
  std::string levels;
  for (const double z : {0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 99.9})
    levels += format(
        "{}{{\"altitude\": \"{} km\", \"pressure\": \"{:.5g} hPa\", \"temperature\": \"{} K\", "
        "\"mixing_ratio\": \"{:.5g} g/kg\"}}",
        levels.empty() ? "" : ", ", z, 1013.0 * std::exp(-z / 8.0), air_k, 8.0 * std::exp(-z / 2.0));
  const std::string text = format(
      "{{\"ifov\": 1, \"seed\": {}, \"scene\": {{\"materials\": {{\"floor\": {{\"emissivity\": 0.6, "
      "\"temperature\": \"300 "
      "K\"}}, \"wall\": {{\"emissivity\": 0.8, \"temperature\": \"300 K\"}}}}, \"objects\": [{{\"plane\": "
      "{{}}, "
      "\"material\": \"floor\"}}, {{\"box\": {{\"low\": [\"-50 m\", \"-50 m\", \"-1 m\"], \"high\": [\"50 "
      "m\", \"50 m\", "
      "\"60 m\"]}}, \"material\": \"wall\"}}]}}, \"atmosphere\": {{\"profile\": \"mid-latitude summer\", "
      "\"levels\": [{}], "
      "\"aerosol\": {{\"type\": \"none\"}}}}, \"sensor\": {{\"camera\": {{\"frame\": {{\"focal_length\": "
      "\"20 mm\", "
      "\"pitch\": \"0.25 mm\", \"pixels\": [32, 32], \"position\": [\"0 m\", \"0 m\", \"50 m\"], "
      "\"look_at\": [\"5 m\", "
      "\"0 m\", \"0 m\"]}}}}, \"channels\": {}}}, \"sampling\": {{\"grid\": {{\"elements\": [4, 4]}}}}}}",
      options.seed, levels, channels_text(kThermal));
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(text, options.output_folder, choices, image);
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
  const std::string text = format(
      "{{\"ifov\": 1, \"seed\": {0}, \"scene\": {{\"materials\": {{\"plain\": {{\"reflectance\": {1}}}}}, "
      "\"objects\": "
      "[{{\"plane\": {{}}, \"material\": \"plain\"}}]}}, \"light\": {{\"sun\": {{\"disc\": {{\"zenith\": "
      "\"{2} deg\", "
      "\"azimuth\": \"150 deg\"}}}}, \"surroundings\": {{\"reflectance\": {1}}}}}, \"atmosphere\": "
      "{{\"profile\": "
      "\"mid-latitude summer\"}}, \"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"1 m\", "
      "\"pixels\": [100, 100], "
      "\"center\": [\"0 m\", \"0 m\"]}}}}, \"channels\": {3}}}, \"sampling\": {{\"single\": {{}}}}}}",
      options.seed, kReflectance, kSunZenith_deg, channels_text(kSolar));
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(text, options.output_folder, choices, image);

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
