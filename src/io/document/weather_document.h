#pragma once

#include <optional>
#include <string>

#include "io/document/document_values.h"

namespace ifov::io {

/// Weather at the scene over time, from a file (EPW, TMY3, SURFRAD, table).
struct WeatherFileDocument {
  std::optional<DocumentFile> file;
  std::string date;                  ///< of rows that have a time of day alone
  std::optional<bool> typical_year;  ///< absent: told from the file
};

/// From a file, or the same at all times.
struct WeatherDocument {
  WeatherFileDocument source;
  std::optional<double> air_temperature_k, relative_humidity, wind_speed_m_s, wind_direction_rad,
      pressure_hpa, cloud_fraction;
  SourcePosition position;
};

}  // namespace ifov::io
