#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sensor/detector/detector.h"
#include "sensor/detector/illumination.h"
#include "sensor/detector/read_out.h"

namespace ifov::sensor {

/// One realisation of the signal that a detector makes of one channel's image, before it is digitised: equations (3) and (4) of
/// docs/theory/detectors.md. The same for the same seed, whoever asks for which line when.
class DetectorSignal {
 public:
  /// Of the sensor's channel with this number, and images of so many columns.
  DetectorSignal(const Detector& detector, std::uint64_t seed, int channel, int columns,
                 const ReadOut& read_out = {}, const Illumination& illumination = {});

  /// The signal of a line in electrons, of its mean radiance, W m-2 sr-1 um-1, and `drift`, what one_over_f_noise() has for it (empty:
  /// none). Where radiance is not a number the signal is not, either; below 0 it counts as 0. Wells run over along the line alone, of
  /// scanners' elements.
  void draw(int line, std::span<const float> radiance, std::span<const float> drift,
            std::span<double> signal) const;

  /// The same in two steps, for what runs over from line to line: electrons, however many a well holds, ...
  void collect(int line, std::span<const float> radiance, std::span<double> electrons) const;
  /// ... and what is read of them.
  void read(int line, std::span<const float> radiance, std::span<const float> drift,
            std::span<double> signal) const;

  /// Of a signal what is left of it by what was measured of its elements (10): as of elements that are all alike.
  void correct(int line, std::span<double> signal) const;

 private:
  class Pattern;
  void collect_and_read(std::uint64_t key, std::uint64_t first, std::span<double> signal) const;
  double well() const;

  Detector detector_;
  std::uint64_t seed_;
  int channel_;
  ReadOut read_out_;
  Illumination illumination_;
  std::vector<double> column_gain_, column_offset_;  // empty: none
};

}  // namespace ifov::sensor
