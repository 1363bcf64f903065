#pragma once

#include <vector>

#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"

namespace ifov::radiometry {

/// Blackbody radiance of every node between two temperatures, for surfaces whose temperature varies from
/// point to point: cubic Hermite interpolation over ln T, in which Planck's law bends by c2 / (lambda T) alike at all
/// temperatures; relative error at most 1e-5 (of 1e-6 W m-2 sr-1 um-1 where the radiance is below that).
class PlanckTable {
 public:
  /// Throws InputError unless 0 < t_low_k < t_high_k, and where no table within reason is as good as that.
  PlanckTable(const SpectralNodes& nodes, double t_low_k, double t_high_k);

  /// Writes a row of nodes, padded to a multiple of 16 floats as rows of a SpectrumBlock are. Temperatures
  /// outside the table's range are taken as its nearest end.
  void row(double temperature_k, float* nodes) const;

  double t_low_k() const { return t_low_k_; }
  double t_high_k() const { return t_high_k_; }
  std::size_t temperature_count() const { return values_.rows(); }

 private:
  void fill(const SpectralNodes& nodes, std::size_t count);
  double worst_error(const SpectralNodes& nodes) const;

  double t_low_k_, t_high_k_, step_ = 1.0;  // of ln T
  SpectrumBlock values_;                    // B at each temperature
  SpectrumBlock slopes_;                    // step x dB/d(ln T)
};

}  // namespace ifov::radiometry
