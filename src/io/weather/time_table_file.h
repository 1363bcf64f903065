#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace ifov::io {

class TextFile;

/// A second column that a table over time may have: value = number + offset, the number within a range.
struct TimeTableColumn {
  std::string_view heading;
  double offset, lowest, highest;
};
inline constexpr std::array<TimeTableColumn, 2> kTemperatureColumns{
    {{"temperature_c", 273.15, -273.0, 5000.0}, {"temperature_k", 0.0, 0.1, 5300.0}}};
inline constexpr std::array<TimeTableColumn, 1> kPowerColumns{{{"power_w_m2", 0.0, -1e7, 1e7}}};

/// Seconds since 1970 in rising order, one at least.
struct TimeTableRows {
  std::vector<double> time_s, value;
};

/// Comma-separated values: a heading "time" and one of `columns`, then rows of a time of ISO 8601 with its zone and
/// a number. Throws InputError with file, line and column.
TimeTableRows read_time_table(const std::filesystem::path& path, std::span<const TimeTableColumn> columns);
TimeTableRows parse_time_table(const TextFile& file, std::span<const TimeTableColumn> columns);

}  // namespace ifov::io
