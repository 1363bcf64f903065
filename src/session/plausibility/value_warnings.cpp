#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/document/document.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "sensor/detector/detector.h"
#include "session/assembly/shared/with_position.h"
#include "session/loaded/parts.h"
#include "session/plausibility/plausibility_warnings.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

constexpr double kWarm_um = 3.0;
constexpr double kNothing =
    1e-15;  // W m-2 um-1 and W m-2 sr-1 um-1: what warm ground emits in the visible is less

std::string named(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 4;
  std::string text;
  for (std::size_t k = 0; k < std::min(kNamed, names.size()); ++k)
    text += format("{}'{}'", k == 0 ? "" : ", ", names[k]);
  if (names.size() > kNamed) text += format(" and {} more", names.size() - kNamed);
  return text;
}

/// Channels of which something holds.
template <class Is>
std::vector<std::string> channels_that(const Parts& parts, Is is) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < parts.channels.size(); ++c)
    if (is(c)) names.push_back(parts.channels[c].name);
  return names;
}

bool dark(const Parts& parts, const SceneSurvey& survey, std::size_t c) {
  const std::vector<double> path = parts.spectral_scene->path_radiance();
  return !(survey.sun[c].high > kNothing) && !(survey.sky[c].high > kNothing) &&
         !(survey.radiance[c].high > kNothing) && !(path[c] > kNothing) &&
         !(parts.spectral_scene->white_reflected()[c] > kNothing);
}

void warn_of_dark_channels(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  const std::vector<std::string> names =
      channels_that(parts, [&](std::size_t c) { return dark(parts, survey, c); });
  if (!names.empty())
    log.warn(format(
        "nothing shines in {}: neither Sun nor sky has light there, and nothing that is seen emits; the radiance will be 0",
        named(names)));
}

void warn_of_hot_sky(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  constexpr double kHot_k = 325.0, kPi = 3.14159265358979323846;
  if (!parts.scene.sky.radiance || parts.atmosphere) return;
  double hottest_k = 0.0;
  const std::vector<std::string> names = channels_that(parts, [&](std::size_t c) {
    if (parts.channels[c].centre_um < kWarm_um) return false;
    const double sky_k = parts.brightness->temperature_k(static_cast<int>(c), survey.sky[c].high / kPi);
    hottest_k = std::max(hottest_k, sky_k);
    return sky_k > kHot_k;
  });
  if (!names.empty())
    log.warn(format(
        "the sky is as bright as a black body of {:.0f} K in {}: a radiance that suits daylight is none of a "
        "thermal sky. Give the sky a 'temperature', a spectrum, or an atmosphere",
        hottest_k, named(names)));
}

void warn_of_temperatures(const Parts& parts, LogSink& log) {
  constexpr double kCold_k = 150.0;
  const auto check = [&](const std::optional<io::TemperatureDocument>& source, const std::string& of) {
    const double* fixed_k = source ? std::get_if<double>(&source->value) : nullptr;
    if (fixed_k == nullptr || !(*fixed_k > 0.0) || *fixed_k >= kCold_k) return;
    log.warn(format("line {}: the temperature of {} is {:g} K, which is {:.0f} degC: is \"{:g} degC\" meant?",
                    source->position.line, of, *fixed_k, *fixed_k - 273.15, *fixed_k));
  };
  for (const io::MaterialDocument& material : parts.document.scene.materials)
    check(material.temperature, format("the material '{}'", material.name));
  for (std::size_t d = 0; d < parts.document.scene.objects.size(); ++d)
    check(parts.document.scene.objects[d].temperature, title_of(parts.document.scene.objects, d));
  if (const auto mapped = parts.scene.mapped_temperatures(); mapped && mapped->hottest_k < kCold_k)
    log.warn(format(
        "the temperature maps hold {:g} to {:g} K: are their numbers degC? Then say \"unit\": \"degC\"",
        mapped->coldest_k, mapped->hottest_k));
}

void warn_of_wavelengths(const Parts& parts, LogSink& log) {
  constexpr double kLongest_um = 100.0, kShortest_um = 0.2;
  const auto at = [&](std::size_t c) { return parts.channels[c].centre_um; };
  const std::vector<std::string> far =
      channels_that(parts, [&](std::size_t c) { return at(c) > kLongest_um; });
  if (!far.empty())
    log.warn(format("the wavelengths of {} are above {:g} um: are they nm?", named(far), kLongest_um));
  const std::vector<std::string> near =
      channels_that(parts, [&](std::size_t c) { return at(c) < kShortest_um; });
  if (!near.empty())
    log.warn(format("the wavelengths of {} are below {:g} um: are they um?", named(near), kShortest_um));
}

