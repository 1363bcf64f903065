#pragma once

#include <span>
#include <vector>

#include "radiometry/channel.h"
#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// A channel as a fine sum: the mean of f over the channel is the sum of response[q] f(wavelength_um[q]). At
/// least 256 points, and two between neighbouring points of the response and of the solar spectrum; a
/// monochromatic channel has one.
struct ChannelGrid {
  std::vector<double> wavelength_um;
  std::vector<double> response;    ///< sums to 1
  std::vector<double> irradiance;  ///< of the Sun, W m-2 um-1; under a sky, of both on level ground
  std::vector<double> sky;         ///< irradiance of the sky alone; empty: it is not told apart
  double least_radiance = 0.0;     ///< W m-2 sr-1 um-1
  std::vector<double> seen;        ///< transmittance from surfaces to the sensor; empty: 1 at all points
  /// W m-2 sr-1 um-1: a white surface in the Sun, plus a blackbody of 300 K; and the same as far as it is seen
  std::vector<double> bright, reference;

  ChannelGrid(const Channel& channel, const Spectrum& solar_irradiance);
  /// From points of the caller's own, several of which may stand at one wavelength (terms of absorption). Shares are
  /// scaled to a sum of 1. `least`: radiances darker than this may err by as much as it would.
  ChannelGrid(std::vector<double> wavelengths_um, std::vector<double> shares, std::vector<double> irradiances,
              std::vector<double> skies, std::vector<double> transmittances, double least);
  std::size_t size() const { return wavelength_um.size(); }
  std::vector<double> sampled(const Spectrum& spectrum) const;
};

}  // namespace ifov::radiometry
