#include "platform/power_spectrum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace ifov::platform {

PowerSpectrum::PowerSpectrum(std::vector<double> frequencies_hz, std::vector<double> densities)
    : frequencies_hz_(std::move(frequencies_hz)), densities_(std::move(densities)) {
  if (frequencies_hz_.size() < 2 || frequencies_hz_.size() != densities_.size())
    throw InputError("a power spectrum of fewer than two points");
  for (std::size_t k = 0; k < frequencies_hz_.size(); ++k) {
    const double before = k == 0 ? 0.0 : frequencies_hz_[k - 1];
    if (!std::isfinite(frequencies_hz_[k]) ||
        !(k == 0 ? frequencies_hz_[k] >= 0.0 : frequencies_hz_[k] > before))
      throw InputError(
          format("a power spectrum whose frequencies do not increase from 0 on: {:g} Hz after {:g} Hz",
                 frequencies_hz_[k], before));
    if (!std::isfinite(densities_[k]) || !(densities_[k] >= 0.0))
      throw InputError(format("a power spectrum of {:g} at {:g} Hz; expected 0 or more", densities_[k],
                              frequencies_hz_[k]));
  }
  power_below_.push_back(0.0);
  for (std::size_t k = 1; k < frequencies_hz_.size(); ++k)
    power_below_.push_back(power_below_.back() + 0.5 * (densities_[k - 1] + densities_[k]) *
                                                     (frequencies_hz_[k] - frequencies_hz_[k - 1]));
}

PowerSpectrum PowerSpectrum::flat(double up_to_hz, double rms) {
  const double density = rms * rms / up_to_hz;
  return {{0.0, up_to_hz}, {density, density}};
}

PowerSpectrum PowerSpectrum::falling(double corner_hz, double slope, double up_to_hz, double rms) {
  // Even below a hundredth of the corner, then by equal factors.
  constexpr int kPoints = 400;
  std::vector<double> frequencies{0.0}, densities;
  const double first = std::min(0.01 * corner_hz, 0.1 * up_to_hz);
  for (int k = 0; k < kPoints; ++k)
    frequencies.push_back(first * std::pow(up_to_hz / first, k / (kPoints - 1.0)));
  frequencies.back() = up_to_hz;
  for (const double f : frequencies) densities.push_back(1.0 / (1.0 + std::pow(f / corner_hz, slope)));
  const double scale = rms / PowerSpectrum(frequencies, densities).rms();
  for (double& density : densities) density *= scale * scale;
  return {std::move(frequencies), std::move(densities)};
}

double PowerSpectrum::rms() const { return power_below_.empty() ? 0.0 : std::sqrt(power_below_.back()); }

double PowerSpectrum::density(double frequency_hz) const {
  if (frequencies_hz_.empty() || !(frequency_hz >= frequencies_hz_.front()) ||
      !(frequency_hz <= frequencies_hz_.back()))
    return 0.0;
  const auto next = std::upper_bound(frequencies_hz_.begin() + 1, frequencies_hz_.end() - 1, frequency_hz);
  const auto k = static_cast<std::size_t>(next - frequencies_hz_.begin());
  const double share =
      (frequency_hz - frequencies_hz_[k - 1]) / (frequencies_hz_[k] - frequencies_hz_[k - 1]);
  return densities_[k - 1] + share * (densities_[k] - densities_[k - 1]);
}

double PowerSpectrum::frequency_of(double share) const {
  const double power = share * power_below_.back();
  const auto next = std::upper_bound(power_below_.begin() + 1, power_below_.end() - 1, power);
  const auto k = static_cast<std::size_t>(next - power_below_.begin());
  const double wide = frequencies_hz_[k] - frequencies_hz_[k - 1], left = power - power_below_[k - 1];
  // left = a x + b x^2, in the form that does not cancel.
  const double a = densities_[k - 1], b = 0.5 * (densities_[k] - densities_[k - 1]) / wide;
  const double root = std::sqrt(std::max(0.0, a * a + 4.0 * b * left));
  return frequencies_hz_[k - 1] + (left > 0.0 ? std::min(wide, 2.0 * left / (a + root)) : 0.0);
}

}  // namespace ifov::platform
