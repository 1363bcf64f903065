#pragma once

#include <vector>

namespace ifov::radiometry {
class SpectralNodes;
}

namespace ifov::render {

/// Brightness temperature of each channel: the temperature at which a black body gives the channel's radiance, and the slope dL/dT there, from a table of channel-integrated Planck radiances (1 K
/// steps, 100 K to 1500 K, interpolated in ln L over 1/T, where Planck's law is nearly straight).
class ChannelBrightness {
 public:
  explicit ChannelBrightness(const radiometry::SpectralNodes& nodes);

  /// Radiances outside the table's range answer its ends.
  double temperature_k(int channel, double radiance_w_m2_sr_um) const;

  /// dL/dT at the radiance's own brightness temperature, W m-2 sr-1 um-1 K-1.
  double slope_w_m2_sr_um_k(int channel, double radiance_w_m2_sr_um) const;

  double radiance_w_m2_sr_um(int channel, double temperature_k) const;

 private:
  static constexpr double kLowest_k = 100.0, kHighest_k = 1500.0;
  static constexpr int kSteps = 1400;
  const double* log_radiance(int channel) const { return log_radiance_.data() + channel * (kSteps + 1); }
  std::vector<double> log_radiance_;
};

}  // namespace ifov::render
