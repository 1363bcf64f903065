#include "thermal/weather_clock.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "thermal/sun_path.h"

namespace ifov::thermal {
namespace {

using atmosphere::WeatherKnot;
using atmosphere::WeatherQuantity;

constexpr double kADay_s = 86400.0, kLight_w_m2 = 5.0;
constexpr double kFine_s = 1200.0;  // what passes within it is told well enough by both ends

/// When light between a knot and the next passes a bar; where they are far apart on the line through the brighter of them and what lies behind it, as a file that is
/// told by the hour says of the dark one only that the Sun was not up yet.
double passes_at_s(const WeatherKnot& dark, const WeatherKnot& bright, const WeatherKnot& behind) {
  if (std::abs(bright.time_s - dark.time_s) <= kFine_s)
    return dark.time_s +
           (bright.time_s - dark.time_s) * (kLight_w_m2 - dark.value) / (bright.value - dark.value);
  const double slope = (behind.value - bright.value) / (behind.time_s - bright.time_s);
  const double back_s = (bright.value - kLight_w_m2) / slope;
  if (!(back_s * (bright.time_s - dark.time_s) > 0.0)) return dark.time_s;
  return std::abs(back_s) < std::abs(bright.time_s - dark.time_s) ? bright.time_s - back_s : dark.time_s;
}

/// The middle of the stretch about a time in which most light came, or nothing where it is not whole.
std::optional<double> middle_of_light(const std::vector<WeatherKnot>& knots, double noon_s) {
  std::optional<double> rise_s, middle_s;
  double light = 0.0, most = 0.0;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const WeatherKnot &a = knots[i - 1], &b = knots[i];
    if (std::abs(b.time_s - noon_s) > 0.5 * kADay_s) continue;
    if (b.time_s - a.time_s > 3.0 * 3600.0) rise_s.reset();
    light += 0.5 * (a.value + b.value) * (b.time_s - a.time_s);
    if (a.value < kLight_w_m2 && b.value >= kLight_w_m2) {
      rise_s = passes_at_s(a, b, knots[std::min(i + 1, knots.size() - 1)]);
      light = 0.0;
    }
    if (a.value < kLight_w_m2 || b.value >= kLight_w_m2 || !rise_s) continue;
    if (light > most) {
      most = light;
      middle_s = 0.5 * (*rise_s + passes_at_s(b, a, knots[i >= 2 ? i - 2 : 0]));
    }
    rise_s.reset();
  }
  return middle_s;
}

/// The middle of the light of the day that the Sun has its noon in, wherever the clock puts it.
std::optional<double> middle_anywhere(const std::vector<WeatherKnot>& knots, double noon_s) {
  for (const double shift_s : {0.0, -8.0 * 3600.0, 8.0 * 3600.0}) {
    const std::optional<double> guess_s = middle_of_light(knots, noon_s + shift_s);
    if (!guess_s) continue;
    if (const std::optional<double> found_s = middle_of_light(knots, *guess_s)) return found_s;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> noon_offset_s(const atmosphere::WeatherSeries& weather,
                                    const geodesy::Geodetic& place) {
  const std::vector<WeatherKnot>& knots = weather.knots(WeatherQuantity::global_irradiance);
  if (weather.is_constant() || knots.size() < 8) return std::nullopt;
  constexpr double kMostDays = 30.0;
  const double begin_s = knots.front().time_s, days = std::ceil((knots.back().time_s - begin_s) / kADay_s);
  // Typical years have times within a year that is none of its own.
  const double year_s = weather.typical_year()
                            ? atmosphere::seconds_of_day(atmosphere::WeatherSeries::kTypicalYear, 1, 1)
                            : 0.0;
  std::vector<double> offsets;
  const double apart = std::max(1.0, std::floor(days / kMostDays));
  for (double day = 0.0; day <= days; day += apart) {
    const double noon_s = solar_noon_s(year_s + begin_s + day * kADay_s, place);
    if (const std::optional<double> middle_s = middle_anywhere(knots, noon_s - year_s))
      offsets.push_back(*middle_s + year_s - noon_s);
  }
  if (offsets.empty()) return std::nullopt;
  std::sort(offsets.begin(), offsets.end());
  return offsets[offsets.size() / 2];
}

void check_clock(const atmosphere::WeatherSeries& weather, const geodesy::Geodetic& place) {
  const std::optional<double> offset_s = noon_offset_s(weather, place);
  if (!offset_s || std::abs(*offset_s) <= kLargestNoonOffset_s) return;
  const double minutes = *offset_s / 60.0;
  throw InputError(format(
      "the sunlight of '{}' has its noon {:.0f} minutes {} the Sun at this place, expected at most {:.0f}; its clock "
      "may be local time: times {:.1f} h {} would make noon noon",
      weather.site().name, std::abs(minutes), minutes > 0.0 ? "after" : "before", kLargestNoonOffset_s / 60.0,
      std::abs(minutes) / 60.0, minutes > 0.0 ? "earlier" : "later"));
}

}  // namespace ifov::thermal
