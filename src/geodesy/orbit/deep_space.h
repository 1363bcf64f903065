#pragma once

#include "geodesy/orbit/resonance.h"
#include "geodesy/orbit/two_line_elements.h"

namespace ifov::geodesy {

/// What the Moon, the Sun and the turning Earth's longitudes do to orbits of 225 minutes and more (Hujsak 1979, in Spacetrack Report
/// No. 3). Angles rad, times minutes.
class DeepSpace {
 public:
  struct Elements {
    double mean_motion = 0.0, eccentricity = 0.0, inclination = 0.0, node = 0.0, perigee = 0.0, anomaly = 0.0;
  };
  /// What zonal harmonics add a minute to the mean anomaly, the argument of perigee and the ascending node.
  struct Rates {
    double anomaly = 0.0, perigee = 0.0, node = 0.0;
  };
  DeepSpace(const TwoLineElements& elements, double mean_motion, const Rates& zonal);

  void add_secular(double minutes, Elements& elements) const;
  void add_periodic(double minutes, Elements& elements) const;

 private:
  /// Of one of both bodies: what it adds a minute, and the coefficients of its terms with a period.
  struct Body {
    double rate = 0.0, orbit_eccentricity = 0.0, mean_anomaly = 0.0;  // of the body
    double e2 = 0.0, e3 = 0.0, i2 = 0.0, i3 = 0.0, l2 = 0.0, l3 = 0.0, l4 = 0.0, g2 = 0.0, g3 = 0.0, g4 = 0.0,
           h2 = 0.0, h3 = 0.0;
    double eccentricity_rate = 0.0, inclination_rate = 0.0, longitude_rate = 0.0, perigee_rate = 0.0,
           node_rate = 0.0;
  };
  /// How a body's orbit lies: sines and cosines of its perigee, inclination and node counted from the satellite's.
  struct Lie {
    double sin_g = 0.0, cos_g = 0.0, sin_i = 0.0, cos_i = 0.0, sin_h = 0.0, cos_h = 0.0;
  };
  static Body attraction(const TwoLineElements& elements, double mean_motion, const Lie& lie, double strength,
                         double rate, double orbit_eccentricity, double mean_anomaly);
  static void add_periods(const Body& body, double minutes, double (&sums)[5]);

  Body sun_, moon_;
  ResonanceRates secular_;
  Resonance resonance_;
};

}  // namespace ifov::geodesy
