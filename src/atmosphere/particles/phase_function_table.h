#pragma once

#include <memory>
#include <vector>

#include "atmosphere/scattering/phase/phase_function.h"

namespace ifov::atmosphere {

/// Phase functions at some wavelengths, all at the same angles. Logarithms are linear in wavelength between them;
/// beyond the first and the last these hold.
struct PhaseFunctionTable {
  std::shared_ptr<const PhaseAngles> angles;
  std::vector<double> wavelength_um;            ///< rising, one at least
  std::vector<std::vector<double>> logarithms;  ///< [wavelength][angle], of a mean of 1
  /// `polarization` as for PhaseFunction.
  PhaseFunction at(double um, std::shared_ptr<const PolarizationRatios> polarization) const;
};

/// Henyey and Greenstein's function of an asymmetry from -0.99 to 0.99, at 91 angles close enough for moments within 2e-5
/// up to 0.9. It says nothing of polarization: light that it scatters has none.
PhaseFunction henyey_greenstein(double asymmetry);

}  // namespace ifov::atmosphere
