#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/weather/weather_file.h"
#include "io/weather/weather_rows.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

using Q = atmosphere::WeatherQuantity;

constexpr double kHour_s = 3600.0;
constexpr double kMissing = -9900.0;

struct Named {
  std::string_view heading;
  WeatherColumn column;
};

// Wilcox and Marion, Users Manual for TMY3 Data Sets, NREL/TP-581-43156, table 1-3.
const std::vector<Named> kColumns{
    {"GHI (W/m^2)", {Q::global_irradiance, 0, 1.0, 0.0, 0.0, 2000.0}},
    {"DNI (W/m^2)", {Q::direct_irradiance, 0, 1.0, 0.0, 0.0, 2000.0}},
    {"DHI (W/m^2)", {Q::diffuse_irradiance, 0, 1.0, 0.0, 0.0, 2000.0}},
    {"TotCld (tenths)", {Q::cloud_fraction, 0, 0.1, 0.0, 0.0, 10.0}},
    {"Dry-bulb (C)", {Q::air_temperature_k, 0, 1.0, 273.15, -90.0, 70.0}},
    {"Dew-point (C)", {Q::dew_point_k, 0, 1.0, 273.15, -100.0, 70.0}},
    {"RHum (%)", {Q::relative_humidity, 0, 0.01, 0.0, 0.0, 110.0}},
    {"Pressure (mbar)", {Q::pressure_pa, 0, 100.0, 0.0, 310.0, 1200.0}},
    {"Wdir (degrees)", {Q::wind_direction_rad, 0, math::kDegree, 0.0, 0.0, 360.0}},
    {"Wspd (m/s)", {Q::wind_speed_m_s, 0, 1.0, 0.0, 0.0, 120.0}},
};

std::vector<WeatherColumn> columns_of(const TextFile& file) {
  const std::vector<Field> headings = split(file.line(2), ',');
  std::vector<WeatherColumn> columns;
  for (const Named& named : kColumns) {
    const auto found = std::find_if(headings.begin(), headings.end(),
                                    [&](const Field& field) { return field.text == named.heading; });
    if (found == headings.end())
      file.fail(2, 0, format("found no column '{}'; expected the headings of TMY3", named.heading));
    columns.push_back(named.column);
    columns.back().field = static_cast<std::size_t>(found - headings.begin());
    columns.back().missing_to = kMissing;
  }
  return columns;
}

/// Two or four digits at a place of a text.
int digits(std::string_view text, std::size_t first, std::size_t count) {
  int value = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    if (i >= text.size() || text[i] < '0' || text[i] > '9') return -1;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

}  // namespace

atmosphere::WeatherSeries parse_tmy3(const TextFile& file, const WeatherOptions& options) {
  if (file.line_count() < 2 || !file.line(2).starts_with("Date (MM/DD/YYYY),"))
    file.fail(file.line_count() < 2 ? 0 : 2, 0, "found no heading 'Date (MM/DD/YYYY)'; expected a TMY3 file");
  const std::vector<Field> station = split(file.line(1), ',');
  const double zone_h = weather_number(file, 1, station, 3, "a time zone (hours)");
  const double latitude = weather_number(file, 1, station, 4, "a latitude (degrees)");
  const double longitude = weather_number(file, 1, station, 5, "a longitude (degrees)");
  if (std::abs(latitude) > 90.0 || std::abs(longitude) > 180.0 || std::abs(zone_h) > 14.0)
    file.fail(1, 0,
              "found no place on Earth; expected degrees of latitude and longitude and a zone in hours");
  const atmosphere::WeatherSite site{std::string(station[1].text), latitude * math::kDegree,
                                     longitude * math::kDegree,
                                     weather_number(file, 1, station, 6, "an altitude (m)")};
  WeatherRows rows(file, columns_of(file));
  for (int number = 3; number <= file.line_count(); ++number) {
    if (is_blank(file.line(number))) continue;
    const std::vector<Field> fields = split(file.line(number), ',');
    const std::string_view date = fields[0].text;
    const int month = digits(date, 0, 2), day = digits(date, 3, 2), year = digits(date, 6, 4);
    if (date.size() != 10 || date[2] != '/' || date[5] != '/' || month < 1 || day < 1 ||
        !atmosphere::is_day(year, static_cast<unsigned>(month), static_cast<unsigned>(day)))
      file.fail(number, fields[0].column, format("found '{}'; expected a date MM/DD/YYYY", date));
    const std::string_view clock = fields.size() > 1 ? fields[1].text : std::string_view();
    const int hour = digits(clock, 0, 2), minute = digits(clock, 3, 2);
    if (clock.size() != 5 || clock[2] != ':' || hour < 0 || hour > 24 || minute < 0 || minute > 59)
      file.fail(number, fields.size() > 1 ? fields[1].column : 0,
                format("found '{}'; expected a time HH:MM from 00:00 to 24:00", clock));
    rows.add(number,
             {year, static_cast<unsigned>(month), static_cast<unsigned>(day), hour * kHour_s + minute * 60.0,
              zone_h * kHour_s},
             fields, kHour_s);
  }
  return rows.series(site, options.typical_year);
}

}  // namespace ifov::io
