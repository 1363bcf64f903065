#pragma once

#include <cmath>

namespace ifov::atmosphere {

/// Integral over a path of optical depth `depth` from its near to its far end of exp(-t - beam depth at t)
/// dt, the beam's depth being linear from `near_beam` to `far_beam`. No overflow, whatever the depths.
inline double beam_integral(double depth, double near_beam, double far_beam) {
  const double x = depth + far_beam - near_beam, size = std::abs(x);
  const double mean = size < 1e-8 ? 1.0 - 0.5 * size : -std::expm1(-size) / size;
  return (x >= 0.0 ? std::exp(-near_beam) : std::exp(-far_beam - depth)) * depth * mean;
}

}  // namespace ifov::atmosphere
