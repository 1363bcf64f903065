#pragma once

namespace ifov::atmosphere {

class AtmosphereColumn;

/// Wavenumbers at which broadband fluxes are summed lie so far from each other, multiples of 5 cm-1.
inline constexpr double kLongwaveStep_cm1 = 20.0, kShortwaveStep_cm1 = 100.0;

/// What the air sends down to the ground, 3.1 um and longer, over black ground as warm as the lowest air, W m-2: in flat layers with a
/// quadrature of directions, where nothing of it is scattered. Beyond 50 um, where the band model ends, the air is taken for opaque.
double longwave_down_w_m2(const AtmosphereColumn& column, double step_cm1 = kLongwaveStep_cm1,
                          int threads = 0);

/// Sunlight at the ground over black ground, 0.2 to 10 um, of a Sun at 1 au whose irradiance above the air is `above`, W m-2.
struct BroadbandSunlight {
  double direct = 0.0;  ///< across the beam
  double diffuse = 0.0;
  double above = 0.0;
};
BroadbandSunlight sunlight_down(const AtmosphereColumn& column, double sun_zenith_rad,
                                double step_cm1 = kShortwaveStep_cm1, int threads = 0);

}  // namespace ifov::atmosphere
