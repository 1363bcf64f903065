#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// Asks a spectrum that outlives it at rising wavelengths, without a search for each: the values of Spectrum::at(), which is
/// asked where wavelengths fall.
class SpectrumWalk {
 public:
  explicit SpectrumWalk(const Spectrum& spectrum)
      : spectrum_(&spectrum), um_(spectrum.wavelength_um()), values_(spectrum.values()) {}

  double at(double um) {
    if (um_.empty()) return values_[0];
    if (!(um >= um_.front() && um < um_.back())) return spectrum_->at(um);
    constexpr std::size_t kSteps = 4;
    if (um < um_[below_] || (below_ + kSteps < um_.size() && um_[below_ + kSteps] <= um))
      below_ = static_cast<std::size_t>(std::upper_bound(um_.begin(), um_.end(), um) - um_.begin()) - 1;
    while (um_[below_ + 1] <= um) ++below_;
    const double share = (um - um_[below_]) / (um_[below_ + 1] - um_[below_]);
    return values_[below_] + share * (values_[below_ + 1] - values_[below_]);
  }

 private:
  const Spectrum* spectrum_;
  std::span<const double> um_, values_;
  std::size_t below_ = 0;
};

/// A spectrum at many wavelengths. Spans: as many of one as of the other.
inline void sample(const Spectrum& spectrum, std::span<const double> um, std::span<double> values) {
  SpectrumWalk walk(spectrum);
  std::transform(um.begin(), um.end(), values.begin(), [&](double at) { return walk.at(at); });
}

}  // namespace ifov::radiometry
