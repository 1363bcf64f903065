#pragma once

#include <optional>

#include "geodesy/orbit/deep_space.h"
#include "geodesy/orbit/teme.h"
#include "geodesy/orbit/two_line_elements.h"

namespace ifov::geodesy {

/// Why there is no position; the numbers are those of Vallado et al. 2006.
enum class OrbitFault {
  none = 0,
  eccentricity = 1,            ///< the mean one is not from 0 to 1
  mean_motion = 2,             ///< below 0
  perturbed_eccentricity = 3,  ///< not from 0 to 1 with what the Moon and the Sun do
  semi_latus_rectum = 4,       ///< below 0
  decayed = 6                  ///< the position is inside the Earth
};

struct OrbitState {
  TemePoint position;  ///< m
  TemeVector velocity_m_s;
  OrbitFault fault = OrbitFault::none;
};

/// The orbit that two-line elements stand for: SGP4 with its deep-space part (Hoots and Roehrich 1980, Spacetrack Report No. 3;
/// Vallado, Crawford, Hujsak and Kelso 2006, AIAA 2006-6753, with the constants of WGS 72). Equations: docs/theory/orbits.md.
class Sgp4 {
 public:
  explicit Sgp4(const TwoLineElements& elements);

  /// So long after the epoch, or before. A state with a fault has the position only where it is `decayed`.
  OrbitState after_minutes(double minutes) const;

  const TwoLineElements& elements() const { return elements_; }

 private:
  struct Mean;  // elements at a time, after drag and secular changes
  OrbitFault add_drag_and_secular(double minutes, Mean& mean) const;
  OrbitState short_periods(const Mean& mean) const;

  TwoLineElements elements_;
  double mean_motion_ = 0.0, semi_major_ = 0.0;  // without Kozai's term; rad/min, Earth radii
  double cos_i_ = 0.0, sin_i_ = 0.0;
  // Secular rates, rad/min, and what drag does.
  double anomaly_rate_ = 0.0, perigee_rate_ = 0.0, node_rate_ = 0.0, node_drag_ = 0.0;
  double c1_ = 0.0, c4_ = 0.0, c5_ = 0.0, d2_ = 0.0, d3_ = 0.0, d4_ = 0.0;
  double t2_ = 0.0, t3_ = 0.0, t4_ = 0.0, t5_ = 0.0;
  double perigee_drag_ = 0.0, anomaly_drag_ = 0.0, eta_ = 0.0, anomaly_cube_ = 0.0, sin_anomaly_ = 0.0;
  bool simple_drag_ = false;
  std::optional<DeepSpace> deep_space_;
};

}  // namespace ifov::geodesy
