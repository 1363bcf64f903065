#include "thermal/outdoors_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "thermal/air_of_document.h"
#include "thermal/faces/sky_longwave.h"
#include "thermal/sun_path.h"
#include "thermal/sun_split.h"
#include "thermal/weather_clock.h"

namespace ifov::thermal {
namespace {

using atmosphere::WeatherQuantity;
using atmosphere::WeatherSeries;

constexpr double kWeatherDay_s = 86400.0;
constexpr double kDarkest_rad = -6.0 * std::numbers::pi / 180.0, kNightLight_w_m2 = 10.0;
constexpr int kParts = 5;  // of a step, for its means
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

geodesy::UtcTime instant(double time_s) { return {2440587.5, time_s / kWeatherDay_s}; }
std::string clock_text(double time_s) { return geodesy::format_utc(instant(std::round(time_s))); }

/// Pressure of the U.S. Standard Atmosphere 1976 in its lowest layer.
double standard_pressure_pa(double height_m) {
  return 101325.0 * std::pow(1.0 - 2.25577e-5 * std::clamp(height_m, -500.0, 11000.0), 5.25588);
}

class Sampler {
 public:
  Sampler(const WeatherSeries& weather, const geodesy::Geodetic& place, const Span& span,
          const AirOfDocument* air)
      : weather_(weather),
        air_(air),
        place_(place),
        span_(span),
        // Days before the weather are like its first 24 hours, which may end later.
        sun_(begin_s(), end_s() + (span.repeat_first_day ? kWeatherDay_s : 0.0), place) {
    const auto& knots = weather.knots(WeatherQuantity::air_temperature_k);
    bounded_ = !weather.is_constant() && !weather.typical_year() && !knots.empty();
    if (!bounded_) return;
    first_s_ = knots.front().time_s;
    last_s_ = std::min(knots.back().time_s, first_s_ + kWeatherDay_s);
  }

  bool has(WeatherQuantity quantity) const {
    return !weather_.knots(quantity).empty() || (quantity == WeatherQuantity::relative_humidity &&
                                                 !weather_.knots(WeatherQuantity::dew_point_k).empty());
  }

  /// The time whose weather stands for a time.
  double looked_up_s(double time_s) const {
    if (!bounded_ || !span_.repeat_first_day || time_s >= first_s_) return time_s;
    return time_s + std::ceil((first_s_ - time_s) / kWeatherDay_s) * kWeatherDay_s;
  }

  /// Mean over the step about a time; wind direction at the time itself.
  std::optional<double> mean(WeatherQuantity quantity, double time_s) const {
    if (quantity == WeatherQuantity::wind_direction_rad) return at_part(quantity, time_s);
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < kParts; ++i) {
      const double part_s = time_s + ((i + 0.5) / kParts - 0.5) * span_.step_s;
      if (const std::optional<double> value = at_part(quantity, part_s)) {
        sum += *value;
        ++count;
      }
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
  }

  double needed(WeatherQuantity quantity, double time_s) const {
    if (const std::optional<double> value = mean(quantity, time_s)) return *value;
    if (!has(quantity))
      throw InputError(format("'{}' does not tell {}, which surface temperatures need", weather_.site().name,
                              name_of(quantity)));
    const double back_s = end_s() - kShownDay_s - first_s_;
    std::string hint;
    if (bounded_ && time_s < first_s_ && span_.repeat_first_day)
      hint = "; its first 24 hours, which stand for the days before, are not whole";
    else if (bounded_ && time_s < first_s_)
      hint = back_s > 0.0
                 ? format(
                       "; it reaches back {:.1f} h before the day shown: a \"spin_up\" of \"{:.0f} h\" or "
                       "\"repeat_first_day\": true would do",
                       back_s / 3600.0, std::floor(back_s / 3600.0))
                 : std::string("; \"repeat_first_day\": true takes its first 24 hours for the days before");
    throw InputError(format("'{}' does not tell {} at {}, which is needed from {} to {}{}",
                            weather_.site().name, name_of(quantity), clock_text(time_s),
                            clock_text(begin_s()), clock_text(end_s()), hint));
  }

  double end_s() const { return atmosphere::seconds_of(span_.end); }
  /// Whole steps back.
  double begin_s() const {
    return end_s() - span_.step_s * std::round((kShownDay_s + span_.spin_up_s) / span_.step_s);
  }

