#include "session/solved/document_air.h"

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/profile/profile.h"
#include "atmosphere/survey/broadband_fluxes.h"
#include "atmosphere/weather_series.h"
#include "core/format.h"
#include "io/document/atmosphere_document.h"
#include "io/document/document.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "thermal/faces/sky_longwave.h"

namespace ifov::session {
namespace {

using atmosphere::WeatherQuantity;

constexpr double kStep_cm1 = 20.0;

double longwave_over_prata(const atmosphere::AtmosphereColumn& column) {
  const atmosphere::Profile& profile = column.profile();
  const double air_k = profile.temperature_K.front(),
               vapour_pa = 1e-4 * profile.of(atmosphere::Gas::h2o).front() * profile.pressure_hPa.front();
  return atmosphere::longwave_down_w_m2(column, kStep_cm1, 0) /
         thermal::sky_longwave_w_m2(air_k, vapour_pa, 0.0);
}

}  // namespace

thermal::AirOfDocument air_of_document(const io::Document& document,
                                       const atmosphere::WeatherSeries& weather) {
  const auto told = [&](WeatherQuantity quantity) { return !weather.knots(quantity).empty(); };
  thermal::AirOfDocument air;
  if (told(WeatherQuantity::longwave_irradiance) || !document.atmosphere.modelled) return air;
  io::ModelledAtmosphere modelled = *document.atmosphere.modelled;
  if (told(WeatherQuantity::cloud_fraction)) modelled.clouds.clear();
  if (!modelled.clouds.empty())
    air.clouds = format("there are the atmosphere's own {} layers", modelled.clouds.size());
  const atmosphere::AtmosphereColumn column =
      assemble_column(document.sources, modelled, document.scene.origin);
  air.longwave_over_prata = longwave_over_prata(column);
  return air;
}

}  // namespace ifov::session
