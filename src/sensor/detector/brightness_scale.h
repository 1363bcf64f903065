#pragma once

#include <vector>

#include "radiometry/channel.h"

namespace ifov::sensor {

/// radiometry::channel_brightness_temperature_k() of many radiances of one channel, from a table: within 1e-4 K between 60 and 4000 K.
class BrightnessScale {
 public:
  explicit BrightnessScale(const radiometry::Channel& channel);
  /// Not a number where radiance is not above 0.
  double kelvin(double radiance_w_m2_sr_um) const;

 private:
  radiometry::Channel channel_;
  std::vector<double> log_radiance_, per_kelvin_;  // rising; 1/T of each
};

}  // namespace ifov::sensor
