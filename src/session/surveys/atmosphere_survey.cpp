#include "session/surveys/atmosphere_survey.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/survey/survey_effects.h"
#include "core/names.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/document.h"
#include "scene/scene.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "session/assembly/atmosphere/gas_model_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/surveys/atmosphere_statement.h"
#include "session/surveys/survey_ground.h"
#include "session/surveys/survey_stage.h"

namespace ifov::session {
namespace {

constexpr double kSkyByDay_um = 0.45, kSkyByNight_um = 10.0;
/// Shortest wavelength at which a sky is shown as a temperature.
constexpr double kThermalSky_um = 4.0;
/// A spectrum reaches this share beyond the sensor's channels.
constexpr double kMargin = 0.04;

/// The document as the question wants it.
io::Document asked(const io::Document& document, const AtmosphereQuestion& question) {
  io::Document changed = document;
  if (question.night) changed.light.sun.reset();
  if (question.sun) {
    if (!changed.light.sun) changed.light.sun.emplace();
    changed.light.sun->direction = {question.sun->zenith_rad, question.sun->azimuth_rad};
  }
  if (question.view) {
    auto& camera = changed.sensor.camera.settings;
    camera = camera->seen_from(question.view->zenith_rad, question.view->azimuth_rad);
  }
  if (!question.gas_model.empty())
    changed.atmosphere.modelled->gas_model = {question.gas_model.string(), changed.atmosphere.position};
  if (question.sensor_altitude_km)
    changed.atmosphere.modelled->sensor_altitude_km = question.sensor_altitude_km;
  return changed;
}

/// Where the response is above half of its maximum.
std::pair<double, double> half_width(const radiometry::Channel& channel) {
  if (channel.is_monochromatic()) return {channel.centre_um, channel.centre_um};
  const auto wavelength = channel.response.wavelength_um();
  const auto response = channel.response.values();
  const double half = 0.5 * channel.response.maximum();
  std::size_t first = 0, last = wavelength.size() - 1;
  while (response[first] < half) ++first;
  while (response[last] < half) --last;
  return {wavelength[first], wavelength[last]};
}

/// Tells how far the survey has come, and ends it when asked to.
class Meter {
 public:
  Meter(const AtmosphereQuestion& question, std::size_t total) : question_(question), total_(total) {}
  std::function<void(std::size_t)> from(std::size_t before) {
    return [this, before](std::size_t done) {
      if (question_.cancel != nullptr && question_.cancel->cancelled()) throw Cancelled();
      if (question_.progress == nullptr) return;
      Progress progress;
      progress.pixels_done = static_cast<std::int64_t>(before + done);
      progress.pixels_total = static_cast<std::int64_t>(total_);
      progress.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
      question_.progress->report(progress);
    };
  }

