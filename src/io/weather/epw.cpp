#include <cmath>

#include "core/error.h"
#include "io/weather/weather_file.h"
#include "io/weather/weather_rows.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

using Q = atmosphere::WeatherQuantity;

constexpr double kHour_s = 3600.0;

// Auxiliary EnergyPlus Programs, "EPW data dictionary": fields from 0 and their codes for missing values.
const std::vector<WeatherColumn> kColumns{
    {Q::air_temperature_k, 6, 1.0, 273.15, -90.0, 70.0, 99.9},
    {Q::dew_point_k, 7, 1.0, 273.15, -100.0, 70.0, 99.9},
    {Q::relative_humidity, 8, 0.01, 0.0, 0.0, 110.0, 999.0},
    {Q::pressure_pa, 9, 1.0, 0.0, 31000.0, 120000.0, 999999.0},
    {Q::longwave_irradiance, 12, 1.0, 0.0, 0.0, 1000.0, 9999.0},
    {Q::global_irradiance, 13, 1.0, 0.0, 0.0, 2000.0, 9999.0},
    {Q::direct_irradiance, 14, 1.0, 0.0, 0.0, 2000.0, 9999.0},
    {Q::diffuse_irradiance, 15, 1.0, 0.0, 0.0, 2000.0, 9999.0},
    {Q::wind_direction_rad, 20, math::kDegree, 0.0, 0.0, 360.0, 999.0},
    {Q::wind_speed_m_s, 21, 1.0, 0.0, 0.0, 120.0, 999.0},
    {Q::cloud_fraction, 22, 0.1, 0.0, 0.0, 10.0, 99.0},
};

struct Header {
  atmosphere::WeatherSite site;
  double zone_h = 0.0;
  int records_per_hour = 1;
  int last_line = 0;
};

Header read_header(const TextFile& file) {
  Header header;
  if (file.line_count() == 0 || !file.line(1).starts_with("LOCATION,"))
    file.fail(file.line_count() > 0 ? 1 : 0, 0, "found no line 'LOCATION,...'; expected an EPW file");
  const std::vector<Field> station = split(file.line(1), ',');
  const double latitude = weather_number(file, 1, station, 6, "a latitude (degrees)");
  const double longitude = weather_number(file, 1, station, 7, "a longitude (degrees)");
  header.zone_h = weather_number(file, 1, station, 8, "a time zone (hours)");
  if (std::abs(latitude) > 90.0 || std::abs(longitude) > 180.0 || std::abs(header.zone_h) > 14.0)
    file.fail(1, 0,
              "found no place on Earth; expected degrees of latitude and longitude and a zone in hours");
  header.site = {std::string(station[1].text), latitude * math::kDegree, longitude * math::kDegree,
                 weather_number(file, 1, station, 9, "an altitude (m)")};
  for (int number = 2; number <= file.line_count(); ++number) {
    if (!file.line(number).starts_with("DATA PERIODS,")) continue;
    const std::vector<Field> periods = split(file.line(number), ',');
    const double records = weather_number(file, number, periods, 2, "the number of records per hour");
    if (!(records >= 1.0 && records <= 60.0) || records != std::floor(records))
      file.fail(number, periods[2].column, format("found {:g} records per hour; expected 1 to 60", records));
    header.records_per_hour = static_cast<int>(records);
    header.last_line = number;
    return header;
  }
  file.fail(0, 0, "found no line 'DATA PERIODS,...'; expected it below the headings");
}

}  // namespace

atmosphere::WeatherSeries parse_epw(const TextFile& file, const WeatherOptions& options) {
  const Header header = read_header(file);
  const double interval_s = kHour_s / header.records_per_hour;
  WeatherRows rows(file, kColumns);
  for (int number = header.last_line + 1; number <= file.line_count(); ++number) {
    if (is_blank(file.line(number))) continue;
    const std::vector<Field> fields = split(file.line(number), ',');
    const auto whole = [&](std::size_t field, const char* what, int low, int high) {
      const double value = weather_number(file, number, fields, field, what);
      if (!(value >= low && value <= high) || value != std::floor(value))
        file.fail(number, fields[field].column,
                  format("found {:g}; expected {} from {} to {}", value, what, low, high));
      return static_cast<int>(value);
    };
    const int year = whole(0, "a year", 1600, 3000), month = whole(1, "a month", 1, 12);
    const int day = whole(2, "a day", 1, 31), hour = whole(3, "an hour", 1, 24),
              minute = whole(4, "a minute", 0, 60);
    // Files of one record an hour write minute 0 or 60 and mean the hour's end.
    const double of_day_s =
        header.records_per_hour == 1 ? hour * kHour_s : (hour - 1) * kHour_s + minute * 60.0;
    rows.add(
        number,
        {year, static_cast<unsigned>(month), static_cast<unsigned>(day), of_day_s, header.zone_h * kHour_s},
        fields, interval_s);
  }
  return rows.series(header.site, options.typical_year);
}

}  // namespace ifov::io
