#pragma once

#include <string>
#include <vector>

#include "geodesy/geodetic.h"
#include "geodesy/utc_time.h"
#include "thermal/surface_balance.h"

namespace ifov::atmosphere {
class WeatherSeries;
}

namespace ifov::thermal {

struct AirOfDocument;

/// Which times are asked for: `spin_up_s` before the day of 24 hours that ends at `end`, one row every `step_s`.
struct Span {
  geodesy::UtcTime end;
  double spin_up_s = 3.0 * 86400.0;
  double step_s = 300.0;
  /// Days before the weather begins are like its first 24 hours, the Sun's place included.
  bool repeat_first_day = false;
};
inline constexpr double kShownDay_s = 86400.0;

/// Weather at a place as surfaces meet it, and in words what stood in for what it does not tell. Times of the series are seconds since 1970.
struct OutdoorsOfWeather {
  OutdoorsSeries series;
  std::vector<std::string> notes;
};

/// Rows are means over a step about their time: air temperature, humidity (needed where long-wave is not measured; else
/// dry), wind speed and direction, pressure (else the standard atmosphere's at the place's height), sunlight, of which two of
/// direct, diffuse and global or the global alone are needed, and long-wave of the sky, or else humidity and cloud (else
/// none). Where long-wave is not told, `air` stands in before that where it does (null: it does not). Throws InputError: what is missing at which time, how far the weather reaches back and what would do; that the
/// clock is not UTC (weather_clock.h); radiation by night.
OutdoorsOfWeather outdoors_of(const atmosphere::WeatherSeries& weather, const geodesy::Geodetic& place,
                              const Span& span, const AirOfDocument* air = nullptr);

}  // namespace ifov::thermal
