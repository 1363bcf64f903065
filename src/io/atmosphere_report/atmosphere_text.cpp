#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/imported_path.h"
#include "core/format.h"
#include "io/atmosphere/path_csv.h"
#include "io/atmosphere_report/atmosphere_report.h"
#include "radiometry/planck.h"

namespace ifov::io {
namespace {

constexpr std::size_t kLongestName = 24;
constexpr double kFirstSkyTemperature_um = 3.0;

/// Three or four digits, and 0 as such.
std::string figure(double value) {
  if (value <= 0.0) return "0";
  return value >= 99.95   ? format("{:.1f}", value)
         : value >= 0.001 ? format("{:.4g}", value)
                          : format("{:.2e}", value);
}

/// The same of what may be less than 0.
std::string signed_figure(double value) { return value < 0.0 ? "-" + figure(-value) : figure(value); }

std::string fitted(const std::string& name) {
  return name.size() <= kLongestName ? name : name.substr(0, kLongestName - 3) + "...";
}

/// What correction codes ask for: path reflectance, sunlight down and light of the ground up, straight and scattered, and S.
std::string correction_text(const AtmosphereReport& report, std::size_t widest) {
  const double cosine = report.geometry.sun_sine();
  if (!(cosine > 0.0)) return {};
  std::string text = format(
      "\n{:<{}}  {:>9}  {:>13}  {:>13}  {:>6}\n{:<{}}  {:>9}  {:>6} {:>6}  {:>6} {:>6}  {:>6}\n", "", widest,
      "path", "down", "up", "", "channel", widest, "reflect.", "all", "scatt.", "all", "scatt.", "S");
  for (const AtmosphereReport::Channel& channel : report.channels) {
    const atmosphere::AtmosphereEffects& of = channel.light;
    const double above = of.solar_irradiance * cosine;
    if (!(above > 0.0)) continue;
    text += format("{:<{}}  {:>9.5f}  {:>6.4f} {:>6.4f}  {:>6.4f} {:>6.4f}  {:>6.4f}\n", fitted(channel.name),
                   widest, std::numbers::pi * of.solar_path / above,
                   (of.direct_irradiance + of.solar_sky) / above, of.solar_sky / above,
                   of.view_transmittance + of.diffuse_transmittance, of.diffuse_transmittance,
                   of.spherical_albedo);
  }
  return text;
}

/// Light of level surfaces, and what the sensor receives.
std::string flux_text(const AtmosphereReport& report, std::size_t widest) {
  const bool day = report.geometry.sun_zenith_rad.has_value();
  std::string text = format("\nOver ground {}:\n{:<{}}  {:^17}  {:^26}  {:^26}\n", report.ground, "", widest,
                            "at the ground", "through the sensor's level", "at the sensor");
  text += format("{:<{}}  {:>8} {:>8}  {:>8} {:>8} {:>8}  {:>8} {:>8} {:>8}\n", "channel", widest, "diffuse",
                 "up", "direct", "diffuse", "up", "radiance", "Q", "U");
  for (const AtmosphereReport::Channel& channel : report.channels) {
    const atmosphere::AtmosphereEffects::OverGround& of = channel.light.over_ground;
    text += format("{:<{}}  {:>8} {:>8}  {:>8} {:>8} {:>8}  {:>8} {:>8} {:>8}\n", fitted(channel.name),
                   widest, figure(of.ground_diffuse), figure(of.ground_up),
                   day ? figure(of.sensor_direct) : "-", figure(of.sensor_diffuse), figure(of.sensor_up),
                   figure(of.radiance), day ? signed_figure(of.q) : "-", day ? signed_figure(of.u) : "-");
  }
  return text;
}

}  // namespace

std::string atmosphere_report_text(const AtmosphereReport& report) {
  std::size_t widest = 7;
  for (const AtmosphereReport::Channel& channel : report.channels)
    widest = std::max(widest, fitted(channel.name).size());
  const bool day = report.geometry.sun_zenith_rad.has_value();
  std::string text;
  for (const std::string& line : report.description) text += line + "\n";
  text += format("\n{:<{}}  {:>7}  {:^15}  {:^17}     irradiance\n", "", widest, "", "transmittance",
                 "path radiance");
  text += format("{:<{}}  {:>7}  {:>7} {:>7}  {:>8} {:>8}  {:>8} {:>8}  {:>6}  {:>5}\n", "channel", widest,
                 "um", report.body, "sensor", "solar", "thermal", "direct", "diffuse", "albedo", "sky K");
  for (const AtmosphereReport::Channel& channel : report.channels) {
    const atmosphere::AtmosphereEffects& of = channel.light;
    const double sky = of.solar_sky + of.thermal_sky;
    const std::string kelvin =
        of.wavelength_um >= kFirstSkyTemperature_um && sky > 0.0
            ? format("{:.1f}", radiometry::brightness_temperature_k(of.wavelength_um, sky / std::numbers::pi))
            : "-";
    text += format(
        "{:<{}}  {:>7.4g}  {:>7} {:>7.4f}  {:>8} {:>8}  {:>8} {:>8}  {:>6}  {:>5}\n", fitted(channel.name),
        widest, of.wavelength_um, day ? format("{:.4f}", of.sun_transmittance) : "-", of.view_transmittance,
        day ? figure(of.solar_path) : "-", figure(of.thermal_path), day ? figure(of.direct_irradiance) : "-",
        figure(sky), of.spherical_albedo > 0.0 ? format("{:.4f}", of.spherical_albedo) : "-", kelvin);
  }
  text += correction_text(report, widest);
  text += flux_text(report, widest);
  if (!report.neutral_points.empty()) {
    text +=
        format("\nThe sky at {:.4g} um ({}) is unpolarized", report.sky->wavelength_um, report.sky_channel);
    for (std::size_t k = 0; k < report.neutral_points.size(); ++k) {
      const atmosphere::NeutralPoint& point = report.neutral_points[k];
      text +=
          format("{} {:.0f} deg {} ({})", k == 0 ? "" : ",", point.distance_rad * 180.0 / std::numbers::pi,
                 point.name == "Brewster"  ? "below the " + report.body
                 : point.name == "Babinet" ? "above the " + report.body
                                           : "above the point opposite",
                 point.name);
    }
    text += ".\n";
  }
  return text +
         "\nOver black ground, but where another is named. Direct transmittances; radiances in W m-2 sr-1 um-1,\n"
         "irradiances of levels in W m-2 um-1; albedo and S: of the air for light from below; sky K: temperature of a\n"
         "black sky as bright; down, up: shares of sunlight that reach the ground, of uniform ground's light that reach\n"
         "the sensor; Q, U: of light about the vertical plane of the line of sight (north where it is upright), as the\n"
         "sensor sees it. Ground emits nothing here.\n";
}

std::string atmosphere_report_csv(const AtmosphereReport& report) {
  using atmosphere::PathQuantity;
  std::vector<double> wavelength_um;
  for (const atmosphere::AtmosphereEffects& step : report.spectrum)
    wavelength_um.push_back(step.wavelength_um);
  atmosphere::ImportedPath path("spectrum", std::move(wavelength_um));
  const auto set = [&](PathQuantity quantity, auto value) {
    std::vector<double> values;
    for (const atmosphere::AtmosphereEffects& step : report.spectrum) values.push_back(value(step));
    path.set(quantity, std::move(values));
  };
  using Light = atmosphere::AtmosphereEffects;
  set(PathQuantity::ground_sensor_transmittance, [](const Light& l) { return l.view_transmittance; });
  set(PathQuantity::thermal_path_radiance, [](const Light& l) { return l.thermal_path; });
  set(PathQuantity::diffuse_irradiance, [](const Light& l) { return l.solar_sky + l.thermal_sky; });
  if (report.geometry.sun_zenith_rad) {
    set(PathQuantity::direct_sun_ground_transmittance, [](const Light& l) { return l.sun_transmittance; });
    set(PathQuantity::diffuse_ground_sensor_transmittance,
        [](const Light& l) { return l.diffuse_transmittance; });
    set(PathQuantity::solar_path_radiance, [](const Light& l) { return l.solar_path; });
    set(PathQuantity::direct_irradiance, [](const Light& l) { return l.direct_irradiance; });
    set(PathQuantity::solar_irradiance, [](const Light& l) { return l.solar_irradiance; });
    set(PathQuantity::spherical_albedo, [](const Light& l) { return l.spherical_albedo; });
  }
  std::string text;
  for (const std::string& line : report.description) text += "# " + line + "\n";
  text += format("# means over {:g} cm-1, over black ground\n", report.step_cm1);
  return text + path_csv(path);
}

}  // namespace ifov::io
