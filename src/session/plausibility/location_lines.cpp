#include "session/plausibility/location_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "geodesy/sun_position.h"
#include "geometry/world.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/cameras/flight_motion.h"
#include "io/document/document.h"
#include "render/tolerance/channel_brightness.h"
#include "sensor/camera.h"
#include "session/assembly/shared/scene_maps.h"
#include "session/loaded/parts.h"
#include "session/plausibility/motion_lines.h"

namespace ifov::session {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kBrightness_um = 3.0;     // from here on channels speak in kelvins
constexpr std::size_t kChannelsNamed = 4;  // channels in a line

bool on_map(const Parts& parts) {
  return parts.document.scene.origin.has_map_offset || !parts.document.scene.origin.crs.empty();
}

std::string line(const char* what, const std::string& text) { return format("{:<10} {}", what, text); }

std::string range_text(double low, double high, const char* unit) {
  if (low < 1e-6 * high) low = 0.0;  // what is left of light that a path lost
  if (high < 1e-15) low = high = 0.0;
  return high - low <= 1e-3 * std::abs(high) ? format("{:.4g} {}", high, unit)
                                             : format("{:.4g} to {:.4g} {}", low, high, unit);
}

std::string metres(double value) {
  return std::abs(value) < 1e4 ? format("{:.5g}", value) : format("{:.0f}", value);
}

std::string scene_line(const Parts& parts) {
  const geometry::World& world = *parts.scene.world;
  const double up_m = on_map(parts) ? parts.map_offset_m.z : 0.0;
  bool bounded = false;
  for (std::size_t d = 0; d < parts.placed.document_objects() && !bounded; ++d)
    bounded = parts.placed.count(d) > 0 && std::isfinite(world.object(parts.placed.first(d)).radius_m);
  const geometry::World::Heights heights = world.heights();
  std::string text;
  if (bounded) {
    const geometry::World::Bounds b = world.bounds();
    text = area_text(parts, {b.low_m.x, b.high_m.x}, {b.low_m.y, b.high_m.y}) + ", ";
  }
  text += heights.low_m == heights.high_m
              ? format("z {:.5g} m", heights.low_m + up_m)
              : format("z {:.5g} to {:.5g} m", heights.low_m + up_m, heights.high_m + up_m);
  if (world.object_count() == 0) return "nothing";
  if (const auto period = world.period())
    text += format("; repeats every {:g} x {:g} m", period->x_m, period->y_m);
  return text;
}

std::string camera_line(const Parts& parts) {
  const math::Vec3 to_scene =
      on_map(parts) ? parts.map_offset_m - parts.document.scene.origin.offset_m : math::Vec3{};
  return parts.document.sensor.camera.settings->description(
      to_scene, on_map(parts) ? "east, north, height" : "x, y, z");
}

std::string sees_line(const Parts& parts, const SceneSurvey& survey) {
  if (survey.distance_m.low > survey.distance_m.high) return "nothing but sky";
  std::string text = area_text(parts, survey.x_m, survey.y_m);
  text += format("; a pixel covers {}", range_text(survey.gsd_m.low, survey.gsd_m.high, "m"));
  if (parts.camera->pose(parts.camera->middle_line_px()).position_m)
    text += format(", {} away", range_text(survey.distance_m.low, survey.distance_m.high, "m"));
  if (survey.sky_share > 0.0) text += format("; {:.2g} % sees no surface", 100.0 * survey.sky_share);
  return text;
}

std::string in_view_line(const SceneSurvey& survey) {
  double inside = 0.0;
  bool all = true;
  for (std::size_t d = 0; d < survey.in_frame.size(); ++d) {
    if (survey.surveyed[d] == 0) continue;
    inside += static_cast<double>(survey.in_frame[d]);
    all = all && survey.in_frame[d] == survey.surveyed[d];
  }
  if (all) return format("all {} objects", survey.objects);
  double of = 0.0;
  for (const std::size_t n : survey.surveyed) of += static_cast<double>(n);
  return format("{}{:.0f} of {} objects, by their places",
                of < static_cast<double>(survey.objects) ? "about " : "",
                inside / of * static_cast<double>(survey.objects), survey.objects);
}

std::string sun_line(const Parts& parts) {
  const auto& sun = parts.scene.sun;
  if (!sun) return "none";
  return format("{:.4g} deg above the horizon, azimuth {:.4g} deg", sun->elevation_rad() * kDegrees,
                geodesy::compass_deg(sun->azimuth_rad()));
}

/// One text for each of the first channels and the last.
template <class Text>
std::string by_channel(const Parts& parts, Text text) {
  const std::size_t count = parts.channels.size();
  std::string all;
  for (std::size_t c = 0; c < count; ++c) {
    if (count > kChannelsNamed && c >= kChannelsNamed - 1 && c + 1 < count) continue;
    all += format("{}{} {}",
                  all.empty()                                ? ""
                  : c + 1 == count && count > kChannelsNamed ? "; ... "
                                                             : "; ",
                  parts.channels[c].name, text(c));
  }
  return all;
}

std::vector<std::string> mounts_told(const Parts& parts) {
  const io::CameraSettings& settings = *parts.document.sensor.camera.settings;
  const io::PlatformFlight* const flight = settings.carrier();
  if (flight == nullptr) return {};
  const io::CameraSettings::Exposed exposed = settings.exposed();
  const io::OriginDocument& origin = parts.document.scene.origin;
  const MapsOfScene maps(parts.document.sources, origin);
  return io::bearings_told(*flight, {origin.offset_m, &maps}, exposed.from_s, exposed.to_s);
}

}  // namespace

