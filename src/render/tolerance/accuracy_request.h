#pragma once

#include <vector>

namespace ifov::render {

/// The unit in which the user states the error.
enum class ErrorUnit { kelvin, radiance, percent, reflectance, noise, polarization };

/// What the user asked for.
struct AccuracyRequest {
  ErrorUnit unit = ErrorUnit::percent;
  /// K, W m-2 sr-1 um-1, fraction of the pixel's radiance, reflectance, share of the noise, or degree of linear polarization
  double error = 0.01;
  double confidence = 0.95;              ///< per pixel and channel
  bool image_wide = false;               ///< the error is the root mean square over the image
  bool simultaneous = false;             ///< the confidence is for all judged channels of all pixels together
  std::vector<int> channels;             ///< judged channels; empty: all
  std::vector<double> noise_w_m2_sr_um;  ///< of the sensor, by channel; for errors in its unit
  double floor = 1e-3;  ///< of the white reference's radiance (percent, kelvin and polarization)
};

}  // namespace ifov::render
