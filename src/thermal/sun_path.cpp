#include "thermal/sun_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesy/sun_position.h"

namespace ifov::thermal {
namespace {

constexpr double kKnot_s = 3600.0, kTurn_s = 86400.0;

geodesy::SunPosition sun_at(double time_s, const geodesy::Geodetic& place) {
  return geodesy::sun_position({2440587.5, time_s / kTurn_s}, place);
}

}  // namespace

SunPath::SunPath(double begin_s, double end_s, const geodesy::Geodetic& place) : begin_s_(begin_s - kKnot_s) {
  const auto count = static_cast<std::size_t>(std::ceil((end_s - begin_s) / kKnot_s)) + 4;
  for (std::size_t i = 0; i < count; ++i) {
    const geodesy::SunPosition sun = sun_at(begin_s_ + static_cast<double>(i) * kKnot_s, place);
    const double level = std::cos(sun.elevation_rad);
    knots_.push_back({level * std::sin(sun.azimuth_rad), level * std::cos(sun.azimuth_rad),
                      std::sin(sun.elevation_rad), sun.distance_au});
  }
}

SunPath::Place SunPath::at(double time_s) const {
  const double along =
      std::clamp((time_s - begin_s_) / kKnot_s, 1.0, static_cast<double>(knots_.size()) - 2.0 - 1e-9);
  const auto first = static_cast<std::size_t>(along) - 1;
  const double x = along - std::floor(along);
  // Lagrange's polynomial through four knots, x between the second and the third.
  const std::array<double, 4> weight{-x * (x - 1.0) * (x - 2.0) / 6.0,
                                     (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
                                     -(x + 1.0) * x * (x - 2.0) / 2.0, (x + 1.0) * x * (x - 1.0) / 6.0};
  std::array<double, 4> sum{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) sum[j] += weight[k] * knots_[first + k][j];
  return {std::atan2(sum[0], sum[1]), std::atan2(sum[2], std::hypot(sum[0], sum[1])), sum[3]};
}

double solar_noon_s(double time_s, const geodesy::Geodetic& place) {
  for (int i = 0; i < 2; ++i) {
    const geodesy::SunPosition sun = sun_at(time_s, place);
    const double level = std::cos(sun.elevation_rad);
    const double east = level * std::sin(sun.azimuth_rad), north = level * std::cos(sun.azimuth_rad);
    const double to_meridian =
        std::sin(sun.elevation_rad) * std::cos(place.latitude_rad) - north * std::sin(place.latitude_rad);
    time_s -= std::atan2(-east, to_meridian) / (2.0 * std::numbers::pi) * kTurn_s;
  }
  return time_s;
}

}  // namespace ifov::thermal
