#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "atmosphere/weather_series.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// A column of a table of weather: quantity = number * scale + offset.
struct WeatherColumn {
  atmosphere::WeatherQuantity quantity{};
  std::size_t field = 0;  ///< of a row, from 0
  double scale = 1.0, offset = 0.0;
  double lowest = 0.0, highest = 0.0;  ///< of the number in the file, where it is not missing
  double missing_from = 1e300;         ///< this number and those above it mean "missing"
  double missing_to = -1e300;          ///< this number and those below it mean "missing"
};

/// When a row was measured, in the zone of the file.
struct WeatherTime {
  int year = 0;
  unsigned month = 0, day = 0;
  double of_day_s = 0.0;  ///< may be 24 h
  double zone_s = 0.0;    ///< by which the zone is ahead of UTC
  double utc_s() const { return atmosphere::seconds_of_day(year, month, day) + of_day_s - zone_s; }
};

/// Rows of such a table on their way to a series. Irradiances are means over an interval that ends at the
/// time of their row; they are put at its middle. Small negative irradiances at night are offsets of the
/// instruments and become 0.
class WeatherRows {
 public:
  WeatherRows(const TextFile& file, std::vector<WeatherColumn> columns)
      : file_(&file), columns_(std::move(columns)) {}

  /// Throws InputError with the place for fields that are no numbers or out of range, and for days that there
  /// are not.
  void add(int line, const WeatherTime& time, std::span<const Field> fields, double interval_s);

  /// `typical_year`: as of WeatherSeries; by default where times do not rise by less than a month from row to
  /// row, as in a year made of months of several years. Then 29 February is left out.
  atmosphere::WeatherSeries series(atmosphere::WeatherSite site, std::optional<bool> typical_year) const;

 private:
  struct Value {
    std::size_t row = 0;
    double before_s = 0.0;  ///< by which the value stands before its row's time
    double value = 0.0;
  };

  const TextFile* file_;
  std::vector<WeatherColumn> columns_;
  std::vector<WeatherTime> times_;
  std::vector<int> lines_;
  std::array<std::vector<Value>, atmosphere::kWeatherQuantities> values_;
};

/// The number of a field; fails where it is none. `what` is what was expected.
double weather_number(const TextFile& file, int line, std::span<const Field> fields, std::size_t field,
                      const std::string& what);

}  // namespace ifov::io
