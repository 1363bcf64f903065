#pragma once

#include <string>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// One channel of a sensor: a name and a relative spectral response to energy (any scale, 0 outside its
/// table). The radiance of a channel is the mean of spectral radiance weighted with the response.
struct Channel {
  std::string name;
  Spectrum response;       ///< a table; a constant for a monochromatic channel
  double centre_um = 0.0;  ///< centroid of the response
  double fwhm_um = 0.0;    ///< full width at half of the maximum; 0 for a monochromatic channel

  bool is_monochromatic() const { return response.is_constant(); }

  /// Gaussian of the given full width at half maximum, cut at 4 standard deviations.
  static Channel gaussian(std::string name, double centre_um, double fwhm_um);
  /// 1 between the two wavelengths, 0 elsewhere.
  static Channel top_hat(std::string name, double first_um, double last_um);
  /// A table, linear between its points; values below 0 (noise of the measurement) count as 0. Throws
  /// InputError where no value is above 0.
  static Channel tabulated(std::string name, const Spectrum& response);
  /// A single wavelength.
  static Channel monochromatic(std::string name, double wavelength_um);
};

/// Mean of a spectrum over a channel; its value at the wavelength of a monochromatic channel.
double channel_mean(const Channel& channel, const Spectrum& spectrum);

/// Radiance of a blackbody in a channel, W m-2 sr-1 um-1, and its derivative by temperature.
double channel_planck_w_m2_sr_um(const Channel& channel, double temperature_k);
double channel_planck_slope_w_m2_sr_um_k(const Channel& channel, double temperature_k);

/// The temperature at which a blackbody has this radiance in the channel. 0 for radiance <= 0.
double channel_brightness_temperature_k(const Channel& channel, double radiance_w_m2_sr_um);

}  // namespace ifov::radiometry