std::string area_text(const Parts& parts, SceneSurvey::Range x_m, SceneSurvey::Range y_m) {
  if (!on_map(parts))
    return format("x {} to {} m, y {} to {} m", metres(x_m.low), metres(x_m.high), metres(y_m.low),
                  metres(y_m.high));
  const math::Vec3 o = parts.map_offset_m;
  return format("east {:.1f} to {:.1f} m, north {:.1f} to {:.1f} m (map)", x_m.low + o.x, x_m.high + o.x,
                y_m.low + o.y, y_m.high + o.y);
}

std::vector<std::string> location_lines(const Parts& parts, const SceneSurvey& survey) {
  std::vector<std::string> lines;
  lines.push_back(line("extent:", scene_line(parts)));
  lines.push_back(line("camera:", camera_line(parts)));
  for (const std::string& turned : mounts_told(parts)) lines.push_back(line("mount:", turned));
  lines.push_back(line("sees:", sees_line(parts, survey)));
  lines.push_back(line("in view:", in_view_line(survey)));
  for (std::string& moving : motion_lines(parts)) lines.push_back(std::move(moving));
  lines.push_back(line(parts.scene.sun && parts.scene.sun->is_moon ? "Moon:" : "Sun:", sun_line(parts)));
  lines.push_back(line("on ground:", by_channel(parts, [&](std::size_t c) {
                                       const auto light = [](double irradiance) {
                                         return irradiance < 1e-15 ? 0.0 : irradiance;
                                       };
                                       return format("Sun {:.3g}, sky {:.3g}", light(survey.sun[c].low),
                                                     light(survey.sky[c].low));
                                     }) + " W m-2 um-1"));
  lines.push_back(line("radiance:", by_channel(parts, [&](std::size_t c) {
                                      const SceneSurvey::Range& r = survey.radiance[c];
                                      if (parts.channels[c].centre_um < kBrightness_um || !(r.low > 0.0))
                                        return range_text(r.low, r.high, "W m-2 sr-1 um-1");
                                      const int channel = static_cast<int>(c);
                                      return format("{:.1f} to {:.1f} K",
                                                    parts.brightness->temperature_k(channel, r.low),
                                                    parts.brightness->temperature_k(channel, r.high));
                                    }) + format(" ({} paths)", survey.rays)));
  return lines;
}

}  // namespace ifov::session
