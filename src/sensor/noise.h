#pragma once

#include <cstdint>
#include <span>

namespace ifov::sensor {

/// One realisation of a sensor's noise: normal, independent from pixel to pixel and band to band, the same for the same seed
/// whoever asks in which order.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : seed_(seed) {}

  /// Adds noise of a standard deviation, in the unit of the values, to one line of one band.
  void add(int line, int band, double standard_deviation, std::span<float> values) const;

 private:
  std::uint64_t seed_;
};

}  // namespace ifov::sensor
