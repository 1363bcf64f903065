#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"
#include "io/document/weather_document.h"

namespace ifov::io {

SchemaType<WeatherDocument> weather_type() {
  Record<WeatherDocument> record(
      "weather",
      "Air at the ground, from a file or the same at all times. It changes nothing of the 'atmosphere'.");
  const auto source = [](auto member) { return path(&WeatherDocument::source, member); };
  record.exactly_one()
      .one("file", source(&WeatherFileDocument::file), file(), "EPW, TMY3, SURFRAD or a table")
      .one("air_temperature", &WeatherDocument::air_temperature_k,
           quantity(kTemperature, Range::above(0.0, "K")), "near the ground")
      .optional("date", source(&WeatherFileDocument::date),
                text_like("^[0-9]{4}-[0-9]{2}-[0-9]{2}$", "a date such as \"2016-01-01\"", "date"),
                "of a table whose rows have a time of day alone")
      .optional("typical_year", source(&WeatherFileDocument::typical_year), boolean(),
                "whether the file holds for every year; without it the file tells")
      .optional("humidity", &WeatherDocument::relative_humidity,
                quantity(kPercent, Range::between(0.0, 100.0, "%")), "relative, over liquid water")
      .optional("wind_speed", &WeatherDocument::wind_speed_m_s, quantity(kSpeed, Range::at_least(0.0, "m/s")),
                "at the height of the station's anemometer")
      .optional("wind_direction", &WeatherDocument::wind_direction_rad,
                quantity(kAngle, Range::between(0.0, 360.0, "deg")),
                "that the wind comes from, clockwise from north")
      .optional("pressure", &WeatherDocument::pressure_hpa, quantity(kPressure, Range::above(0.0, "hPa")),
                "at the ground")
      .optional("cloud", &WeatherDocument::cloud_fraction, fraction(Range::between(0.0, 1.0)),
                "share of the sky");
  for (const char* key : {"date", "typical_year"}) record.needs(key, "file");
  for (const char* key : {"humidity", "wind_speed", "wind_direction", "pressure", "cloud"})
    record.needs(key, "air_temperature");
  return record.type();
}

}  // namespace ifov::io
