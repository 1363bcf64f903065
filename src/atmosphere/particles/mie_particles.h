#pragma once

#include <memory>

#include "atmosphere/particles/mie.h"
#include "atmosphere/particles/particles.h"
#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

/// Spheres of one material and many sizes. What they do is worked out at wavelengths 2 % apart (the scattering matrix 8 %), each
/// when it is first asked for, and interpolated between: extinction and absorption linearly in the logarithm of wavelength, the
/// logarithm of a1 and the ratios of the other elements likewise.
class MieParticles : public Particles {
 public:
  /// `n` and `k`: index of refraction n + ik, k >= 0, and where they are known. InputError for what no sphere has, or spheres
  /// more than 50000 times as large as a wavelength over 2 pi.
  MieParticles(SizeDistribution sizes, radiometry::Spectrum n, radiometry::Spectrum k);
  ~MieParticles() override;
  AerosolProperties properties(double wavelength_um) const override;
  PhaseFunction phase_function(double wavelength_um) const override;  ///< with its polarization

  const SizeDistribution& sizes() const { return sizes_; }
  /// Extinction, scattering and asymmetry, for one sphere of the whole distribution (those beyond its range do nothing).
  MieMixture cross_sections(double wavelength_um) const;
  MieMixture matrix_at(double wavelength_um) const;  ///< a1, a3 and b1 at mie_angles()
  /// Extinction cross-section over volume, 1/um, of all spheres together.
  double extinction_per_volume(double wavelength_um) const;

 private:
  struct Kept;
  std::complex<double> index(double wavelength_um) const;
  const MieMixture& efficiencies(std::size_t node) const;
  const MieMixture& matrix(std::size_t node) const;
  /// Of a node and the next, interpolated.
  MieMixture interpolated(double wavelength_um) const;

  SizeDistribution sizes_;
  radiometry::Spectrum n_, k_;
  std::unique_ptr<Kept> kept_;
  double reference_extinction_ = 1.0;  ///< at 550 nm
  double share_within_ = 1.0;          ///< of all spheres, those in the range of sizes
};

/// Angles at which the scattering matrices of spheres are told: from steps of 0.02 degrees about the forward direction to 1.25,
/// and 0.25 about the backward one.
std::shared_ptr<const PhaseAngles> mie_angles();

}  // namespace ifov::atmosphere
