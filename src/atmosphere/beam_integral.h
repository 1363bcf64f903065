#pragma once

#include <cmath>

#include "atmosphere/linear_source.h"

namespace ifov::atmosphere {

/// Integral over a path of optical depth `depth` from its near to its far end of exp(-t - beam depth at t)
/// dt, the beam's depth being linear from `near_beam` to `far_beam`. No overflow, whatever the depths.
inline double beam_integral(double depth, double near_beam, double far_beam) {
  const double x = depth + far_beam - near_beam;
  return std::exp(x >= 0.0 ? -near_beam : -far_beam - depth) * depth * PathLoss::over(std::abs(x)).mean;
}

}  // namespace ifov::atmosphere
