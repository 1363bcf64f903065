#pragma once

namespace ifov::sensor {

/// Of the equations in distortion.h.
struct DistortionTerms {
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, p1 = 0.0, p2 = 0.0;
  bool none() const { return k1 == 0.0 && k2 == 0.0 && k3 == 0.0 && p1 == 0.0 && p2 == 0.0; }
};

}  // namespace ifov::sensor
