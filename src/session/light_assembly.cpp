#include "session/light_assembly.h"

#include <numbers>

#include "geodesy/sun_position.h"
#include "radiometry/solar_spectrum.h"
#include "session/spectrum_assembly.h"
#include "session/with_position.h"

namespace ifov::session {

namespace {

scene::Sun assemble_sun(const io::Document& document, const io::SunDocument& source) {
  scene::Sun sun;
  sun.half_angle_rad = 0.5 * source.diameter_rad;
  double distance_au = 1.0;
  if (source.direction) {
    sun.direction =
        geodesy::direction_enu(source.direction->azimuth_rad, 0.5 * std::numbers::pi - source.direction->zenith_rad);
  }
  if (document.time && document.scene.origin.geographic) {
    const io::OriginDocument& origin = document.scene.origin;
    const geodesy::SunPosition position =
        geodesy::sun_position(*document.time, origin.geographic->latitude_rad, origin.geographic->longitude_rad,
                              origin.height_m);
    if (!source.direction) sun.direction = position.direction_enu;
    distance_au = position.distance_au;
  } else if (document.time) {
    distance_au = geodesy::sun_position(*document.time, 0.0, 0.0).distance_au;
  }
  if (source.distance_au) distance_au = *source.distance_au;
  const radiometry::Spectrum at_1au = source.irradiance
                                          ? assemble_spectrum(document, *source.irradiance, "irradiance of the Sun")
                                          : radiometry::solar_irradiance_1au();
  sun.irradiance = at_1au.scaled(1.0 / (distance_au * distance_au));
  if (document.atmosphere.tabulated && document.atmosphere.tabulated->sun_transmittance)
    sun.transmittance =
        assemble_spectrum(document, *document.atmosphere.tabulated->sun_transmittance, "transmittance to the Sun");
  return sun;
}

}  // namespace

void assemble_light(const io::Document& document, scene::Scene& scene) {
  const io::LightDocument& light = document.light;
  if (light.sun)
    scene.sun = with_position(document, light.sun->position, [&] { return assemble_sun(document, *light.sun); });

  if (const auto* sky = std::get_if<io::SkyTemperature>(&light.sky)) scene.sky.temperature_k = sky->temperature_k;
  if (const auto* sky = std::get_if<io::SkyRadiance>(&light.sky))
    scene.sky.radiance = assemble_spectrum(document, sky->radiance, "radiance of the sky");

  materials::Material around;
  around.name = "surroundings";
  if (light.surroundings) {
    const radiometry::Spectrum spectrum = assemble_spectrum(document, light.surroundings->spectrum, around.name);
    around.reflectance = light.surroundings->is_emissivity ? spectrum.complement() : spectrum;
    around.temperature_k = light.surroundings->temperature_k;
  }
  scene.surroundings = {static_cast<std::uint32_t>(scene.materials.size()), around.temperature_k.value_or(0.0)};
  scene.materials.push_back(std::move(around));

  if (document.atmosphere.tabulated) {
    const io::TabulatedAtmosphere& table = *document.atmosphere.tabulated;
    if (table.transmittance)
      scene.view_path.transmittance = assemble_spectrum(document, *table.transmittance, "transmittance to the sensor");
    if (table.path_radiance)
      scene.view_path.radiance = assemble_spectrum(document, *table.path_radiance, "path radiance");
  }
}

}  // namespace ifov::session
