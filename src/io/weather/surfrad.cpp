#include <cmath>

#include "core/error.h"
#include "io/weather/weather_file.h"
#include "io/weather/weather_rows.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

using Q = atmosphere::WeatherQuantity;

constexpr double kMissing = -9999.0;
constexpr std::size_t kFirstValue = 8, kFields = 48;
constexpr double kNightOffset = -50.0;  // of thermopiles; stations flag those below -30

// NOAA's description of SURFRAD daily data files: fields from 0; each value is followed by a flag of quality.
const std::vector<WeatherColumn> kColumns{
    {Q::global_irradiance, 8, 1.0, 0.0, kNightOffset, 2000.0, 1e300, kMissing},
    {Q::direct_irradiance, 12, 1.0, 0.0, kNightOffset, 2000.0, 1e300, kMissing},
    {Q::diffuse_irradiance, 14, 1.0, 0.0, kNightOffset, 2000.0, 1e300, kMissing},
    {Q::longwave_irradiance, 16, 1.0, 0.0, 0.0, 1000.0, 1e300, kMissing},
    {Q::air_temperature_k, 38, 1.0, 273.15, -90.0, 70.0, 1e300, kMissing},
    {Q::relative_humidity, 40, 0.01, 0.0, -5.0, 110.0, 1e300, kMissing},
    {Q::wind_speed_m_s, 42, 1.0, 0.0, 0.0, 120.0, 1e300, kMissing},
    {Q::wind_direction_rad, 44, math::kDegree, 0.0, 0.0, 360.0, 1e300, kMissing},
    {Q::pressure_pa, 46, 100.0, 0.0, 310.0, 1200.0, 1e300, kMissing},
};

}  // namespace

atmosphere::WeatherSeries parse_surfrad(const TextFile& file, const WeatherOptions& options) {
  if (file.line_count() < 3)
    file.fail(0, 0, "found less than 3 lines; expected a daily file of SURFRAD (.dat)");
  const std::vector<Field> station = split(file.line(2), ' ');
  const double latitude = weather_number(file, 2, station, 0, "a latitude (degrees)");
  const double longitude = weather_number(file, 2, station, 1, "a longitude (degrees)");
  if (std::abs(latitude) > 90.0 || std::abs(longitude) > 180.0)
    file.fail(2, 0, "found no place on Earth; expected degrees of latitude and longitude");
  const std::vector<Field> words = split(file.line(1), ',');
  // All stations are in the United States; some files write their western longitudes without a sign.
  const atmosphere::WeatherSite site{words.empty() ? std::string() : std::string(words[0].text),
                                     latitude * math::kDegree, -std::abs(longitude) * math::kDegree,
                                     weather_number(file, 2, station, 2, "an altitude (m)")};
  WeatherRows rows(file, kColumns);
  for (int number = 3; number <= file.line_count(); ++number) {
    if (is_blank(file.line(number))) continue;
    std::vector<Field> fields = split(file.line(number), ' ');
    if (fields.size() != kFields)
      file.fail(number, 0,
                format("found {} fields; expected {} of a daily file of SURFRAD", fields.size(), kFields));
    const auto whole = [&](std::size_t field, const char* what, int low, int high) {
      const double value = weather_number(file, number, fields, field, what);
      if (!(value >= low && value <= high) || value != std::floor(value))
        file.fail(number, fields[field].column,
                  format("found {:g}; expected {} from {} to {}", value, what, low, high));
      return static_cast<int>(value);
    };
    const int year = whole(0, "a year", 1990, 3000), month = whole(2, "a month", 1, 12),
              day = whole(3, "a day", 1, 31);
    const int hour = whole(4, "an hour", 0, 23), minute = whole(5, "a minute", 0, 59);
    // A flag of 1 says that the value is bad; higher ones that it is to be used with care.
    for (std::size_t value = kFirstValue; value + 1 < kFields; value += 2)
      if (weather_number(file, number, fields, value + 1, "a flag of quality") == 1.0)
        fields[value].text = {};
    // One-minute means since 2009, three-minute means before, at the ends of their intervals.
    rows.add(
        number,
        {year, static_cast<unsigned>(month), static_cast<unsigned>(day), 3600.0 * hour + 60.0 * minute, 0.0},
        fields, year >= 2009 ? 60.0 : 180.0);
  }
  return rows.series(site, options.typical_year.value_or(false));
}

}  // namespace ifov::io
