#pragma once

#include "atmosphere/particles/aerosol_column.h"

namespace ifov::atmosphere {

/// Shares of diffuse light that a layer sends back and lets through.
struct TwoStreams {
  double reflected = 0.0, transmitted = 1.0;
};
/// By two streams in the hemispheric mean (Meador and Weaver 1980, J. Atmos. Sci. 37, 630), without the forward peak.
TwoStreams two_streams(double depth, double albedo, double asymmetry);

/// What the clouds of a column may be off by because their particles are not what they are taken for (ParticleError), as far as
/// light knows it; relative but for `reflected`.
struct CloudError {
  double extinction =
      0.0;             ///< optical depth that the straight way through all clouds may be off by, straight up
  double above = 0.0;  ///< of sunlight that comes back from the air and its clouds
  double below = 0.0;  ///< of diffuse light under them
  double all_below = 0.0;  ///< of all sunlight under them
  double reflected = 0.0;  ///< share of diffuse light that they reflect: absolute
  double absorbed = 0.0;   ///< of their absorption
};
/// `other`: what the air sends back of diffuse light without the clouds.
CloudError cloud_error(const AerosolColumn& aerosol, double wavelength_um, double other);

/// How far light that haze scatters may be off because it is taken for something else: Particles::scattering_error, mean over what all
/// regions but clouds scatter; 0 where there are none.
double haze_error(const AerosolColumn& aerosol, double wavelength_um);

}  // namespace ifov::atmosphere
