#pragma once

#include "geodesy/orbit/two_line_elements.h"

namespace ifov::geodesy {

/// What changes steadily, a minute.
struct ResonanceRates {
  double eccentricity = 0.0, inclination = 0.0, anomaly = 0.0, perigee = 0.0, node = 0.0;
};

/// Orbits of one and of two revolutions a day keep meeting the same longitudes of the Earth, whose gravity is not the same there: mean
/// longitude and motion are integrated in steps of 12 hours from the epoch (Hujsak 1979). Others it leaves alone.
class Resonance {
 public:
  Resonance() = default;
  /// Rates of the zonal harmonics, and of the Moon and the Sun.
  Resonance(const TwoLineElements& elements, double mean_motion, const ResonanceRates& zonal,
            const ResonanceRates& third_bodies);

  /// Puts the integrated mean anomaly and motion (rad, rad/min) in place of those given.
  void replace(double minutes, double node, double perigee, double& anomaly, double& mean_motion) const;

 private:
  enum class Kind { none, daily, half_daily };
  struct Change {
    double longitude = 0.0, motion = 0.0, motion_twice = 0.0;  // derivatives by time
  };
  Change change(double since, double longitude, double motion) const;

  Kind kind_ = Kind::none;
  double start_longitude_ = 0.0, start_motion_ = 0.0, drift_ = 0.0, sidereal_ = 0.0;
  double perigee_ = 0.0, perigee_rate_ = 0.0;
  double daily_[3] = {};        // of the harmonics 3,1; 2,2; 3,3
  double half_daily_[10] = {};  // in the order of kTerms
};

}  // namespace ifov::geodesy
