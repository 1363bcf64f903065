#include "session/assembly/whole/light_assembly.h"

#include <cmath>
#include <numbers>

#include "core/overloaded.h"
#include "geodesy/moon_position.h"
#include "geodesy/sun_position.h"
#include "io/document/atmosphere_document.h"
#include "io/document/light_document.h"
#include "io/document/origin_document.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "scene/scene.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

namespace {

/// DIRSIG's simple atmosphere: a blackbody scaled so that a surface that faces it has what it gets on a clear day.
radiometry::Spectrum simple_sunlight() {
  constexpr double kTemperature_k = 5800.0, kClearDay_w_m2 = 1000.0,
                   kStefanBoltzmann_w_m2_k4 = 5.670374419e-8;
  constexpr double kFirst_um = 0.2, kLast_um = 50.0;
  constexpr int kSteps = 600;
  const double scale =
      std::numbers::pi * kClearDay_w_m2 / (kStefanBoltzmann_w_m2_k4 * std::pow(kTemperature_k, 4));
  std::vector<double> wavelength_um, irradiance;
  for (int k = 0; k <= kSteps; ++k) {
    wavelength_um.push_back(kFirst_um * std::pow(kLast_um / kFirst_um, static_cast<double>(k) / kSteps));
    irradiance.push_back(scale * radiometry::planck_w_m2_sr_um(wavelength_um.back(), kTemperature_k));
  }
  return {std::move(wavelength_um), std::move(irradiance), radiometry::OutsideRange::extend, "blackbody Sun"};
}

/// What an atmosphere says of sunlight at the ground; nothing: sunlight above the air counts.
std::optional<radiometry::Spectrum> sunlight_at_ground(const LightParts& parts) {
  const io::AtmosphereDocument& air = parts.atmosphere;
  if (air.simple) return simple_sunlight();
  if (air.uniform) return radiometry::Spectrum::constant(air.uniform->direct_w_m2_um);
  if (air.four_curve) return assemble_spectrum(parts.sources, air.four_curve->direct, "direct irradiance");
  return std::nullopt;
}

/// On the equator at Greenwich where the document names no place.
geodesy::Geodetic place_of(const io::OriginDocument& origin) {
  const auto geographic = origin.geographic.value_or(io::OriginDocument::Geographic());
  return {geographic.latitude_rad, geographic.longitude_rad, origin.height_m};
}

math::Vec3 towards(const io::CelestialDirection& direction) {
  return geodesy::direction_enu(direction.azimuth_rad, 0.5 * std::numbers::pi - direction.zenith_rad).v;
}

void dim_by_table(const LightParts& parts, scene::Sun& sun) {
  if (parts.atmosphere.tabulated && parts.atmosphere.tabulated->sun_transmittance)
    sun.transmittance = assemble_spectrum(parts.sources, *parts.atmosphere.tabulated->sun_transmittance,
                                          "transmittance to the Sun");
}

scene::Sun assemble_sun(const LightParts& parts, const io::SunDocument& source) {
  scene::Sun sun;
  sun.half_angle_rad = 0.5 * source.diameter_rad;
  double distance_au = 1.0;
  if (source.direction) sun.direction = towards(*source.direction);
  if (parts.time && parts.origin.geographic) {
    const geodesy::SunPosition position = geodesy::sun_position(*parts.time, place_of(parts.origin));
    if (!source.direction) sun.direction = position.direction_enu.v;
    distance_au = position.distance_au;
  } else if (parts.time) {
    distance_au = geodesy::sun_position(*parts.time, {}).distance_au;
  }
  if (source.distance_au) distance_au = *source.distance_au;
  if (const std::optional<radiometry::Spectrum> at_ground = sunlight_at_ground(parts)) {
    sun.irradiance = *at_ground;
    return sun;
  }
  const radiometry::Spectrum at_1au =
      source.irradiance ? assemble_spectrum(parts.sources, *source.irradiance, "irradiance of the Sun")
                        : radiometry::solar_irradiance_1au();
  sun.irradiance = at_1au.scaled(1.0 / (distance_au * distance_au));
  dim_by_table(parts, sun);
  return sun;
}

scene::Sun assemble_moon(const LightParts& parts, const io::MoonDocument& source) {
  constexpr double kRadius_m = 1737.4e3;
  geodesy::MoonPosition position;
  position.distance_m = geodesy::kMeanMoonDistance_m;
  if (parts.time) position = geodesy::moon_position(*parts.time, place_of(parts.origin));
  if (source.phase_angle_rad) position.phase_angle_rad = *source.phase_angle_rad;
  scene::Sun moon;
  moon.is_moon = true;
  moon.direction = source.direction ? towards(*source.direction) : position.direction_enu.v;
  moon.half_angle_rad = std::asin(kRadius_m / position.distance_m);
  moon.irradiance = radiometry::solar_irradiance_1au().scaled(geodesy::moonlight_ratio(position));
  dim_by_table(parts, moon);
  return moon;
}

/// Sky and path of DIRSIG's atmospheres.
void assemble_plain_air(const LightParts& parts, scene::Scene& scene) {
  const io::AtmosphereDocument& air = parts.atmosphere;
  if (air.simple) scene.sky.temperature_k = air.simple->sky_temperature_k;
  if (air.uniform)
    scene.sky.radiance = radiometry::Spectrum::constant(air.uniform->diffuse_w_m2_um / std::numbers::pi);
  if (!air.four_curve) return;
  const io::FourCurveAtmosphere& curves = *air.four_curve;
  const double lengths = curves.distance_m / curves.length_m;
  scene.sky.radiance =
      assemble_spectrum(parts.sources, curves.diffuse, "diffuse irradiance").scaled(1.0 / std::numbers::pi);
  scene.view_path.transmittance =
      assemble_spectrum(parts.sources, curves.transmittance, "transmittance to the sensor")
          .mapped([&](double t) { return std::pow(t, lengths); });
  scene.view_path.radiance =
      assemble_spectrum(parts.sources, curves.path_radiance, "path radiance").scaled(lengths);
}

}  // namespace

