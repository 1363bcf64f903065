#pragma once

#include <span>
#include <vector>

#include "radiometry/channel.h"
#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// Ends of the steps in which a channel is integrated: the given points (rising, above 0), and between them steps of at
/// most 1/128 of the whole range and of 3 % of the wavelength. The latter counts from a ratio of 4.8 between the last
/// and the first wavelength on: Planck's law has its features over wavelengths, not over differences of them.
std::vector<double> integration_steps_um(const std::vector<double>& points_um);

/// A channel as a fine sum: the mean of f over the channel is the sum of response[q] f(wavelength_um[q]). At
/// least 256 points, two in each of integration_steps_um() between the points of the response, of the lights, and of
/// those surfaces whose first or second power would be wrong by 5e-5 otherwise; a monochromatic channel has one.
struct ChannelGrid {
  std::vector<double> wavelength_um;
  std::vector<double> response;    ///< sums to 1
  std::vector<double> irradiance;  ///< of the Sun, W m-2 um-1; under a sky, of both on level ground
  std::vector<double> sky;         ///< irradiance of the sky alone; empty: it is not told apart
  double least_radiance = 0.0;     ///< W m-2 sr-1 um-1
  std::vector<double> seen;        ///< transmittance from surfaces to the sensor; empty: 1 at all points
  /// W m-2 sr-1 um-1: a white surface in the Sun, plus a blackbody of 300 K; and the same as far as it is seen
  std::vector<double> bright, reference;

  /// `surfaces`: reflectances and transmittances that the sum has to be right for. `sky_radiance`: of a uniform sky, as
  /// it reaches surfaces; null where there is none. `lamps`: light of any unit, whose lines the points have to meet.
  ChannelGrid(const Channel& channel, const Spectrum& solar_irradiance,
              std::span<const Spectrum> surfaces = {}, const Spectrum* sky_radiance = nullptr,
              std::span<const Spectrum> lamps = {});
  /// From points of the caller's own, several of which may stand at one wavelength (terms of absorption). Shares are
  /// scaled to a sum of 1. `least`: radiances darker than this may err by as much as it would.
  ChannelGrid(std::vector<double> wavelengths_um, std::vector<double> shares, std::vector<double> irradiances,
              std::vector<double> skies, std::vector<double> transmittances, double least);
  std::size_t size() const { return wavelength_um.size(); }
  std::vector<double> sampled(const Spectrum& spectrum) const;

 private:
  class Resolution;
  void place_points(const Channel& channel, std::span<const Spectrum* const> spectra);
};

}  // namespace ifov::radiometry
