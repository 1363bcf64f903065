#include "studies/temperature/outlined_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::studies {

bool OutlinedBox::is_in(double x_m, double y_m, math::Vec3 direction) const {
  double first = 0.0, last = 1e9;
  const auto slab = [&](double from, double along, double low, double high) {
    if (std::abs(along) < 1e-12) {
      if (from < low || from > high) last = -1.0;
      return;
    }
    const double a = (low - from) / along, b = (high - from) / along;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  slab(x_m, direction.x, -half_x_m, half_x_m);
  slab(y_m, direction.y, -half_y_m, half_y_m);
  slab(0.0, direction.z, 0.0, top_m);
  return first < last;
}

double OutlinedBox::free_sky(double x_m, double y_m) const {
  constexpr int kRings = 200, kTurn = 720;
  double sum = 0.0;
  for (int r = 0; r < kRings; ++r)
    for (int a = 0; a < kTurn; ++a) {
      const double sine = std::sqrt((r + 0.5) / kRings), turn = 2.0 * std::numbers::pi * (a + 0.5) / kTurn;
      sum += !is_in(x_m, y_m, {sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1.0 - sine * sine)});
    }
  return sum / (kRings * kTurn);
}

math::Vec3 to_sun(const thermal::Outdoors& now) {
  const double level = std::cos(now.sun_elevation_rad);
  return {level * std::sin(now.sun_azimuth_rad), level * std::cos(now.sun_azimuth_rad),
          std::sin(now.sun_elevation_rad)};
}

std::vector<double> OutlinedBox::free_sun(const thermal::OutdoorsSeries& series, double x_m,
                                          double y_m) const {
  constexpr int kTimes = 40, kDisc = 9;
  const auto place = [&](std::size_t row) {
    return to_sun(series.rows[std::min(row, series.rows.size() - 1)]);
  };
  std::vector<double> shares(series.rows.size(), 1.0);
  for (std::size_t row = 0; row < shares.size(); ++row) {
    if (!(series.rows[row].sun_elevation_rad > 0.0)) continue;
    double sum = 0.0, all = 0.0;
    for (int t = 0; t < kTimes; ++t) {
      const double steps = (t + 0.5) / kTimes * 2.0 - 1.0;
      const std::size_t other = steps < 0.0 ? (row > 0 ? row - 1 : 0) : row + 1;
      const math::Vec3 middle = (1.0 - std::abs(steps)) * place(row) + std::abs(steps) * place(other);
      const math::Vec3 across = math::normalized(math::cross(middle, {0.0, 0.0, 1.0}));
      for (int k = 0; k < kDisc; ++k) {  // across the disc, by the area of its stripes
        const double offset = -1.0 + (k + 0.5) * 2.0 / kDisc;
        const double weight = (1.0 - std::abs(steps)) * std::sqrt(1.0 - offset * offset);
        sum += weight * !is_in(x_m, y_m, math::normalized(middle + 0.00465 * offset * across));
        all += weight;
      }
    }
    shares[row] = sum / all;
  }
  return shares;
}

}  // namespace ifov::studies
