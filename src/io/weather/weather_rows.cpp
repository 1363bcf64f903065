#include "io/weather/weather_rows.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::io {
namespace {

using Q = atmosphere::WeatherQuantity;

constexpr double kMonth_s = 31.0 * 86400.0;

bool is_shortwave(Q quantity) {
  return quantity == Q::global_irradiance || quantity == Q::direct_irradiance ||
         quantity == Q::diffuse_irradiance;
}

}  // namespace

double weather_number(const TextFile& file, int line, std::span<const Field> fields, std::size_t field,
                      const std::string& what) {
  if (field >= fields.size())
    file.fail(line, 0, format("found {} fields; expected {} in field {}", fields.size(), what, field + 1));
  const std::optional<double> value = number_in(fields[field].text);
  if (!value)
    file.fail(line, fields[field].column, format("found '{}'; expected {}", fields[field].text, what));
  return *value;
}

void WeatherRows::add(int line, const WeatherTime& time, std::span<const Field> fields, double interval_s) {
  if (!atmosphere::is_day(time.year, time.month, time.day))
    file_->fail(line, 0,
                format("found the day {}-{:02}-{:02}, which there is not", time.year, time.month, time.day));
  for (const WeatherColumn& column : columns_) {
    if (column.field < fields.size() && fields[column.field].text.empty()) continue;
    const std::string what = format("a number ({})", atmosphere::name_of(column.quantity));
    const double number = weather_number(*file_, line, fields, column.field, what);
    if (number >= column.missing_from || number <= column.missing_to) continue;
    if (number < column.lowest || number > column.highest)
      file_->fail(line, fields[column.field].column,
                  format("found {:g}; expected {} between {:g} and {:g}", number,
                         atmosphere::name_of(column.quantity), column.lowest, column.highest));
    const bool mean = is_shortwave(column.quantity) || column.quantity == Q::longwave_irradiance;
    double value = number * column.scale + column.offset;
    if (is_shortwave(column.quantity) || column.quantity == Q::relative_humidity)
      value = std::max(0.0, value);
    if (column.quantity == Q::relative_humidity || column.quantity == Q::cloud_fraction)
      value = std::min(1.0, value);
    values_[static_cast<std::size_t>(column.quantity)].push_back(
        {times_.size(), mean ? 0.5 * interval_s : 0.0, value});
  }
  times_.push_back(time);
  lines_.push_back(line);
}

atmosphere::WeatherSeries WeatherRows::series(atmosphere::WeatherSite site,
                                              std::optional<bool> typical_year) const {
  if (times_.empty()) file_->fail(0, 0, "found no rows of weather");
  std::size_t odd = 0;
  for (std::size_t i = 1; i < times_.size() && odd == 0; ++i) {
    const double step_s = times_[i].utc_s() - times_[i - 1].utc_s();
    if (step_s <= 0.0 || step_s > kMonth_s) odd = i;
  }
  const bool typical = typical_year.value_or(odd != 0);
  if (!typical && odd != 0)
    file_->fail(lines_[odd], 0,
                "found a time that does not follow that of the row before; expected rising times");
  atmosphere::WeatherSeries::Knots knots;
  for (std::size_t q = 0; q < atmosphere::kWeatherQuantities; ++q)
    for (const Value& value : values_[q]) {
      WeatherTime time = times_[value.row];
      if (typical && time.month == 2 && time.day == 29) continue;
      if (typical) time.year = atmosphere::WeatherSeries::kTypicalYear;
      knots[q].push_back({time.utc_s() - value.before_s, value.value});
    }
  try {
    return {std::move(site), std::move(knots), typical};
  } catch (const InputError& error) {
    file_->fail(0, 0, error.what());
  }
}

}  // namespace ifov::io