/// Models of scattering whose theory holds to some wavelength alone.
void warn_of_models(const Parts& parts, LogSink& log) {
  for (const materials::Material& material : parts.scene.materials) {
    const double last_um = materials::holds_to_um(material);
    const std::vector<std::string> names =
        channels_that(parts, [&](std::size_t c) { return parts.channels[c].centre_um > last_um; });
    if (!names.empty() && !material.curve_of)
      log.warn(format(
          "material '{}': the theory of its scattering holds to {:.2f} um; in {} it is only about right",
          material.name, last_um, named(names)));
  }
}

void warn_of_kelvins(const Parts& parts, LogSink& log) {
  if (!parts.plan.request || parts.plan.request->unit != render::ErrorUnit::kelvin || !parts.tolerance)
    return;
  const std::vector<std::string> names = channels_that(parts, [&](std::size_t c) {
    return parts.tolerance->judged(static_cast<int>(c)) && parts.channels[c].centre_um < kWarm_um;
  });
  if (!names.empty())
    log.warn(format(
        "an accuracy of {:g} K is asked of {}, where surfaces reflect and a brightness temperature says little: "
        "give the error in %, or judge a thermal channel ('channel')",
        parts.plan.request->error, named(names)));
}

/// Detectors that are full of the darkest that is seen, or count nothing of the brightest.
void warn_of_detectors(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  for (std::size_t c = 0; c < parts.channels.size(); ++c) {
    const sensor::Detector* const detector = parts.info.channels[parts.told_channel(c)].detector.get();
    if (detector == nullptr || !detector->exists()) continue;
    const double least = detector->mean_electrons(survey.radiance[c].low),
                 most = detector->mean_electrons(survey.radiance[c].high), holds = detector->largest_signal();
    const std::string& name = parts.channels[c].name;
    if (least > holds)
      log.warn(format(
          "the detector of '{}' is full wherever it looks: the darkest that is seen makes {:.3g} electrons, and it tells at most "
          "{:.3g}. Give it a shorter 'integration_time', a larger 'full_well' or 'gain', or the optics less light",
          name, least, holds));
    else if (detector->digitises() && most < 0.5 * detector->gain)
      log.warn(format(
          "the detector of '{}' counts nothing: the brightest that is seen makes {:.3g} electrons, and a count is {:.3g} of them. "
          "Give it a longer 'integration_time', a smaller 'gain', or the optics more light",
          name, most, detector->gain));
  }
}

/// Gases that no air on Earth holds so much, or so little, of. None at all is meant.
void warn_of_air(const Parts& parts, LogSink& log) {
  if (!parts.document.atmosphere.modelled) return;
  const atmosphere::ProfileDescription& air = parts.document.atmosphere.modelled->description.air;
  const auto check = [&](const char* name, const std::optional<double>& value, double low, double high,
                         const char* unit, const char* usual) {
    if (value && *value > 0.0 && (*value < low || *value > high))
      log.warn(format(
          "the atmosphere's '{}' of {:g} {} is none that air on Earth has, which is {}: is its unit another?",
          name, *value, unit, usual));
  };
  check("ozone", air.ozone_DU, 50.0, 700.0, "DU", "200 to 500 DU (0.2 to 0.5 atm-cm)");
  check("water_vapour", air.water_vapour_g_cm2, 1e-3, 12.0, "g/cm2", "0.05 to 7 g/cm2");
  check("co2", air.co2_ppm, 100.0, 3000.0, "ppm", "about 420 ppm");
  check("ch4", air.ch4_ppm, 0.2, 20.0, "ppm", "about 1.9 ppm");
  check("n2o", air.n2o_ppm, 0.03, 3.0, "ppm", "about 0.335 ppm");
}

}  // namespace

void require_light(const Parts& parts, const SceneSurvey& survey) {
  const io::LightDocument& light = parts.document.light;
  // Who writes "sky": {"none": {}} means a dark scene.
  if (light.sky_position.line > 0) return;
  for (std::size_t c = 0; c < parts.channels.size(); ++c)
    if (!dark(parts, survey, c)) return;
  throw io::document_error(
      parts.document.sources, light.position.line > 0 ? light.position : parts.document.sensor.position,
      "nothing shines: no Sun above the horizon, no sky, and nothing that is seen has a temperature in these channels. Give "
      "'light' a 'sun' and a 'sky', the document an 'atmosphere', or materials a 'temperature'");
}

void warn_of_values(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  warn_of_dark_channels(parts, survey, log);
  warn_of_hot_sky(parts, survey, log);
  warn_of_temperatures(parts, log);
  warn_of_wavelengths(parts, log);
  warn_of_kelvins(parts, log);
  warn_of_models(parts, log);
  warn_of_air(parts, log);
  warn_of_detectors(parts, survey, log);
}

}  // namespace ifov::session