 private:
  const AtmosphereQuestion& question_;
  std::size_t total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::size_t sky_channel(const std::vector<radiometry::Channel>& channels, const std::string& name,
                        bool night) {
  std::vector<std::string> names;
  for (const radiometry::Channel& channel : channels) names.push_back(channel.name);
  if (!name.empty()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw InputError(format("the sensor has no channel '{}'{} Channels: {}", name,
                              did_you_mean(name, names).empty() ? "." : did_you_mean(name, names),
                              list_names(names, "and", 12)));
    return static_cast<std::size_t>(found - names.begin());
  }
  const double wanted = night ? kSkyByNight_um : kSkyByDay_um;
  std::size_t best = 0;
  for (std::size_t c = 1; c < channels.size(); ++c)
    if (std::abs(std::log(channels[c].centre_um / wanted)) <
        std::abs(std::log(channels[best].centre_um / wanted)))
      best = c;
  return best;
}

bool has_smile(const io::SensorDocument& sensor) {
  return sensor.smile || std::ranges::any_of(sensor.channels, [](const io::ChannelDocument& channel) {
           return channel.smile != nullptr;
         });
}

}  // namespace

io::AtmosphereReport survey_atmosphere(const io::Document& original, const AtmosphereQuestion& question) {
  if (!original.atmosphere.modelled)
    throw io::document_error(original.sources, original.atmosphere.position,
                             "there is no modelled atmosphere to look at: 'atmosphere' has no 'profile'");
  if (!(question.ground_reflectance >= 0.0 && question.ground_reflectance <= 1.0))
    throw InputError(
        format("a ground of reflectance {:g} was asked for; expected 0 to 1", question.ground_reflectance));
  const io::Document document = asked(original, question);
  const SurveyStage stage(document);
  const SurveyGround ground =
      survey_ground(document, question.ground_material, question.ground_reflectance, stage);
  return with_position(document.sources, document.atmosphere.position, [&] {
    check_channels(document.sources, document.sensor.channels, stage.channels);
    const atmosphere::AtmosphereColumn column =
        assemble_column(document.sources, *document.atmosphere.modelled, document.scene.origin);
    check_gas_model(document.sources, *document.atmosphere.modelled, document.sensor.channels, stage.channels,
                    column.gas_terms());
    io::AtmosphereReport report;
    report.geometry = sensor_geometry(document.sources, *document.atmosphere.modelled, document.sensor.camera,
                                      *stage.camera, stage.scene.sun, column.levels().altitude_km.front());
    if (stage.scene.sun) {
      if (stage.scene.sun->is_moon) report.body = "Moon";
      report.sun_azimuth_rad = stage.scene.sun->azimuth_rad();
    }
    report.description = atmosphere_statement(column, report.geometry, stage.scene,
                                              *document.atmosphere.modelled, stage.channels);
    const radiometry::Spectrum sunlight =
        stage.scene.sun ? stage.scene.sun->irradiance : radiometry::Spectrum();

    double first_um = kLongest_um, last_um = kShortest_um;
    for (std::size_t c = 0; c < stage.channels.size(); ++c) {
      const auto [from, to] = half_width(stage.channels[c]);
      report.channels.push_back({stage.channels[c].name, from, to, {}});
      first_um = std::min(first_um, from * (1.0 - kMargin));
      last_um = std::max(last_um, to * (1.0 + kMargin));
    }
    if (question.log != nullptr) {
      warn_of_column(*document.atmosphere.modelled, column, *question.log);
      const std::string narrow = narrow_channels(stage.channels, column.gas_terms());
      if (!narrow.empty()) question.log->warn(narrow);
      if (has_smile(document.sensor))
        question.log->warn(
            "the sensor has a smile: what is told is of its channels' own responses, not of single columns' (`ifov "
            "sensor` tells how far these are from them)");
    }
    std::optional<std::size_t> shown;
    if (question.sky)
      shown = sky_channel(stage.channels, question.sky_channel, !report.geometry.sun_zenith_rad);
    std::vector<radiometry::Channel> steps;
    if (question.spectrum)
      steps = atmosphere::resolved_steps(std::max(first_um, kShortest_um), std::min(last_um, kLongest_um),
                                         terms_of_all(column.gas_terms(), stage.channels));
    Meter meter(question, stage.channels.size() + steps.size());
    atmosphere::SurveyControl control;
    control.threads = question.threads;
    control.ground = ground.reflectance;
    control.directional = ground.directional;
    report.ground = ground.description;
    if (!ground.left_out.empty()) report.description.push_back(ground.left_out);
    control.progress = meter.from(0);
    const std::vector<atmosphere::AtmosphereEffects> light =
        atmosphere::survey_effects(column, stage.channels, sunlight, report.geometry, control);
    for (std::size_t c = 0; c < light.size(); ++c) report.channels[c].light = light[c];
    if (!steps.empty()) {
      control.most_nodes = 1;
      control.progress = meter.from(stage.channels.size());
      report.spectrum = atmosphere::survey_effects(column, steps, sunlight, report.geometry, control);
      report.step_cm1 = 1e4 / steps.front().response.first_um() - 1e4 / steps.front().response.last_um();
    }
    if (shown) {
      const std::size_t c = *shown;
      report.sky_channel = stage.channels[c].name;
      report.sky = atmosphere::view_sky(column, stage.channels[c].centre_um, light[c].solar_irradiance,
                                        report.geometry.sun_zenith_rad, question.threads);
      report.sky_is_thermal = stage.channels[c].centre_um > kThermalSky_um || !report.geometry.sun_zenith_rad;
      if (!report.sky_is_thermal)
        report.neutral_points = atmosphere::neutral_points(*report.sky, *report.geometry.sun_zenith_rad);
    }
    return report;
  });
}

}  // namespace ifov::session
