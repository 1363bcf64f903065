#pragma once

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// Spectral irradiance of the Sun at 1 au outside the atmosphere, W m-2 um-1, 0.202 to 1000 um; 0 outside.
/// Divide by the square of the distance in au. Compiled in from data/solar_irradiance.csv, which names its
/// sources.
const Spectrum& solar_irradiance_1au();

/// Angular diameter of the Sun at 1 au, radians (IAU 2015 nominal solar radius 695,700 km).
inline constexpr double kSolarAngularDiameter1AuRad = 0.00930093;

}  // namespace ifov::radiometry