  Outdoors at(double time_s) const {
    const SunPath::Place sun = sun_.at(looked_up_s(time_s));
    Outdoors now;
    now.sun_azimuth_rad = sun.azimuth_rad;
    now.sun_elevation_rad = sun.elevation_rad;
    now.air.temperature_k = needed(WeatherQuantity::air_temperature_k, time_s);
    now.air.vapour_pa = mean(WeatherQuantity::relative_humidity, time_s).value_or(0.0) *
                        atmosphere::saturation_pressure_pa(now.air.temperature_k);
    now.air.pressure_pa =
        mean(WeatherQuantity::pressure_pa, time_s).value_or(standard_pressure_pa(place_.height_m));
    now.wind_m_s = std::max(0.0, needed(WeatherQuantity::wind_speed_m_s, time_s));
    now.wind_from_rad = mean(WeatherQuantity::wind_direction_rad, time_s).value_or(kUnknown);
    sunlight(now, sun, time_s);
    longwave(now, time_s);
    return now;
  }

 private:
  /// A day told hour by hour ends an hour before it begins again.
  std::optional<double> at_part(WeatherQuantity quantity, double time_s) const {
    const double day_s = looked_up_s(time_s);
    if (day_s == time_s || day_s <= last_s_ || quantity == WeatherQuantity::wind_direction_rad)
      return weather_.at(quantity, instant(day_s));
    const double gap_s = first_s_ + kWeatherDay_s - last_s_;
    const std::optional<double> evening = weather_.at(quantity, instant(last_s_)),
                                morning = weather_.at(quantity, instant(first_s_));
    if (gap_s > WeatherSeries::kLongestGap_s || !evening || !morning) return std::nullopt;
    return std::lerp(*evening, *morning, (day_s - last_s_) / gap_s);
  }

  void sunlight(Outdoors& now, const SunPath::Place& sun, double time_s) const {
    const double height = std::sin(sun.elevation_rad);
    const bool direct = has(WeatherQuantity::direct_irradiance),
               diffuse = has(WeatherQuantity::diffuse_irradiance);
    SunAndSky split;
    if (direct && diffuse) {
      split = {needed(WeatherQuantity::direct_irradiance, time_s),
               needed(WeatherQuantity::diffuse_irradiance, time_s)};
    } else {
      const double global = needed(WeatherQuantity::global_irradiance, time_s);
      split = split_global(global, sun.elevation_rad, sun.distance_au);
      if (direct) {
        split.direct_w_m2 = needed(WeatherQuantity::direct_irradiance, time_s);
        split.diffuse_w_m2 = std::max(0.0, global - split.direct_w_m2 * std::max(0.0, height));
      } else if (diffuse && height > 0.05) {
        split.diffuse_w_m2 = std::min(global, needed(WeatherQuantity::diffuse_irradiance, time_s));
        split.direct_w_m2 = (global - split.diffuse_w_m2) / height;
      }
    }
    now.direct_w_m2 = std::max(0.0, split.direct_w_m2);
    now.diffuse_w_m2 = std::max(0.0, split.diffuse_w_m2);
    if (sun.elevation_rad < kDarkest_rad && now.direct_w_m2 + now.diffuse_w_m2 > kNightLight_w_m2 &&
        !is_beside_light(time_s))
      throw InputError(format(
          "'{}' has sunlight of {:.0f} W m-2 at {}, while the Sun is {:.0f} degrees below the horizon; "
          "expected at most {:.0f}",
          weather_.site().name, now.direct_w_m2 + now.diffuse_w_m2, clock_text(time_s),
          -sun.elevation_rad * 180.0 / std::numbers::pi, kNightLight_w_m2));
  }

  /// Whether the file has a time just before or after at which the Sun was not so low: where it sinks fast, an hour has all of dusk in it.
  bool is_beside_light(double time_s) const {
    const auto& knots = weather_.knots(WeatherQuantity::global_irradiance);
    if (!bounded_ || knots.empty()) return false;
    const double day_s = looked_up_s(time_s);
    const auto after =
        std::upper_bound(knots.begin(), knots.end(), day_s,
                         [](double t, const atmosphere::WeatherKnot& k) { return t < k.time_s; });
    const auto is_light = [&](const atmosphere::WeatherKnot& knot) {
      return knot.value > 0.0 && std::abs(knot.time_s - day_s) < kAnHour_s &&
             sun_.at(std::max(knot.time_s, begin_s())).elevation_rad >= kDarkest_rad;
    };
    return (after != knots.end() && is_light(*after)) || (after != knots.begin() && is_light(*(after - 1)));
  }

