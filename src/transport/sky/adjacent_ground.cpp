#include "transport/sky/adjacent_ground.h"

#include <algorithm>

namespace ifov::transport {
namespace {

/// The cell that a position lies in, and where in it.
struct Position {
  std::size_t cell;
  float share;
};

Position position(double value, double low, double high, std::size_t places) {
  const double cells = static_cast<double>(places - 1);
  const double at = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) * cells : 0.0;
  const std::size_t cell = std::min(static_cast<std::size_t>(at), places - 2);
  return {cell, static_cast<float>(at - static_cast<double>(cell))};
}

}  // namespace

AdjacentGround::AdjacentGround(const Area& area, std::size_t across, std::size_t nodes)
    : area_(area), across_(across), radiance_(across * across, nodes), sky_(across * across, nodes) {}

double AdjacentGround::x_m(std::size_t column) const {
  return area_.west_m +
         (area_.east_m - area_.west_m) * static_cast<double>(column) / static_cast<double>(across_ - 1);
}

double AdjacentGround::y_m(std::size_t row) const {
  return area_.south_m +
         (area_.north_m - area_.south_m) * static_cast<double>(row) / static_cast<double>(across_ - 1);
}

AdjacentGround::Corners AdjacentGround::at(double x_m, double y_m) const {
  const Position x = position(x_m, area_.west_m, area_.east_m, across_),
                 y = position(y_m, area_.south_m, area_.north_m, across_);
  const std::size_t first = y.cell * across_ + x.cell;
  const std::array<std::size_t, 4> rows{first, first + 1, first + across_, first + across_ + 1};
  Corners corners;
  for (std::size_t k = 0; k < rows.size(); ++k)
    corners.radiance[k] = radiance_.row(rows[k]), corners.sky[k] = sky_.row(rows[k]);
  corners.weight = {(1.0f - x.share) * (1.0f - y.share), x.share * (1.0f - y.share),
                    (1.0f - x.share) * y.share, x.share * y.share};
  return corners;
}

void AdjacentGround::add(double x_m, double y_m, const float* __restrict diffuse,
                         float* __restrict light) const {
  const Corners corners = at(x_m, y_m);
  const float* v = corners.weight.data();
  const auto* r = corners.radiance.data();
  for (std::size_t i = 0; i < radiance_.stride(); ++i)
    light[i] += diffuse[i] * ((r[0][i] * v[0] + r[1][i] * v[1]) + (r[2][i] * v[2] + r[3][i] * v[3]));
}

void AdjacentGround::add(double x_m, double y_m, const std::array<const float*, 5>& diffuse,
                         const std::array<float, 5>& weight, float* __restrict light) const {
  const Corners corners = at(x_m, y_m);
  const float *w = weight.data(), *v = corners.weight.data();
  const auto *d = diffuse.data(), *r = corners.radiance.data();
  for (std::size_t i = 0; i < radiance_.stride(); ++i)
    light[i] += ((d[0][i] * w[0] + d[1][i] * w[1]) + (d[2][i] * w[2] + d[3][i] * w[3]) + d[4][i] * w[4]) *
                ((r[0][i] * v[0] + r[1][i] * v[1]) + (r[2][i] * v[2] + r[3][i] * v[3]));
}

void AdjacentGround::brighten(double x_m, double y_m, float* __restrict light) const {
  const Corners corners = at(x_m, y_m);
  const float* w = corners.weight.data();
  const auto* s = corners.sky.data();
  for (std::size_t i = 0; i < sky_.stride(); ++i)
    light[i] *= 1.0f + ((s[0][i] * w[0] + s[1][i] * w[1]) + (s[2][i] * w[2] + s[3][i] * w[3]));
}

}  // namespace ifov::transport
