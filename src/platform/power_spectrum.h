#pragma once

#include <vector>

namespace ifov::platform {

/// One-sided power spectrum of a stationary random angle or length: its square per hertz over frequency, straight between points, nothing
/// outside them. Its integral is the variance.
class PowerSpectrum {
 public:
  /// Nothing at all.
  PowerSpectrum() = default;
  /// Frequencies of at least 0, increasing; densities of at least 0, one for each of at least two. ifov::InputError.
  PowerSpectrum(std::vector<double> frequencies_hz, std::vector<double> densities);

  /// Even from 0 to a frequency.
  static PowerSpectrum flat(double up_to_hz, double rms);
  /// As 1 / (1 + (f / corner)^slope) from 0 to a frequency, of 400 points; scaled so that it has this rms.
  static PowerSpectrum falling(double corner_hz, double slope, double up_to_hz, double rms);

  double rms() const;
  double highest_hz() const { return frequencies_hz_.empty() ? 0.0 : frequencies_hz_.back(); }
  double density(double frequency_hz) const;

  /// Below which frequency this share of the power lies, 0 to 1; of a spectrum with an rms above 0.
  double frequency_of(double share) const;

 private:
  std::vector<double> frequencies_hz_, densities_, power_below_;
};

}  // namespace ifov::platform
