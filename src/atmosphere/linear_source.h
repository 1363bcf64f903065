#pragma once

#include <cmath>

namespace ifov::atmosphere {

/// Exact transfer through a homogeneous path of optical depth d whose source function is linear in optical
/// depth:
///   I_out = transmission I_in + far S_in + near S_out,
/// with S_in at the end where light enters and S_out where it leaves. far + near = 1 - transmission.
struct LinearSource {
  double transmission = 1.0, near = 0.0, far = 0.0;

  static LinearSource over(double depth) {
    const double loss = -std::expm1(-depth);
    // (1 - exp(-d)) / d loses its digits where d is small.
    const double near = depth < 1e-2
                            ? depth * (0.5 - depth * (1.0 / 6.0 - depth * (1.0 / 24.0 - depth / 120.0)))
                            : 1.0 - loss / depth;
    return {1.0 - loss, near, loss - near};
  }
};

}  // namespace ifov::atmosphere
