#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "radiometry/stokes.h"

namespace ifov::atmosphere {

class AtmosphereColumn;

/// The whole sky at one wavelength, seen from the ground, over black ground and without the Sun's disc.
struct SkyView {
  double wavelength_um = 0.0;
  std::vector<double> zenith_rad;  ///< 0 to pi / 2
  /// Counterclockwise from the Sun's, 0 to pi; the other half mirrors it, with -u.
  std::vector<double> azimuth_rad;
  std::vector<radiometry::StokesVector> light;  ///< [zenith][azimuth], W m-2 sr-1 um-1

  const radiometry::StokesVector& at(std::size_t zenith, std::size_t azimuth) const {
    return light[zenith * azimuth_rad.size() + azimuth];
  }
};

/// `solar_irradiance`: above the air, W m-2 um-1, mean over the 20 cm-1 that the band model resolves. All
/// absorption terms of the wavelength are solved by themselves. Without a Sun the sky is what the air emits.
/// InputError as AtmosphereColumn::at.
SkyView view_sky(const AtmosphereColumn& column, double wavelength_um, double solar_irradiance,
                 std::optional<double> sun_zenith_rad, int threads = 0);

}  // namespace ifov::atmosphere
