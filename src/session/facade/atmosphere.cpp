#include "ifov/atmosphere.h"

#include "core/call_scope.h"
#include "core/error.h"
#include "io/files/inputs.h"
#include "session/atmosphere_survey.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"

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
          .spherical_albedo = light.spherical_albedo};
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

std::string AtmosphereReport::sky_csv() const { return io::sky_csv(inside_->report); }

std::string AtmosphereReport::figure() const { return io::atmosphere_report_figure(inside_->report); }

}  // namespace ifov
