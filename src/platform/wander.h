#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "platform/cubic_spline.h"

namespace ifov::platform {

class PowerSpectrum;

/// Stationary random functions of time, drawn from a seed: the same at the same instant, whoever asks and for whatever span of time it
/// was made. Each is a sum of 256 waves of one amplitude and random phases, whose frequencies are drawn so that each holds
/// an equal share of the spectrum's power (spectral representation: Shinozuka 1971, J. Acoust. Soc. Am. 49, 357; frequencies drawn
/// within strata of power), sampled 20 times in its fastest period, with a cubic spline between (within 1.3e-4 of
/// the amplitude).
class Wander {
 public:
  /// One function for each spectrum, those without power 0; `stream` tells draws of one seed apart. From and to: seconds; beyond them it goes
  /// on straight. ifov::InputError where that takes more than a million samples.
  Wander(std::span<const PowerSpectrum> spectra, std::uint64_t seed, std::uint64_t stream, double from_s,
         double to_s);

  /// All of them at a time.
  void at(double time_s, std::span<double> values) const;

  /// Between samples; infinite where nothing moves.
  double step_s() const { return step_s_; }

 private:
  std::size_t components_ = 0;
  double step_s_ = 0.0;
  std::optional<CubicSpline> spline_;
};

}  // namespace ifov::platform
