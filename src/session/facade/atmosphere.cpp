#include "ifov/atmosphere.h"

#include <algorithm>

#include "core/call_scope.h"
#include "core/error.h"
#include "io/files/inputs.h"
#include "io/products/envi_reader.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/loaded/parts.h"
#include "session/reflectance_cube.h"
#include "session/session.h"
#include "session/surveys/atmosphere_summary.h"
#include "session/surveys/atmosphere_survey.h"

namespace ifov {
namespace {

AtmosphereEffects light_of(const atmosphere::AtmosphereEffects& light) {
  return {.wavelength_um = light.wavelength_um,
          .solar_irradiance = light.solar_irradiance,
          .sun_transmittance = light.sun_transmittance,
          .view_transmittance = light.view_transmittance,
          .diffuse_transmittance = light.diffuse_transmittance,
          .solar_path = light.solar_path,
          .thermal_path = light.thermal_path,
          .direct_irradiance = light.direct_irradiance,
          .solar_sky = light.solar_sky,
          .thermal_sky = light.thermal_sky,
          .spherical_albedo = light.spherical_albedo,
          .path_q = light.path_q,
          .path_u = light.path_u,
          .over_ground = {.ground_diffuse = light.over_ground.ground_diffuse,
                          .ground_up = light.over_ground.ground_up,
                          .sensor_direct = light.over_ground.sensor_direct,
                          .sensor_diffuse = light.over_ground.sensor_diffuse,
                          .sensor_up = light.over_ground.sensor_up,
                          .radiance = light.over_ground.radiance,
                          .q = light.over_ground.q,
                          .u = light.over_ground.u}};
}

SkyLight sky_of(const io::AtmosphereReport& report) {
  SkyLight sky;
  sky.channel = report.sky_channel;
  sky.wavelength_um = report.sky->wavelength_um;
  sky.thermal = report.sky_is_thermal;
  sky.zenith_rad = report.sky->zenith_rad;
  sky.azimuth_rad = report.sky->azimuth_rad;
  for (const radiometry::StokesVector& light : report.sky->light)
    sky.stokes.push_back({light.i, light.q, light.u});
  for (const atmosphere::NeutralPoint& point : report.neutral_points)
    sky.neutral_points.push_back({point.name, point.zenith_rad, point.distance_rad});
  return sky;
}

constexpr std::string_view kRadiance = "_radiance.img";

std::filesystem::path cube_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return path;
  std::vector<std::filesystem::path> cubes;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.path().filename().string().ends_with(kRadiance)) cubes.push_back(entry.path());
  if (cubes.size() != 1)
    throw InputError(format("'{}' holds {} cubes of radiance (NAME{}): expected one", path.string(),
                            cubes.size(), kRadiance));
  return cubes.front();
}

/// Without what tells a cube from others of the same run.
std::string stem_of(const std::filesystem::path& data) {
  std::string stem = data.string();
  if (stem.ends_with(kRadiance)) return stem.substr(0, stem.size() - kRadiance.size());
  return std::filesystem::path(data).replace_extension().string();
}

std::unique_ptr<io::EnviReader> half_widths_beside(const std::string& stem, const io::EnviReader& cube) {
  const std::string path = stem + "_half_width.img";
  if (!std::filesystem::exists(path)) return nullptr;
  auto found = std::make_unique<io::EnviReader>(path);
  const io::EnviHeader &here = found->header(), &there = cube.header();
  if (here.samples != there.samples || here.lines != there.lines || here.bands != there.bands)
    throw InputError(format("{}: {} x {} pixels of {} bands, but {} has {} x {} of {}", path, here.samples,
                            here.lines, here.bands, cube.data_path().string(), there.samples, there.lines,
                            there.bands));
  return found;
}

}  // namespace

struct AtmosphereReport::Inside {
  io::AtmosphereReport report;
};

void FacadeAccess::set(AtmosphereReport& report, io::AtmosphereReport inside) {
  report.inside_ =
      std::make_shared<const AtmosphereReport::Inside>(AtmosphereReport::Inside{std::move(inside)});
}

AtmosphereReport survey_atmosphere(const Document& document, const AtmosphereQuestion& question) {
  if (question.threads < 0)
    throw InputError(format("threads: {} was asked for; 0 takes all cores", question.threads));
  const auto& source = FacadeAccess::inside(document);
  const Call call{source.inputs, question.cancel};
  const CallScope scope(call);
  io::AtmosphereReport found = session::survey_atmosphere(source.document, question);
  AtmosphereReport report;
  report.description = found.description;
  report.sun_zenith_rad = found.geometry.sun_zenith_rad;
  report.sun_azimuth_rad = found.sun_azimuth_rad;
  report.view_zenith_rad = found.geometry.view_zenith_rad;
  report.sensor_altitude_km = found.geometry.sensor_altitude_km;
  for (const io::AtmosphereReport::Channel& channel : found.channels)
    report.channels.push_back({channel.name, channel.first_um, channel.last_um, light_of(channel.light)});
  for (const atmosphere::AtmosphereEffects& step : found.spectrum) report.spectrum.push_back(light_of(step));
  report.step_cm1 = found.step_cm1;
  if (found.sky) report.sky = sky_of(found);
  FacadeAccess::set(report, std::move(found));
  return report;
}

std::string AtmosphereReport::table() const { return io::atmosphere_report_text(inside_->report); }

std::string AtmosphereReport::csv() const { return io::atmosphere_report_csv(inside_->report); }

void AtmosphereReport::write_summary(const std::filesystem::path& path, bool steps) const {
  session::write_summary(inside_->report, path, steps);
}

std::string AtmosphereReport::sky_csv() const { return io::sky_csv(inside_->report); }

std::string AtmosphereReport::figure() const { return io::atmosphere_report_figure(inside_->report); }

InversionOutcome invert_radiance(const Document& document, const InversionQuestion& question) {
  if (question.threads < 0)
    throw InputError(format("threads: {} was asked for; 0 takes all cores", question.threads));
  const auto& source = FacadeAccess::inside(document);
  const Call call{source.inputs, question.cancel};
  const CallScope scope(call);
  if (!source.document.atmosphere.modelled)
    throw io::document_error(
        source.document.sources, source.document.atmosphere.position,
        "there is no modelled atmosphere to take from the radiance: 'atmosphere' has no 'profile'");
  const io::EnviReader cube(cube_of(question.cube));
  const std::string stem = stem_of(cube.data_path());
  const auto half_widths = half_widths_beside(stem, cube);
  const session::Session session = session::Session::load(
      source.document, question.log,
      {.threads = question.threads, .cancel = question.cancel, .progress = question.progress});
  const session::Parts& parts = session.parts();
  const std::string to = question.stem.empty() ? stem : question.stem.string();
  InversionOutcome outcome;
  outcome.reflectance = to + "_reflectance.img";
  outcome.half_width = to + "_reflectance_half_width.img";
  const session::RetrievalCounts counts = session::retrieve(
      {parts.info, source.document.sources.file_name, cube, half_widths.get()}, *parts.atmosphere,
      outcome.reflectance.string(), outcome.half_width.string(), question.threads, question.cancel);
  outcome.values = counts.values;
  outcome.negative = counts.negative;
  outcome.missing = counts.missing;
  const auto most = std::max_element(counts.negative_by_channel.begin(), counts.negative_by_channel.end());
  if (counts.negative > 0)
    outcome.most_negative =
        parts.channels[static_cast<std::size_t>(most - counts.negative_by_channel.begin())].name;
  for (const std::size_t c : counts.left_out) outcome.left_out.push_back(parts.channels[c].name);
  return outcome;
}

}  // namespace ifov
