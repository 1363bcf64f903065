#include "atmosphere/weather_series.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::atmosphere {
namespace {

constexpr double kYear_s = 365.0 * 86400.0;

constexpr std::array<std::string_view, kWeatherQuantities> kNames{
    "air_temperature_k",  "dew_point_k",        "relative_humidity",  "wind_speed_m_s",
    "wind_direction_rad", "pressure_pa",        "cloud_fraction",     "global_irradiance",
    "direct_irradiance",  "diffuse_irradiance", "longwave_irradiance"};

double year_begin_s() { return seconds_of_day(WeatherSeries::kTypicalYear, 1, 1); }

/// Seconds since the year's begin, in a year of 365 days.
double time_of_year(double time_s) {
  using namespace std::chrono;
  const double day = std::floor(time_s / 86400.0);
  const year_month_day date{sys_days{days{static_cast<int>(day)}}};
  unsigned in_month = static_cast<unsigned>(date.day());
  if (date.month() == February && in_month == 29) in_month = 28;
  return seconds_of_day(WeatherSeries::kTypicalYear, static_cast<unsigned>(date.month()), in_month) -
         year_begin_s() + (time_s - 86400.0 * day);
}

double between(WeatherQuantity quantity, const WeatherKnot& before, const WeatherKnot& after, double time_s) {
  const double fraction = (time_s - before.time_s) / (after.time_s - before.time_s);
  if (quantity != WeatherQuantity::wind_direction_rad)
    return before.value + fraction * (after.value - before.value);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double angle = before.value + fraction * std::remainder(after.value - before.value, kTurn);
  return angle - kTurn * std::floor(angle / kTurn);
}

}  // namespace

std::string_view name_of(WeatherQuantity quantity) { return kNames[static_cast<std::size_t>(quantity)]; }

WeatherSeries::WeatherSeries(WeatherSite site, Knots knots, bool typical_year)
    : site_(std::move(site)), knots_(std::move(knots)), typical_year_(typical_year) {
  for (std::size_t q = 0; q < kWeatherQuantities; ++q) {
    std::vector<WeatherKnot>& list = knots_[q];
    for (WeatherKnot& knot : list) {
      if (!std::isfinite(knot.value) || !(std::abs(knot.time_s) < 1e11))
        throw InputError(format("{}: found a {} that is no number", site_.name, kNames[q]));
      if (typical_year_) {
        const double since_s = knot.time_s - year_begin_s();
        knot.time_s = since_s - kYear_s * std::floor(since_s / kYear_s);
      }
    }
    std::sort(list.begin(), list.end(),
              [](const WeatherKnot& a, const WeatherKnot& b) { return a.time_s < b.time_s; });
    for (std::size_t i = 1; i < list.size(); ++i)
      if (list[i].time_s == list[i - 1].time_s)
        throw InputError(format("{}: found two values of {} at one time", site_.name, kNames[q]));
  }
}

WeatherSeries WeatherSeries::constant(WeatherSite site, const Values& values) {
  Knots knots;
  for (std::size_t q = 0; q < kWeatherQuantities; ++q)
    if (values[q]) knots[q].push_back({0.0, *values[q]});
  WeatherSeries series(std::move(site), std::move(knots));
  series.constant_ = true;
  return series;
}

bool WeatherSeries::empty() const {
  return std::all_of(knots_.begin(), knots_.end(), [](const auto& list) { return list.empty(); });
}

std::optional<double> WeatherSeries::measured(WeatherQuantity quantity, double time_s) const {
  const std::vector<WeatherKnot>& list = knots(quantity);
  if (list.empty()) return std::nullopt;
  if (constant_) return list.front().value;
  const double when = typical_year_ ? time_of_year(time_s) : time_s;
  const auto next = std::lower_bound(list.begin(), list.end(), when,
                                     [](const WeatherKnot& knot, double t) { return knot.time_s < t; });
  WeatherKnot before, after;
  const bool first = next == list.begin(), last = next == list.end();
  if (!last && next->time_s == when) return next->value;
  if (typical_year_ && (first || last)) {  // across the turn of the year
    before = {list.back().time_s - (first ? kYear_s : 0.0), list.back().value};
    after = {list.front().time_s + (last ? kYear_s : 0.0), list.front().value};
  } else if (first || last) {
    const WeatherKnot& end = first ? list.front() : list.back();
    if (std::abs(end.time_s - when) > kHold_s) return std::nullopt;
    return end.value;
  } else {
    before = *(next - 1);
    after = *next;
  }
  if (after.time_s - before.time_s > kLongestGap_s) return std::nullopt;
  return between(quantity, before, after, when);
}

std::optional<double> WeatherSeries::at(WeatherQuantity quantity, geodesy::UtcTime time) const {
  const double time_s = seconds_of(time);
  const std::optional<double> value = measured(quantity, time_s);
  if (value || (quantity != WeatherQuantity::relative_humidity && quantity != WeatherQuantity::dew_point_k))
    return value;
  const std::optional<double> air = measured(WeatherQuantity::air_temperature_k, time_s);
  const std::optional<double> other =
      measured(quantity == WeatherQuantity::dew_point_k ? WeatherQuantity::relative_humidity
                                                        : WeatherQuantity::dew_point_k,
               time_s);
  if (!air || !other) return std::nullopt;
  if (quantity == WeatherQuantity::relative_humidity)
    return std::min(1.0, saturation_pressure_pa(*other) / saturation_pressure_pa(*air));
  if (!(*other > 0.0)) return std::nullopt;
  return ifov::atmosphere::dew_point_k(*other * saturation_pressure_pa(*air));
}

double saturation_pressure_pa(double temperature_k) {
  const double celsius = temperature_k - 273.15;
  constexpr double kNone_c = -200.0;  // the formula has a pole at -243.04
  if (celsius < kNone_c) return 0.0;
  return 610.94 * std::exp(17.625 * celsius / (celsius + 243.04));
}

double dew_point_k(double vapour_pressure_pa) {
  const double log_ratio = std::log(vapour_pressure_pa / 610.94);
  return 273.15 + 243.04 * log_ratio / (17.625 - log_ratio);
}

bool is_day(int year, unsigned month, unsigned day) {
  return year >= 1600 && year <= 3000 &&
         std::chrono::year_month_day{std::chrono::year(year), std::chrono::month(month),
                                     std::chrono::day(day)}
             .ok();
}

double seconds_of_day(int year, unsigned month, unsigned day) {
  using namespace std::chrono;
  const sys_days date = std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(day);
  return 86400.0 * static_cast<double>(date.time_since_epoch().count());
}

double seconds_of(geodesy::UtcTime time) { return 86400.0 * ((time.jd1 - 2440587.5) + time.jd2); }

}  // namespace ifov::atmosphere