  void longwave(Outdoors& now, double time_s) const {
    if (const std::optional<double> measured = mean(WeatherQuantity::longwave_irradiance, time_s)) {
      now.longwave_w_m2 = *measured;
      return;
    }
    const double humidity = needed(WeatherQuantity::relative_humidity, time_s);
    const double air_k = now.air.temperature_k;
    const double by_prata = clear_sky_emissivity(air_k, humidity * atmosphere::saturation_pressure_pa(air_k));
    const double over_prata = air_ != nullptr ? air_->longwave_over_prata.value_or(1.0) : 1.0;
    now.longwave_w_m2 = sky_emissivity(std::min(1.0, over_prata * by_prata), cloud_fraction(time_s)) *
                        kStefanBoltzmann_w_m2_k4 * air_k * air_k * air_k * air_k;
  }

  double cloud_fraction(double time_s) const {
    return std::clamp(mean(WeatherQuantity::cloud_fraction, time_s).value_or(0.0), 0.0, 1.0);
  }

  const WeatherSeries& weather_;
  const AirOfDocument* air_;
  const geodesy::Geodetic& place_;
  const Span& span_;
  SunPath sun_;
  bool bounded_ = false;
  static constexpr double kAnHour_s = 3600.0;
  double first_s_ = 0.0, last_s_ = 0.0;  // of what stands for the days before
};

std::vector<std::string> notes_of(const Sampler& weather, const WeatherSeries& series, const Span& span,
                                  const AirOfDocument* air) {
  std::vector<std::string> notes;
  const bool direct = weather.has(WeatherQuantity::direct_irradiance),
             diffuse = weather.has(WeatherQuantity::diffuse_irradiance);
  const bool cloud = weather.has(WeatherQuantity::cloud_fraction);
  const std::string clear = air == nullptr || air->clouds.empty()
                                ? "; no cloud is told, so the sky is taken to be clear"
                                : format("; no cloud is told but {}", air->clouds);
  if (!direct && !diffuse)
    notes.push_back("direct and diffuse sunlight: from the global, by Erbs et al. (1982)");
  if (weather.has(WeatherQuantity::longwave_irradiance))
    notes.push_back("long-wave of the sky: measured");
  else if (air != nullptr && air->longwave_over_prata)
    notes.push_back(format(
        "long-wave of the sky: by the document's atmosphere, {:.3f} of Prata (1996) at its own ground, as it "
        "changes with the air by Prata{}",
        *air->longwave_over_prata, cloud ? ", cloud by Crawford and Duchon (1999)" : clear));
  else
    notes.push_back(format("long-wave of the sky: by Prata (1996){}",
                           cloud ? ", cloud by Crawford and Duchon (1999)" : clear));
  if (!weather.has(WeatherQuantity::pressure_pa))
    notes.push_back("air pressure: of the standard atmosphere at the place's height");
  if (!weather.has(WeatherQuantity::relative_humidity))
    notes.push_back("humidity is not told: the air is taken to be dry");
  if (!weather.has(WeatherQuantity::wind_direction_rad))
    notes.push_back("wind direction is not told: what slopes meets the wind as on average of all directions");
  const auto& knots = series.knots(WeatherQuantity::air_temperature_k);
  if (span.repeat_first_day && !knots.empty() && weather.looked_up_s(weather.begin_s()) > weather.begin_s())
    notes.push_back(
        format("days before {} are like the 24 hours from then on", clock_text(knots.front().time_s)));
  return notes;
}

}  // namespace

OutdoorsOfWeather outdoors_of(const WeatherSeries& weather, const geodesy::Geodetic& place, const Span& span,
                              const AirOfDocument* air) {
  const Sampler sampler(weather, place, span, air);
  check_clock(weather, place);
  OutdoorsOfWeather result;
  result.series.begin_s = sampler.begin_s();
  result.series.step_s = span.step_s;
  const auto steps = static_cast<std::size_t>(std::round((kShownDay_s + span.spin_up_s) / span.step_s));
  result.series.rows.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i)
    result.series.rows.push_back(sampler.at(result.series.begin_s + static_cast<double>(i) * span.step_s));
  result.notes = notes_of(sampler, weather, span, air);
  return result;
}

}  // namespace ifov::thermal
