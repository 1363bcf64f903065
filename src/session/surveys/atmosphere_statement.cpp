#include "session/surveys/atmosphere_statement.h"

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/profile/gas_requests.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "core/format.h"
#include "geodesy/sun_position.h"
#include "io/document/aerosol_document.h"
#include "io/document/atmosphere_document.h"
#include "math/angle.h"
#include "scene/scene.h"
#include "session/assembly/atmosphere/aerosol_assembly.h"
#include "session/assembly/atmosphere/cloud_assembly.h"
#include "session/assembly/atmosphere/gas_model_assembly.h"

namespace ifov::session {
namespace {

/// "Gases of the document's own: H2O, O3; left out: CH4."
std::string gases_told(const atmosphere::GasRequests& gases) {
  std::string own, out;
  const auto add = [](std::string& list, std::string_view name) {
    list += format("{}{}", list.empty() ? "" : ", ", name);
  };
  for (std::size_t g = 0; g < atmosphere::kGasCount; ++g)
    if (gases.of[g]) add(gases.of[g]->off ? out : own, atmosphere::kGasNames[g]);
  if (!gases.nitrogen) add(out, "N2");
  if (own.empty() && out.empty()) return {};
  if (own.empty()) return format("Gases left out: {}.", out);
  return format("Gases of the document's own: {}{}.", own, out.empty() ? "" : "; left out: " + out);
}

}  // namespace

std::vector<std::string> atmosphere_statement(const atmosphere::AtmosphereColumn& column,
                                              const atmosphere::SensorGeometry& geometry,
                                              const scene::Scene& scene,
                                              const io::ModelledAtmosphere& written,
                                              std::span<const radiometry::Channel> channels) {
  const io::AerosolDocument* aerosol = written.aerosol.get();
  const atmosphere::AtmosphereDescription& said = column.description();
  const atmosphere::Profile& profile = column.profile();
  std::vector<std::string> lines;
  lines.push_back(said.air.model +
                  (said.air.levels.empty() ? "" : ", below it levels of the document's own"));
  lines.push_back(
      format("Ground at {:.3g} km: {:.1f} K, {:.0f} hPa, {:.0f} % humidity. Water vapour {:.3g} g/cm2, ozone "
             "{:.0f} DU, CO2 {:.0f} ppm.",
             profile.ground_km(), profile.temperature_K.front(), profile.pressure_hPa.front(),
             profile.relative_humidity_percent(0), profile.precipitable_water_g_cm2(),
             1e3 * profile.column_atm_cm(atmosphere::Gas::o3), profile.of(atmosphere::Gas::co2).front()));
  if (const std::string gases = said.air.gases ? gases_told(*said.air.gases) : std::string(); !gases.empty())
    lines.push_back(gases);
  if (column.gas_terms() != nullptr)
    for (const std::string& line : gas_model_statements(*column.gas_terms(), channels)) lines.push_back(line);
  if (!column.aerosol().hazy())
    lines.push_back("No aerosol.");
  else if (aerosol != nullptr && aerosol->has_own())
    lines.push_back(
        format("Haze of the document's own: {}. Aerosol in all: {:.3f} at 0.55 um.", haze_statement(*aerosol),
               column.aerosol().thickness_550(profile.ground_km(), atmosphere::kTopOfAtmosphereKm)));
  else
    lines.push_back(
        format("Aerosol: {}, visibility {:.3g} km, optical thickness {:.3f} at 0.55 um.", said.aerosol.type,
               column.aerosol().visibility_km(),
               column.aerosol().thickness_550(profile.ground_km(), atmosphere::kTopOfAtmosphereKm)));
  for (const io::CloudDocument& cloud : written.clouds)
    lines.push_back(format("Cloud of {}.", cloud_statement(cloud)));
  std::string where = "No Sun.";
  if (geometry.sun_zenith_rad) {
    where =
        format("{} {:.1f} deg from the zenith at azimuth {:.1f} deg.", scene.sun->is_moon ? "Moon" : "Sun",
               *geometry.sun_zenith_rad / math::kDegree, geodesy::compass_deg(scene.sun->azimuth_rad()));
  } else if (scene.sun) {
    where = scene.sun->is_moon ? "The Moon is below the horizon." : "The Sun is below the horizon.";
  }
  const bool above = geometry.sensor_altitude_km >= atmosphere::kTopOfAtmosphereKm;
  lines.push_back(
      format("{} Sensor {:.1f} deg from the zenith, {}.", where, geometry.view_zenith_rad / math::kDegree,
             above ? std::string("above all air") : format("at {:.4g} km", geometry.sensor_altitude_km)));
  return lines;
}

}  // namespace ifov::session
