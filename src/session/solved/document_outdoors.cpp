#include "session/solved/document_outdoors.h"

#include <cmath>

#include "atmosphere/weather_series.h"
#include "io/document/document.h"
#include "io/document/thermal_document.h"
#include "math/angle.h"
#include "session/assembly/shared/with_position.h"
#include "session/solved/document_air.h"

namespace ifov::session {
namespace {

using atmosphere::WeatherSeries;

thermal::Terrain terrain_named(const std::string& name) {
  int i = 0;
  while (thermal::name_of(static_cast<thermal::Terrain>(i)) != name) ++i;
  return static_cast<thermal::Terrain>(i);
}

/// Where the document stands, else where its weather was measured.
geodesy::Geodetic place_of(const io::Document& document, const WeatherSeries& weather) {
  const io::OriginDocument& origin = document.scene.origin;
  if (origin.geographic)
    return {origin.geographic->latitude_rad, origin.geographic->longitude_rad, origin.height_m};
  const atmosphere::WeatherSite& site = weather.site();
  if (site.latitude_rad && site.longitude_rad)
    return {*site.latitude_rad, *site.longitude_rad, site.altitude_m.value_or(0.0)};
  throw InputError(format(
      "{}: surface temperatures need a place, for the Sun: give the scene's \"origin\" a \"latitude\" and a \"longitude\", "
      "or weather whose file has them",
      document.sources.file_name));
}

/// The mean of the air over what the weather has.
double mean_air_k(const WeatherSeries& weather) {
  const auto& knots = weather.knots(atmosphere::WeatherQuantity::air_temperature_k);
  double sum = 0.0;
  for (const atmosphere::WeatherKnot& knot : knots) sum += knot.value;
  return sum / static_cast<double>(knots.size());
}

}  // namespace

DocumentOutdoors outdoors_of_document(const io::Document& document, const WeatherSeries& weather) {
  const geodesy::Geodetic place = place_of(document, weather);
  const io::TemperaturesDocument how =
      document.temperatures ? *document.temperatures : io::TemperaturesDocument{};
  const SourcePosition& weather_position =
      document.weather->source.file ? document.weather->source.file->position : document.weather->position;
  const thermal::AirOfDocument air = air_of_document(document, weather);
  DocumentOutdoors result;
  result.place = place;
  result.outdoors = with_position(document.sources, weather_position, [&] {
    return thermal::outdoors_of(weather, place,
                                {*document.time, how.spin_up_s, how.step_s, how.repeat_first_day}, &air);
  });
  result.outdoors.series.anemometer = {how.anemometer_m, terrain_named(how.anemometer_terrain)};
  result.terrain = terrain_named(how.terrain);
  result.mean_air_k = mean_air_k(weather);
  result.statement = format("weather: {}; Sun at {:.4f} N {:.4f} E; {:g} h of spin-up, steps of {:g} min",
                            weather.site().name, place.latitude_rad / math::kDegree,
                            place.longitude_rad / math::kDegree, how.spin_up_s / 3600.0, how.step_s / 60.0);
  return result;
}

}  // namespace ifov::session
