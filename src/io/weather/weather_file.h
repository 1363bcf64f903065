#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "atmosphere/weather_series.h"
#include "io/tables/text_table.h"

namespace ifov::io {

struct WeatherOptions {
  std::optional<bool> typical_year;  ///< default: told from the file
  std::string date;  ///< "2016-01-01", for tables whose rows have an hour and a minute of UTC only
};

/// Weather from a file of any known format, told from its content: EPW, TMY3, SURFRAD or the project's own
/// table (docs/formats/weather.md). Throws InputError with the place, SystemError where it cannot be
/// read.
atmosphere::WeatherSeries read_weather(const std::filesystem::path& path, const WeatherOptions& options = {});
atmosphere::WeatherSeries parse_weather(const TextFile& file, const WeatherOptions& options = {});

/// EnergyPlus weather. Times of rows are in the station's zone; hour 1 ends at 1 h.
atmosphere::WeatherSeries parse_epw(const TextFile& file, const WeatherOptions& options = {});
/// NREL's Typical Meteorological Year 3.
atmosphere::WeatherSeries parse_tmy3(const TextFile& file, const WeatherOptions& options = {});
/// A day of NOAA's SURFRAD (.dat).
atmosphere::WeatherSeries parse_surfrad(const TextFile& file, const WeatherOptions& options = {});
/// The project's own table.
atmosphere::WeatherSeries parse_weather_csv(const TextFile& file, const WeatherOptions& options = {});

}  // namespace ifov::io
