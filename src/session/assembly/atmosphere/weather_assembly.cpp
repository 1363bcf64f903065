#include "session/assembly/atmosphere/weather_assembly.h"

#include <numbers>
#include <utility>

#include "atmosphere/weather_series.h"
#include "core/format.h"
#include "io/document/weather_document.h"
#include "io/weather/weather_file.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using atmosphere::WeatherQuantity;

constexpr double kFreezing_k = 273.15;

atmosphere::WeatherSeries inline_weather(const io::WeatherDocument& weather) {
  atmosphere::WeatherSeries::Values values;
  const auto set = [&](WeatherQuantity quantity, std::optional<double> value) {
    values[static_cast<std::size_t>(quantity)] = value;
  };
  set(WeatherQuantity::air_temperature_k, weather.air_temperature_k);
  set(WeatherQuantity::relative_humidity, weather.relative_humidity);
  set(WeatherQuantity::wind_speed_m_s, weather.wind_speed_m_s);
  set(WeatherQuantity::wind_direction_rad, weather.wind_direction_rad);
  if (weather.pressure_hpa) set(WeatherQuantity::pressure_pa, 100.0 * *weather.pressure_hpa);
  set(WeatherQuantity::cloud_fraction, weather.cloud_fraction);
  return atmosphere::WeatherSeries::constant({"the document", {}, {}, {}}, values);
}

/// From the first to the last value of air temperature; years of a typical year say nothing.
std::string span_of(const atmosphere::WeatherSeries& weather) {
  const auto& knots = weather.knots(WeatherQuantity::air_temperature_k);
  if (knots.empty()) return "it has no air temperature at all";
  const auto at = [](double time_s) { return geodesy::format_utc({2440587.5, time_s / 86400.0}); };
  return format("its values go from {} to {}", at(knots.front().time_s), at(knots.back().time_s));
}

}  // namespace

std::shared_ptr<const atmosphere::WeatherSeries> assemble_weather(
    const io::DocumentSources& sources, const io::WeatherDocument& weather,
    const std::optional<geodesy::UtcTime>& time) {
  using Weather = atmosphere::WeatherSeries;
  if (!weather.source.file) return std::make_shared<const Weather>(inline_weather(weather));
  const io::DocumentFile& file = *weather.source.file;
  return with_position(sources, file.position, [&] {
    io::WeatherOptions options;
    options.date = weather.source.date;
    options.typical_year = weather.source.typical_year;
    atmosphere::WeatherSeries series = io::read_weather(file.path, options);
    if (time && !series.at(WeatherQuantity::air_temperature_k, *time))
      throw InputError(format("'{}' does not tell the air temperature at {}; {}", file.path,
                              geodesy::format_utc(*time), span_of(series)));
    return std::make_shared<const Weather>(std::move(series));
  });
}

std::string weather_statement(const std::optional<geodesy::UtcTime>& document_time,
                              const atmosphere::WeatherSeries& weather) {
  if (!document_time && !weather.is_constant())
    return format("weather: {}; the document has no 'time' to look it up", weather.site().name);
  const geodesy::UtcTime time = document_time.value_or(geodesy::UtcTime{});
  const auto known = [&](WeatherQuantity quantity, double factor, double offset, std::string_view unit,
                         int digits) {
    const std::optional<double> value = weather.at(quantity, time);
    return value ? format("{:.{}f} {}", factor * *value + offset, digits, unit) : std::string("unknown");
  };
  std::string text = format("weather: air {}, humidity {}, wind {}",
                            known(WeatherQuantity::air_temperature_k, 1.0, -kFreezing_k, "degC", 1),
                            known(WeatherQuantity::relative_humidity, 100.0, 0.0, "%", 0),
                            known(WeatherQuantity::wind_speed_m_s, 1.0, 0.0, "m/s", 1));
  if (weather.at(WeatherQuantity::wind_direction_rad, time))
    text += " from " + known(WeatherQuantity::wind_direction_rad, 180.0 / std::numbers::pi, 0.0, "deg", 0);
  if (weather.at(WeatherQuantity::pressure_pa, time))
    text += ", pressure " + known(WeatherQuantity::pressure_pa, 0.01, 0.0, "hPa", 0);
  if (weather.at(WeatherQuantity::cloud_fraction, time))
    text += ", cloud " + known(WeatherQuantity::cloud_fraction, 100.0, 0.0, "%", 0);
  if (weather.is_constant()) return text + " (at all times)";
  return text + format(" at {} ({}{})", geodesy::format_utc(time), weather.site().name,
                       weather.typical_year() ? ", typical year" : "");
}

}  // namespace ifov::session
