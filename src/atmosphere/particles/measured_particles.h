#pragma once

#include <variant>
#include <vector>

#include "atmosphere/particles/particles.h"
#include "atmosphere/particles/phase_function_table.h"

namespace ifov::atmosphere {

/// Particles whose optics are known at some wavelengths, as an inversion of sky radiances tells them. Between these extinction is a
/// power of wavelength, and so it goes on beyond; albedo and asymmetry are linear, and hold beyond. Light that they scatter is
/// not polarized.
class MeasuredParticles : public Particles {
 public:
  struct Optics {
    std::vector<double> wavelength_um;             ///< rising, two or more
    std::vector<double> optical_depth;             ///< vertical, above 0
    std::vector<double> single_scattering_albedo;  ///< 0 to 1
    /// Mean cosines of the scattering angle, which scatter by Henyey and Greenstein's function, or a table.
    std::variant<std::vector<double>, PhaseFunctionTable> scatters;
  };
  /// Throws InputError where sizes differ or values cannot be.
  explicit MeasuredParticles(Optics optics);
  double optical_depth(double wavelength_um) const;
  AerosolProperties properties(double wavelength_um) const override;
  PhaseFunction phase_function(double wavelength_um) const override;

 private:
  Optics optics_;
};

}  // namespace ifov::atmosphere
