#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/weather_series.h"
#include "thermal/faces/sky_longwave.h"
#include "thermal/surface_balance.h"

namespace ifov::thermal::test {

/// A clear day of June at 45 degrees, over and over: from 0 h of the Sun's time.
inline OutdoorsSeries june(double days, double step_s = 300.0, double vapour_pa = 1000.0) {
  OutdoorsSeries series;
  series.step_s = step_s;
  constexpr double kTurn = 2.0 * std::numbers::pi, kLatitude = kTurn / 8.0, kDeclination = 0.4;
  for (int i = 0; i <= static_cast<int>(days * 86400.0 / step_s); ++i) {
    const double hour_angle = kTurn * (i * step_s / 86400.0 - 0.5);
    Outdoors now;
    const double height = std::sin(kLatitude) * std::sin(kDeclination) +
                          std::cos(kLatitude) * std::cos(kDeclination) * std::cos(hour_angle);
    now.sun_elevation_rad = std::asin(height);
    now.sun_azimuth_rad = std::atan2(std::sin(hour_angle), std::cos(hour_angle) * std::sin(kLatitude) -
                                                               std::tan(kDeclination) * std::cos(kLatitude)) +
                          0.5 * kTurn;
    now.direct_w_m2 = height > 0.0 ? 900.0 * (1.0 - std::exp(-8.0 * height)) : 0.0;
    now.diffuse_w_m2 = 100.0 * std::max(0.0, height);
    now.air = {293.0 - 6.0 * std::cos(hour_angle + 0.7 * std::numbers::pi), vapour_pa, 101325.0};
    now.longwave_w_m2 = sky_longwave_w_m2(now.air.temperature_k, vapour_pa, 0.0);
    now.wind_m_s = 3.0 + std::sin(5.0 * hour_angle);
    series.rows.push_back(now);
  }
  return series;
}

}  // namespace ifov::thermal::test
