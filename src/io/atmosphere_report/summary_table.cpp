#include "io/atmosphere_report/summary_table.h"

#include <numbers>

#include "core/format.h"
#include "io/atmosphere_report/atmosphere_report.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

using Light = atmosphere::AtmosphereEffects;

/// Sunlight on a level surface above the air.
double above(const AtmosphereReport& report, const Light& of) {
  return of.solar_irradiance * report.geometry.sun_sine();
}
double share(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

struct Row {
  const char *name, *unit, *what;
  bool of_sun;  ///< nothing without one above the horizon
  double (*value)(const AtmosphereReport&, const Light&);
};

constexpr const char *kRadiance = "W m-2 sr-1 um-1", *kIrradiance = "W m-2 um-1";

constexpr Row kRows[] = {
    {"wavelength", "um", "centre", false,
     [](const AtmosphereReport&, const Light& l) { return l.wavelength_um; }},
    {"solar_irradiance", kIrradiance, "sunlight above the air, across the beam", true,
     [](const AtmosphereReport&, const Light& l) { return l.solar_irradiance; }},
    {"path_reflectance", "1", "of the path's sunlight over black ground, pi L / (E cos)", true,
     [](const AtmosphereReport& r, const Light& l) {
       return share(std::numbers::pi * l.solar_path, above(r, l));
     }},
    {"direct_transmittance_down", "1", "share of sunlight that reaches level ground straight", true,
     [](const AtmosphereReport&, const Light& l) { return l.sun_transmittance; }},
    {"diffuse_transmittance_down", "1", "share of sunlight that reaches level black ground scattered", true,
     [](const AtmosphereReport& r, const Light& l) { return share(l.solar_sky, above(r, l)); }},
    {"direct_transmittance_up", "1", "share of the ground's light that reaches the sensor straight", false,
     [](const AtmosphereReport&, const Light& l) { return l.view_transmittance; }},
    {"diffuse_transmittance_up", "1", "the same of uniform ground all around, scattered on the way", true,
     [](const AtmosphereReport&, const Light& l) { return l.diffuse_transmittance; }},
    {"spherical_albedo", "1", "of the air for light from below", true,
     [](const AtmosphereReport&, const Light& l) { return l.spherical_albedo; }},
    {"solar_path_radiance", kRadiance, "sunlight that the path adds over black ground", true,
     [](const AtmosphereReport&, const Light& l) { return l.solar_path; }},
    {"path_q", kRadiance, "its Q: above 0 where it swings in the vertical plane of the line of sight", true,
     [](const AtmosphereReport&, const Light& l) { return l.path_q; }},
    {"path_u", kRadiance,
     "its U: above 0 where it swings 45 deg counterclockwise of that, seen by the sensor", true,
     [](const AtmosphereReport&, const Light& l) { return l.path_u; }},
    {"thermal_path_radiance", kRadiance, "emission that the path adds over black and cold ground", false,
     [](const AtmosphereReport&, const Light& l) { return l.thermal_path; }},
    {"ground_direct", kIrradiance, "straight sunlight on level ground", true,
     [](const AtmosphereReport&, const Light& l) { return l.direct_irradiance; }},
    {"ground_diffuse", kIrradiance, "the sky's light on level ground, with what goes back to it", false,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.ground_diffuse; }},
    {"ground_up", kIrradiance, "light that level ground reflects", false,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.ground_up; }},
    {"sensor_direct", kIrradiance, "straight sunlight through the level of the sensor", true,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.sensor_direct; }},
    {"sensor_diffuse", kIrradiance, "other light that comes down there", false,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.sensor_diffuse; }},
    {"sensor_up", kIrradiance, "light that goes up there", false,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.sensor_up; }},
    {"radiance", kRadiance, "at the sensor", false,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.radiance; }},
    {"q", kRadiance, "its Q, as path_q", true,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.q; }},
    {"u", kRadiance, "its U, as path_u", true,
     [](const AtmosphereReport&, const Light& l) { return l.over_ground.u; }},
};

}  // namespace

SummaryTable summary_table(const AtmosphereReport& report, bool steps) {
  SummaryTable table;
  table.description = report.description;
  table.description.push_back(format(
      "ground_ and sensor_ columns, radiance, q and u: over level, uniform ground {} that emits nothing",
      report.ground));
  std::vector<const Light*> lights;
  if (steps) {
    for (const Light& light : report.spectrum) {
      lights.push_back(&light);
      table.rows.push_back(format("{:.6g} um", light.wavelength_um));
    }
  } else {
    for (const AtmosphereReport::Channel& channel : report.channels) {
      lights.push_back(&channel.light);
      table.rows.push_back(channel.name);
    }
  }
  for (const Row& row : kRows) {
    if (row.of_sun && !report.geometry.sun_zenith_rad) continue;
    SummaryTable::Column& column =
        table.columns.emplace_back(SummaryTable::Column{row.name, row.unit, row.what, {}});
    for (const Light* light : lights) column.values.push_back(row.value(report, *light));
  }
  return table;
}

std::string summary_csv(const SummaryTable& table) {
  std::string text, heading = "channel";
  for (const std::string& line : table.description) text += "# " + line + "\n";
  for (const SummaryTable::Column& column : table.columns) {
    text += format("# {} [{}]: {}\n", column.name, column.unit, column.what);
    heading += "," + column.name;
  }
  text += heading + "\n";
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    text += csv_field(table.rows[k]);
    for (const SummaryTable::Column& column : table.columns) text += format(",{:.7g}", column.values[k]);
    text += "\n";
  }
  return text;
}

}  // namespace ifov::io
