#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geodesy/utc_time.h"

namespace ifov::atmosphere {

enum class WeatherQuantity {
  air_temperature_k,
  dew_point_k,
  relative_humidity,  ///< of saturation over water, 0 to 1
  wind_speed_m_s,
  wind_direction_rad,   ///< that it comes from, clockwise from north
  pressure_pa,          ///< at the station
  cloud_fraction,       ///< of the sky, 0 to 1
  global_irradiance,    ///< of the Sun and the sky on a level plane, W m-2
  direct_irradiance,    ///< of the Sun across the beam, W m-2
  diffuse_irradiance,   ///< of the sky in sunlight on a level plane, W m-2
  longwave_irradiance,  ///< of the sky, thermal, on a level plane, W m-2
};
inline constexpr std::size_t kWeatherQuantities = 11;

std::string_view name_of(WeatherQuantity quantity);  ///< "air_temperature_k"

struct WeatherSite {
  std::string name;
  std::optional<double> latitude_rad, longitude_rad;  ///< longitude east positive
  std::optional<double> altitude_m;
};

/// What was measured when. Times are seconds of UTC since 1970 without leap seconds.
struct WeatherKnot {
  double time_s = 0.0, value = 0.0;
};

/// Weather over time at one place, linear between what was measured; wind direction along the shorter arc. A
/// quantity is absent where it was never measured, across gaps of more than three hours, and more than half
/// an hour before its first and after its last value. A series of one year made of several (a typical year)
/// holds for every year: times count by month, day and hour, and 29 February is 28 February.
class WeatherSeries {
 public:
  static constexpr int kTypicalYear = 2001;  ///< any year of 365 days
  static constexpr double kLongestGap_s = 3.0 * 3600.0, kHold_s = 1800.0;
  using Knots = std::array<std::vector<WeatherKnot>, kWeatherQuantities>;

  /// Knots in any order; those of a typical year have times of the year 2001. Throws InputError for a value
  /// that is no number or two values at one time.
  WeatherSeries(WeatherSite site, Knots knots, bool typical_year = false);

  /// The same at all times; what has no value is absent.
  using Values = std::array<std::optional<double>, kWeatherQuantities>;
  static WeatherSeries constant(WeatherSite site, const Values& values);

  const WeatherSite& site() const { return site_; }
  bool typical_year() const { return typical_year_; }
  bool is_constant() const { return constant_; }
  bool empty() const;
  const std::vector<WeatherKnot>& knots(WeatherQuantity quantity) const {
    return knots_[static_cast<std::size_t>(quantity)];
  }

  /// Relative humidity follows from the dew point where only that was measured, and the other way round.
  std::optional<double> at(WeatherQuantity quantity, geodesy::UtcTime time) const;

 private:
  std::optional<double> measured(WeatherQuantity quantity, double time_s) const;

  WeatherSite site_;
  Knots knots_;
  bool typical_year_ = false, constant_ = false;
};

/// Pressure of water vapour saturated over water, Pa: Magnus' form with the coefficients of Alduchov and
/// Eskridge (1996), J. Appl. Meteorol. 35, 601, eq. 21; within 0.4 % from -40 to 50 degrees Celsius.
double saturation_pressure_pa(double temperature_k);
/// Its inverse: the temperature at which vapour of this pressure is saturated.
double dew_point_k(double vapour_pressure_pa);

/// Seconds since 1970 of a day's 0 h UTC, and of an instant.
double seconds_of_day(int year, unsigned month, unsigned day);
double seconds_of(geodesy::UtcTime time);
/// Whether there is such a day.
bool is_day(int year, unsigned month, unsigned day);

}  // namespace ifov::atmosphere
