#pragma once

#include "radiometry/polarization_frame.h"

namespace ifov::atmosphere {

/// Light in the air is about the meridional_frame of its direction, with v = 0: circular polarization of the
/// sky is below 1e-3 of the linear one and is left out. The tables of Coulson and of Natraj, Li and Yung
/// (2009) have the opposite sign of Q and the same sign of U.
using radiometry::StokesVector;

/// Direction in which light propagates.
struct Propagation {
  double mu = 1.0;           ///< cosine of the angle from the zenith: > 0 going up, < 0 coming down
  double azimuth_rad = 0.0;  ///< counterclockwise, seen from above, from the azimuth in which sunlight
                             ///< propagates: 0 is forward scattering
  /// x of space is where sunlight propagates, z is up.
  radiometry::PolarizationFrame frame() const { return radiometry::meridional_frame(mu, azimuth_rad); }
};

}  // namespace ifov::atmosphere
