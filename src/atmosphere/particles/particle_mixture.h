#pragma once

#include <memory>
#include <vector>

#include "atmosphere/particles/mie_particles.h"

namespace ifov::atmosphere {

/// Spheres of several kinds, side by side. They scatter by the sum of what each does, with its polarization.
class ParticleMixture : public Particles {
 public:
  struct Part {
    std::shared_ptr<const MieParticles> spheres;
    double number =
        0.0;  ///< in any unit, of all spheres of the distribution, those beyond its range included
    double shape_error = 0.0;  ///< of light that they scatter, relative, where the particles are no spheres
  };
  explicit ParticleMixture(std::vector<Part> parts);  ///< one at least
  AerosolProperties properties(double wavelength_um) const override;
  PhaseFunction phase_function(double wavelength_um) const override;
  double scattering_error(
      double wavelength_um) const override;  ///< mean of `shape_error` over what is scattered
  /// Cross-section of all spheres together, um^2 times the unit of the numbers.
  double extinction_um2(double wavelength_um) const;

 private:
  std::vector<Part> parts_;
  double reference_um2_ = 1.0;
};

}  // namespace ifov::atmosphere
