#pragma once

#include <cmath>
#include <initializer_list>

namespace ifov::atmosphere {

/// What transfer through a homogeneous path of optical depth d >= 0 is made of, without loss of digits where
/// d is small, and without expm1, which takes three times as long.
struct PathLoss {
  double loss = 0.0;  ///< 1 - exp(-d)
  double mean = 1.0;  ///< (1 - exp(-d)) / d: of the transmission along the path
  double rest = 0.0;  ///< 1 - mean

  static PathLoss over(double depth) {
    constexpr double kSmall = 1.0 / 16.0;
    if (depth >= kSmall) {
      const double loss = 1.0 - std::exp(-depth), mean = loss / depth;
      return {loss, mean, 1.0 - mean};
    }
    // The series of 1 - mean: the first term left out is below 1e-15 of it.
    double rest = 0.0;
    for (const double factor : {1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0,
                                1.0 / 24.0, 1.0 / 6.0, 1.0 / 2.0})
      rest = depth * (factor - rest);
    return {depth * (1.0 - rest), 1.0 - rest, rest};
  }
};

/// Exact transfer through a homogeneous path of optical depth d whose source function is linear in optical
/// depth:
///   I_out = transmission I_in + far S_in + near S_out,
/// with S_in at the end where light enters and S_out where it leaves. far + near = 1 - transmission.
struct LinearSource {
  double transmission = 1.0, near = 0.0, far = 0.0;

  static LinearSource over(double depth) {
    const PathLoss path = PathLoss::over(depth);
    return {1.0 - path.loss, path.rest, path.loss - path.rest};
  }
};

}  // namespace ifov::atmosphere