void assemble_light(const LightParts& parts, scene::Scene& scene) {
  const io::LightDocument& light = parts.light;
  if (light.sun)
    scene.sun =
        with_position(parts.sources, light.sun->position, [&] { return assemble_sun(parts, *light.sun); });
  const bool is_day =
      scene.sun && (scene.sun->is_up() || (parts.atmosphere.modelled && scene.sun->is_twilight()));
  if (light.moon && !is_day)
    scene.sun =
        with_position(parts.sources, light.moon->position, [&] { return assemble_moon(parts, *light.moon); });

  std::visit(Overloaded{[](const io::NoSky&) {},
                        [&](const io::SkyTemperature& sky) { scene.sky.temperature_k = sky.temperature_k; },
                        [&](const io::SkyRadiance& sky) {
                          scene.sky.radiance =
                              assemble_spectrum(parts.sources, sky.radiance, "radiance of the sky");
                        }},
             light.sky);

  materials::Material around = parts.ground.value_or(materials::Material());
  around.name = "surroundings";
  around.curve_of.reset();
  if (light.surroundings && parts.ground) {
    if (light.surroundings->temperature_k) around.temperature_k = light.surroundings->temperature_k;
  } else if (light.surroundings) {
    const radiometry::Spectrum spectrum =
        assemble_spectrum(parts.sources, light.surroundings->spectrum, around.name);
    around.reflectance = light.surroundings->is_emissivity ? spectrum.complement() : spectrum;
    around.temperature_k = light.surroundings->temperature_k;
  }
  scene.surroundings = {static_cast<std::uint32_t>(scene.materials.size()),
                        around.temperature_k.value_or(0.0)};
  scene.materials.push_back(std::move(around));

  if (parts.atmosphere.tabulated) {
    const io::TabulatedAtmosphere& table = *parts.atmosphere.tabulated;
    if (table.transmittance)
      scene.view_path.transmittance =
          assemble_spectrum(parts.sources, *table.transmittance, "transmittance to the sensor");
    if (table.path_radiance)
      scene.view_path.radiance = assemble_spectrum(parts.sources, *table.path_radiance, "path radiance");
  }
  with_position(parts.sources, parts.atmosphere.position, [&] { assemble_plain_air(parts, scene); });
}

}  // namespace ifov::session
