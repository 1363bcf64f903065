#include "session/series/series_sun.h"

#include <algorithm>
#include <numbers>

#include "atmosphere/weather_series.h"
#include "geodesy/sun_position.h"
#include "io/document/document.h"
#include "math/angle.h"
#include "session/assembly/atmosphere/weather_assembly.h"

namespace ifov::session {
namespace {

constexpr double kHighest_rad = 30.0 * math::kDegree,
                 kLowest_rad = -18.0 * math::kDegree;  // of dawn and dusk

geodesy::SunPosition sun_at(double time_s, const geodesy::Geodetic& place) {
  return geodesy::sun_position({2440587.5, time_s / 86400.0}, place);
}

/// In the eastern half of the sky, or of what lies below the horizon, it is before noon.
const char* time_of_day(const geodesy::SunPosition& sun) {
  const bool climbs = sun.azimuth_rad < std::numbers::pi;
  if (sun.elevation_rad > kHighest_rad) return climbs ? "morning" : "afternoon";
  if (sun.elevation_rad < kLowest_rad) return "night";
  return climbs ? "dawn" : "dusk";
}

}  // namespace

std::optional<geodesy::Geodetic> place_of_series(const io::Document& document) {
  const io::OriginDocument& origin = document.scene.origin;
  if (origin.geographic)
    return geodesy::Geodetic{origin.geographic->latitude_rad, origin.geographic->longitude_rad,
                             origin.height_m};
  if (!document.weather) return std::nullopt;
  const atmosphere::WeatherSite site =
      assemble_weather(document.sources, *document.weather, document.time)->site();
  if (!site.latitude_rad || !site.longitude_rad) return std::nullopt;
  return geodesy::Geodetic{*site.latitude_rad, *site.longitude_rad, site.altitude_m.value_or(0.0)};
}

void tell_of_sun(const geodesy::Geodetic& place, io::SeriesReport& report) {
  for (io::SeriesReport::Crossover& one : report.crossovers)
    one.when = time_of_day(sun_at(one.time_s, place));

  constexpr double kStep_s = 300.0;
  const double first_s = report.time_s.front(), last_s = report.time_s.back();
  double before_s = first_s, before_rad = sun_at(first_s, place).elevation_rad;
  if (before_rad < 0.0) report.nights.push_back({first_s, last_s});
  while (before_s < last_s) {
    const double now_s = std::min(before_s + kStep_s, last_s), now_rad = sun_at(now_s, place).elevation_rad;
    if ((now_rad < 0.0) != (before_rad < 0.0)) {
      const double edge_s = before_s + (now_s - before_s) * before_rad / (before_rad - now_rad);
      if (now_rad < 0.0)
        report.nights.push_back({edge_s, last_s});
      else
        report.nights.back().end_s = edge_s;
    }
    before_s = now_s, before_rad = now_rad;
  }
}

}  // namespace ifov::session
