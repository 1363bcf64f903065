#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "core/names.h"
#include "io/weather/weather_file.h"
#include "io/weather/weather_rows.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

using Q = atmosphere::WeatherQuantity;

struct Named {
  std::string_view heading;
  WeatherColumn column;
};

const std::vector<Named> kColumns{
    {"air_temperature_c", {Q::air_temperature_k, 0, 1.0, 273.15, -100.0, 80.0}},
    {"air_temperature_k", {Q::air_temperature_k, 0, 1.0, 0.0, 170.0, 360.0}},
    {"dew_point_c", {Q::dew_point_k, 0, 1.0, 273.15, -120.0, 80.0}},
    {"dew_point_k", {Q::dew_point_k, 0, 1.0, 0.0, 150.0, 360.0}},
    {"relative_humidity_pct", {Q::relative_humidity, 0, 0.01, 0.0, -5.0, 110.0}},
    {"wind_speed_m_s", {Q::wind_speed_m_s, 0, 1.0, 0.0, 0.0, 120.0}},
    {"wind_direction_deg", {Q::wind_direction_rad, 0, math::kDegree, 0.0, 0.0, 360.0}},
    {"pressure_hpa", {Q::pressure_pa, 0, 100.0, 0.0, 100.0, 1200.0}},
    {"pressure_pa", {Q::pressure_pa, 0, 1.0, 0.0, 10000.0, 120000.0}},
    {"cloud_fraction", {Q::cloud_fraction, 0, 1.0, 0.0, 0.0, 1.0}},
    {"global_irradiance_w_m2", {Q::global_irradiance, 0, 1.0, 0.0, -50.0, 2000.0}},
    {"shortwave_down_w_m2", {Q::global_irradiance, 0, 1.0, 0.0, -50.0, 2000.0}},
    {"direct_irradiance_w_m2", {Q::direct_irradiance, 0, 1.0, 0.0, -50.0, 2000.0}},
    {"diffuse_irradiance_w_m2", {Q::diffuse_irradiance, 0, 1.0, 0.0, -50.0, 2000.0}},
    {"longwave_down_w_m2", {Q::longwave_irradiance, 0, 1.0, 0.0, 0.0, 1000.0}},
};

struct Heading {
  int line = 0;
  std::size_t width = 0;
  bool clock = false;  ///< hour_utc and minute_utc instead of time
  std::vector<WeatherColumn> columns;
};

Heading read_heading(const TextFile& file) {
  Heading heading;
  heading.line = 1;
  while (heading.line <= file.line_count() &&
         (is_blank(file.line(heading.line)) || is_comment(file.line(heading.line))))
    ++heading.line;
  if (heading.line > file.line_count()) file.fail(0, 0, "found an empty file; expected a table of weather");
  const std::vector<Field> fields = split(file.line(heading.line), ',');
  heading.width = fields.size();
  heading.clock = fields[0].text == "hour_utc" && fields.size() > 1 && fields[1].text == "minute_utc";
  if (fields[0].text != "time" && !heading.clock)
    file.fail(
        heading.line, fields[0].column,
        format("found the heading '{}'; expected 'time', or 'hour_utc' and 'minute_utc'", fields[0].text));
  std::vector<std::string> choices;
  for (const Named& named : kColumns) choices.emplace_back(named.heading);
  for (std::size_t i = heading.clock ? 2 : 1; i < fields.size(); ++i) {
    if (fields[i].text == "shortwave_up_w_m2")
      continue;  // tells of the ground below the mast, not of the weather
    const auto found = std::find_if(kColumns.begin(), kColumns.end(),
                                    [&](const Named& named) { return named.heading == fields[i].text; });
    if (found == kColumns.end())
      file.fail(heading.line, fields[i].column,
                format("found the heading '{}'; expected {}{}", fields[i].text, list_names(choices),
                       did_you_mean(fields[i].text, choices)));
    for (const WeatherColumn& other : heading.columns)
      if (other.quantity == found->column.quantity)
        file.fail(heading.line, fields[i].column,
                  format("found {} in two columns; expected one", atmosphere::name_of(other.quantity)));
    heading.columns.push_back(found->column);
    heading.columns.back().field = i;
  }
  if (heading.columns.empty()) file.fail(heading.line, 0, "found no column of weather beside the time");
  return heading;
}

double clock_time(const TextFile& file, int number, const std::vector<Field>& fields, double day_s) {
  const double hour = weather_number(file, number, fields, 0, "an hour of UTC");
  const double minute = weather_number(file, number, fields, 1, "a minute");
  if (!(hour >= 0.0 && hour <= 24.0) || !(minute >= 0.0 && minute < 60.0))
    file.fail(number, fields[0].column,
              format("found {:g} h {:g} min; expected a time of day", hour, minute));
  return day_s + 3600.0 * hour + 60.0 * minute;
}

WeatherTime utc_time(double time_s) {
  using namespace std::chrono;
  const double day = std::floor(time_s / 86400.0);
  const year_month_day date{sys_days{days{static_cast<int>(day)}}};
  return {static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
          static_cast<unsigned>(date.day()), time_s - 86400.0 * day, 0.0};
}

double iso_time(const TextFile& file, int number, const Field& field) {
  try {
    return atmosphere::seconds_of(geodesy::parse_utc(field.text));
  } catch (const InputError& error) {
    file.fail(number, field.column, error.what());
  }
}

}  // namespace

atmosphere::WeatherSeries parse_weather_csv(const TextFile& file, const WeatherOptions& options) {
  const Heading heading = read_heading(file);
  double day_s = 0.0;
  if (heading.clock) {
    if (options.date.empty())
      file.fail(heading.line, 0,
                "found times of day without a date; expected a column 'time', or a date given with "
                "the file");
    day_s = atmosphere::seconds_of(geodesy::parse_utc(options.date));
  }
  WeatherRows rows(file, heading.columns);
  for (int number = heading.line + 1; number <= file.line_count(); ++number) {
    if (is_blank(file.line(number)) || is_comment(file.line(number))) continue;
    const std::vector<Field> fields = split(file.line(number), ',');
    if (fields.size() != heading.width)
      file.fail(number, 0,
                format("found {} columns; expected {}, as in the heading", fields.size(), heading.width));
    const double time_s =
        heading.clock ? clock_time(file, number, fields, day_s) : iso_time(file, number, fields[0]);
    rows.add(number, utc_time(time_s), fields, 0.0);
  }
  return rows.series({file.name(), {}, {}, {}}, options.typical_year.value_or(false));
}

}  // namespace ifov::io
