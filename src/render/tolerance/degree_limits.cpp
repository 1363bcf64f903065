#include "render/tolerance/degree_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::render {

DegreeLimits degree_limits(double degree, double error) {
  constexpr double kLeast = 0.1;  // by which I counts at least
  const double counts = std::min(1.0, degree) + error, share = std::max(kLeast, counts);
  const double qu = error / (std::numbers::sqrt2 + counts / share);
  return {qu / share, qu};
}

double degree_half_width(double i, double q, double u, double i_half_width, double q_half_width,
                         double u_half_width) {
  const double left = i - i_half_width;
  if (!(left > 0.0)) return 1.0;
  return std::min(1.0, (std::hypot(q_half_width, u_half_width) + std::hypot(q, u) / i * i_half_width) / left);
}

}  // namespace ifov::render
