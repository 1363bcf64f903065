#include "ifov/atmosphere.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "call.h"
#include "ifov/radiometry.h"

namespace ifov::python {
namespace {

using Direction = AtmosphereQuestion::Direction;

std::optional<Direction> direction(const std::optional<std::pair<double, double>>& zenith_azimuth_rad) {
  if (!zenith_azimuth_rad) return {};
  return Direction{zenith_azimuth_rad->first, zenith_azimuth_rad->second};
}

/// {quantity: [value of each]}
nb::dict columns(const std::vector<AtmosphereEffects>& effects) {
  struct Column {
    const char* name;
    double (*value)(const AtmosphereEffects&);
  };
  using E = const AtmosphereEffects&;
  constexpr Column kColumns[] = {{"wavelength", [](E e) { return e.wavelength_um; }},
                                 {"solar_irradiance", [](E e) { return e.solar_irradiance; }},
                                 {"sun_transmittance", [](E e) { return e.sun_transmittance; }},
                                 {"view_transmittance", [](E e) { return e.view_transmittance; }},
                                 {"diffuse_transmittance", [](E e) { return e.diffuse_transmittance; }},
                                 {"solar_path", [](E e) { return e.solar_path; }},
                                 {"thermal_path", [](E e) { return e.thermal_path; }},
                                 {"direct_irradiance", [](E e) { return e.direct_irradiance; }},
                                 {"solar_sky", [](E e) { return e.solar_sky; }},
                                 {"thermal_sky", [](E e) { return e.thermal_sky; }},
                                 {"spherical_albedo", [](E e) { return e.spherical_albedo; }},
                                 {"path_q", [](E e) { return e.path_q; }},
                                 {"path_u", [](E e) { return e.path_u; }},
                                 {"ground_diffuse", [](E e) { return e.over_ground.ground_diffuse; }},
                                 {"ground_up", [](E e) { return e.over_ground.ground_up; }},
                                 {"sensor_direct", [](E e) { return e.over_ground.sensor_direct; }},
                                 {"sensor_diffuse", [](E e) { return e.over_ground.sensor_diffuse; }},
                                 {"sensor_up", [](E e) { return e.over_ground.sensor_up; }},
                                 {"radiance", [](E e) { return e.over_ground.radiance; }},
                                 {"q", [](E e) { return e.over_ground.q; }},
                                 {"u", [](E e) { return e.over_ground.u; }}};
  nb::dict all;
  for (const Column& column : kColumns) {
    std::vector<double> values;
    for (const AtmosphereEffects& one : effects) values.push_back(column.value(one));
    all[column.name] = values;
  }
  return all;
}

nb::dict told(const SkyLight& sky) {
  nb::dict all;
  all["channel"] = sky.channel;
  all["wavelength"] = sky.wavelength_um;
  all["thermal"] = sky.thermal;
  all["zenith_rad"] = sky.zenith_rad;
  all["azimuth_rad"] = sky.azimuth_rad;
  nb::list stokes;
  for (const auto& [i, q, u] : sky.stokes) stokes.append(nb::make_tuple(i, q, u));
  all["stokes"] = stokes;
  return all;
}

nb::dict told(const AtmosphereReport& report) {
  nb::dict all;
  all["description"] = report.description;
  all["sun_zenith_rad"] = report.sun_zenith_rad;
  all["sun_azimuth_rad"] = report.sun_azimuth_rad;
  all["view_zenith_rad"] = report.view_zenith_rad;
  all["sensor_altitude_km"] = report.sensor_altitude_km;
  nb::list names, first, last;
  std::vector<AtmosphereEffects> effects;
  for (const AtmosphereReport::Channel& channel : report.channels) {
    names.append(channel.name);
    first.append(channel.first_um);
    last.append(channel.last_um);
    effects.push_back(channel.light);
  }
  all["channel"] = names;
  all["first_um"] = first;
  all["last_um"] = last;
  all["channels"] = columns(effects);
  if (!report.spectrum.empty()) all["spectrum"] = columns(report.spectrum);
  if (report.sky) all["sky"] = told(*report.sky);
  all["table"] = report.table();
  return all;
}

}  // namespace

void add_atmosphere(nb::module_& module) {
  module.def(
      "atmosphere",
      [](const Document& document, const std::optional<std::pair<double, double>>& sun_rad,
         const std::optional<std::pair<double, double>>& view_rad, bool night,
         std::optional<double> altitude_km, const std::variant<double, std::string>& ground, bool spectrum,
         bool sky, const std::string& sky_channel, int threads, nb::object progress) {
        Call call(std::move(progress));
        const double* reflectance = std::get_if<double>(&ground);
        const AtmosphereReport report = call.run([&] {
          return survey_atmosphere(
              document,
              {.sun = direction(sun_rad),
               .view = direction(view_rad),
               .night = night,
               .sensor_altitude_km = altitude_km,
               .ground_reflectance = reflectance != nullptr ? *reflectance : 0.0,
               .ground_material = reflectance != nullptr ? std::string() : std::get<std::string>(ground),
               .spectrum = spectrum,
               .sky = sky,
               .sky_channel = sky_channel,
               .threads = threads,
               .cancel = call.cancel(),
               .progress = &call});
        });
        return told(report);
      },
      nb::arg("document"), nb::arg("sun").none(), nb::arg("view").none(), nb::arg("night"),
      nb::arg("altitude").none(), nb::arg("ground"), nb::arg("spectrum"), nb::arg("sky"),
      nb::arg("sky_channel"), nb::arg("threads"), nb::arg("progress").none());
  module.def("planck_radiance", &planck_radiance, nb::arg("wavelength"), nb::arg("temperature"));
  module.def("brightness_temperature", &brightness_temperature, nb::arg("wavelength"), nb::arg("radiance"));
}

}  // namespace ifov::python
