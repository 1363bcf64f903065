#pragma once

#include <optional>

#include "geodesy/geodetic.h"

namespace ifov::atmosphere {
class WeatherSeries;
}

namespace ifov::thermal {

/// How long after the Sun's own the noon of measured sunlight comes, s: the middle between where the global irradiance
/// rises above 5 W m-2 and where it falls below, less the middle of the Sun's time above the horizon; the median of at
/// most 30 days. A file of local time read as UTC is off by its zone. Nothing where no day has both ends.
std::optional<double> noon_offset_s(const atmosphere::WeatherSeries& weather, const geodesy::Geodetic& place);

/// Further is an error of the clock: clouds and mountains move the ends by less.
inline constexpr double kLargestNoonOffset_s = 20.0 * 60.0;

/// Throws InputError that says by how much a clock is off, and what would make noon noon.
void check_clock(const atmosphere::WeatherSeries& weather, const geodesy::Geodetic& place);

}  // namespace ifov::thermal
