#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sensor/detector/detector.h"

namespace ifov::sensor {

/// One realisation of the signal that a detector makes of one channel's image, before it is digitised: equations (3) and (4) of
/// docs/theory/detectors.md. The same for the same seed, whoever asks for which line when.
class DetectorSignal {
 public:
  /// Of the sensor's channel with this number, and images of so many columns.
  DetectorSignal(const Detector& detector, std::uint64_t seed, int channel, int columns);

  /// The signal of a line in electrons, of its mean radiance, W m-2 sr-1 um-1, and `drift`, what one_over_f_noise() has for it (empty:
  /// none). Where radiance is not a number the signal is not, either; below 0 it counts as 0.
  void draw(int line, std::span<const float> radiance, std::span<const float> drift,
            std::span<double> signal) const;

 private:
  class Pattern;
  void collect(std::uint64_t key, std::uint64_t first, std::span<double> signal) const;

  Detector detector_;
  std::uint64_t seed_;
  int channel_;
  std::vector<double> column_gain_, column_offset_;  // empty: none
};

}  // namespace ifov::sensor
