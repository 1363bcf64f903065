#pragma once

#include <memory>

#include "radiometry/channel.h"

namespace ifov::sensor {

/// radiometry::channel_brightness_temperature_k() of many radiances of one channel, from a table: within 1e-4 K between 60 and 4000 K.
class BrightnessScale {
 public:
  /// The table is made when a temperature is first asked for, from any thread.
  explicit BrightnessScale(const radiometry::Channel& channel);
  /// Not a number where radiance is not above 0.
  double kelvin(double radiance_w_m2_sr_um) const;
  /// The way back, as right.
  double radiance_w_m2_sr_um(double kelvin) const;

  const radiometry::Channel& channel() const;

 private:
  struct Table;
  std::shared_ptr<Table> table_;
};

}  // namespace ifov::sensor
