#include "session/messages.h"

#include <algorithm>
#include <variant>

#include "geometry/world.h"
#include "io/document/document.h"
#include "io/run_state/run_plan.h"
#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "session/assembly/atmosphere/aerosol_assembly.h"
#include "session/assembly/atmosphere/cloud_assembly.h"
#include "session/assembly/atmosphere/weather_assembly.h"
#include "session/assembly/shared/map_scale.h"
#include "session/atmosphere_messages.h"
#include "session/image_errors.h"
#include "session/loaded/parts.h"
#include "session/plausibility/light_warnings.h"
#include "session/surface_spectra.h"

namespace ifov::session {

std::string describe(const Parts& parts) {
  std::string text =
      format("scene: {} objects, {} triangles, {} materials\n", parts.scene.world->object_count(),
             parts.scene.world->triangle_count(), parts.document.scene.materials.size());
  const bool sky = parts.has_sky();
  const char* const body = !parts.scene.sun ? "no sun" : parts.scene.sun->is_moon ? "moon" : "sun";
  text += format("light: {}, {}\n", body, sky ? "sky" : "no sky");
  if (parts.atmosphere)
    text +=
        format("atmosphere: {} ('ifov atmosphere {}' shows it)\n",
               parts.document.atmosphere.modelled->description.air.model, parts.document.sources.file_name);
  if (parts.imported) text += "atmosphere: imported runs\n";
  if (parts.weather) text += weather_statement(parts.document.time, *parts.weather) + "\n";
  text += format("sensor: {} x {} pixels, {} channels ({} spectral nodes)\n", parts.info.width_px,
                 parts.info.height_px, parts.told_channels.size(), parts.nodes->node_count());
  text += format("sampling: {}\n",
                 parts.plan.accuracy_asked.empty() ? parts.plan.method : parts.plan.accuracy_asked);
  for (const std::string& line : parts.locations) text += line + "\n";
  for (const std::string& note : notes(parts)) text += note + "\n";
  return text;
}

std::string sensor_statement(const Parts& parts) {
  return format("sensor: {} x {} pixels, {} channels in {} spectral nodes", parts.info.width_px,
                parts.info.height_px, parts.told_channels.size(), parts.nodes->node_count());
}

namespace {

std::string reached_statement(const io::RunPlan& plan, const Progress& totals,
                              const sampling::ReasonCounts& reasons, const std::string& why_gaps,
                              const std::vector<io::ImageError>& errors) {
  std::string text;
  if (totals.pixels_done < totals.pixels_total)
    text = format("{} of {} pixels hold no value (NaN), because {}. ",
                  totals.pixels_total - totals.pixels_done, totals.pixels_total, why_gaps);
  const std::string of_image = image_error_statement(errors, plan.image);
  if (!plan.judged)
    return text +
           format("No accuracy was asked for ({}); {}.{}", plan.identity.sampler,
                  plan.knows_errors ? "half-widths are at 95 %" : "the method says nothing of its error",
                  of_image.empty() ? "" : " " + of_image);
  const std::int64_t missed = totals.pixels_done - totals.pixels_converged;
  text += format("Asked for {}. ", plan.identity.accuracy_asked);
  if (totals.pixels_done == 0) return text + "No pixel is done.";
  if (plan.image_wide) {
    text += of_image.empty() ? "What was reached is told when all tiles are there." : of_image;
    if (missed > 0)
      text += format(" Of {} of {} pixels something else is to be said: {}.", missed, totals.pixels_done,
                     sampling::describe_reasons(reasons));
    return text;
  }
  if (missed == 0)
    text +=
        format("Reached in all {} pixels{}; the widest interval is {:.2f} of its limit.", totals.pixels_done,
               totals.pixels_done < totals.pixels_total ? " that are done" : "", totals.worst_error_ratio);
  else
    text += format(
        "Reached in {} of {} pixels; {} {} not converged: {}. The widest interval is {:.2f} of its limit.",
        totals.pixels_converged, totals.pixels_done, missed, missed == 1 ? "is" : "are",
        sampling::describe_reasons(reasons), totals.worst_error_ratio);
  return text;
}

}  // namespace

std::string accuracy_statement(const io::RunPlan& plan, const Progress& totals,
                               const sampling::ReasonCounts& reasons, const std::string& why_gaps,
                               const std::vector<io::ImageError>& errors) {
  std::string text = reached_statement(plan, totals, reasons, why_gaps, errors);
  std::string held = plan.knows_errors ? render::what_intervals_hold(plan.image) : std::string();
  if (held.empty()) return text;
  held.front() = 'I';
  return text + " " + held + ".";
}

namespace {

/// What makes a sky of scattered sunlight without saying how it is polarized; empty: nothing does.
std::string unpolarized_sky(const Parts& parts) {
  const io::AtmosphereDocument& air = parts.document.atmosphere;
  if (parts.imported) return "imported runs";
  if (air.uniform || air.four_curve) return format("'{}'", air.sky_maker());
  return std::holds_alternative<io::SkyRadiance>(parts.document.light.sky) ? "'light.sky'" : "";
}

}  // namespace

std::vector<std::string> notes(const Parts& parts) {
  std::vector<std::string> lines;
  if (parts.tolerance && (parts.plan.request->unit == render::ErrorUnit::percent ||
                          parts.plan.request->unit == render::ErrorUnit::kelvin ||
                          parts.plan.request->unit == render::ErrorUnit::polarization)) {
    double low = 1e300, high = 0.0;
    for (std::size_t c = 0; c < parts.channels.size(); ++c) {
      const double floor = parts.tolerance->floor_w_m2_sr_um(static_cast<int>(c));
      low = std::min(low, floor);
      high = std::max(high, floor);
    }
    lines.push_back(
        format("floor of the accuracy: {:g} of a white surface's radiance, {:.3g} to {:.3g} W m-2 sr-1 um-1",
               parts.plan.request->floor, low, high));
  }
  if (parts.polarimetry) {
    lines.push_back(
        !surroundings_statement(parts).empty()
            ? "polarization: about the focal plane's axes; light that the ground around the scene emits, and what the scene's own ground "
              "sends otherwise into the air, is taken to be unpolarized"
            : "polarization: about the focal plane's axes; light that ground around the scene and the ground's own light in the air send "
              "is taken to be unpolarized");
    if (!parts.atmosphere)
      lines.push_back(parts.imported
                          ? "polarization: sky and path of imported runs are taken to be unpolarized"
                          : "polarization: the sky is unpolarized without a modelled atmosphere");
  }
  const std::string sky = unpolarized_sky(parts);
  if (!parts.polarimetry && !sky.empty() && polarizes(parts.scene))
    lines.push_back(format(
        "polarization: the sky of {} is taken to be unpolarized; what glass, water and metal reflect of it may be off by as "
        "much as it is polarized (up to two thirds at Brewster's angle)",
        sky));
  if (!parts.air.empty()) {
    lines.push_back(atmosphere_error_note(parts.air));
    const auto& modelled = parts.document.atmosphere.modelled;
    lines.push_back(model_error_note(parts.air, parts.channels, modelled && !modelled->clouds.empty()));
    if (modelled && modelled->gas_model)
      lines.push_back(format(
          "gas model: '{}', in place of the built-in bands of its gases in the channels within its range; what its terms are "
          "off by, as it says, is part of the air's error, and the error of the model of the air {}",
          modelled->gas_model->path,
          parts.air.front().model_of_bands > 0.0
              ? "takes the spectra for as wrong as the bands: the file does not say what they are off by"
              : "has what it says of its spectra"));
    const std::string haze =
        modelled && modelled->aerosol ? haze_statement(*modelled->aerosol) : std::string();
    if (!haze.empty())
      lines.push_back(
          format("haze: the document's own, {}; {}, and the error of the model "
                 "of the air is that of gases and of haze of the tables: how far this haze is from the "
                 "air it does not know",
                 haze, haze_polarization(*modelled->aerosol)));
    if (modelled && modelled->aerosol && has_aerosol_of(*modelled->aerosol, "desert"))
      lines.push_back(
          "haze: dust is taken for spheres; spheroids send half as much again to scattering angles of 110 to 140 degrees and half as much "
          "to 160 to 180, and the error of the model of the air has 0.7 of what dust scatters into paths besides");
  }
  if (parts.document.atmosphere.modelled && !parts.document.atmosphere.modelled->clouds.empty()) {
    for (const io::CloudDocument& cloud : parts.document.atmosphere.modelled->clouds)
      lines.push_back(format("cloud: {}", cloud_statement(cloud)));
    lines.push_back(
        "clouds: level, uniform and the same everywhere; the error of the model of the air has what droplets and crystals of these "
        "sizes may do otherwise, and no figure is stated for edges, holes and amounts that are not as written");
  }
  for (const std::string& line :
       scale_statements(parts.map_scales, ground_sample_m(*parts.camera, *parts.scene.world)))
    lines.push_back(line);
  if (!parts.assumed_surroundings.empty())
    lines.push_back(parts.assumed_surroundings);
  else if (!parts.document.light.surroundings)
    lines.push_back("surroundings: black at 0 K (none declared) for rays that leave below the horizon");
  else if (const std::string around = surroundings_statement(parts); !around.empty())
    lines.push_back(around);
  if (!parts.ground_in_air.empty()) lines.push_back(parts.ground_in_air);
  if (parts.temperature_errors) {
    lines.push_back("solved temperatures: " + parts.temperature_errors->weather);
    lines.push_back(parts.temperature_errors->statement());
  }
  return lines;
}

}  // namespace ifov::session
