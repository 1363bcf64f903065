#pragma once

#include <variant>

#include "atmosphere/particles/particles.h"
#include "atmosphere/particles/phase_function_table.h"
#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

/// Particles whose optics somebody tells: extinction goes as wavelength^-angstrom; of it the single-scattering albedo is
/// scattered, by Henyey and Greenstein's function of an asymmetry or by a table. Light that they scatter is not polarized.
class GivenParticles : public Particles {
 public:
  /// Throws InputError, with wavelength and value, where an albedo is not from 0 to 1 or an asymmetry not between -0.99
  /// and 0.99.
  GivenParticles(double angstrom, radiometry::Spectrum single_scattering_albedo,
                 std::variant<radiometry::Spectrum, PhaseFunctionTable> scatters);
  AerosolProperties properties(double wavelength_um) const override;
  PhaseFunction phase_function(double wavelength_um) const override;

 private:
  double angstrom_;
  radiometry::Spectrum albedo_;
  std::variant<radiometry::Spectrum, PhaseFunctionTable> scatters_;
};

}  // namespace ifov::atmosphere
