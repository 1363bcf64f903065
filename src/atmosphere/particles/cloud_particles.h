#pragma once

#include <memory>

#include "atmosphere/particles/mie_particles.h"

namespace ifov::atmosphere {

inline constexpr double kWaterDensity_g_m3 = 1e6, kIceDensity_g_m3 = 0.917e6;

/// Droplets: spheres of water (Segelstein 1981), of a gamma distribution of this effective radius and variance. Their light is
/// Mie's, with its polarization.
std::shared_ptr<const MieParticles> droplets(double effective_radius_um, double effective_variance);

/// What of droplets and crystals of the same effective radius other tables have, relative to ours: what holds the difference from
/// Hu and Stamnes (1993) and Slingo (1989), and from Fu (1996), from 0.25 to 3.8 um (tests/atmosphere/test_cloud_error.cpp).
ParticleError droplet_error(double wavelength_um);
ParticleError crystal_error(double wavelength_um);

/// Rough ice crystals of many shapes, effective radius 3/4 of their volume over their mean projected area.
///
/// Extinction and absorption are those of spheres of ice (Warren and Brandt 2008) with the same ratio of volume to area, and
/// as much area: to within some per cent those of hexagonal columns and plates from 0.2 to 25 um (Neshyba, Grenfell and Warren
/// 2003, J. Geophys. Res. 108, 4448). Their asymmetry is not; that of crystals is taken to be
///   g = g_s - (g_s(0.65 um) - 0.75) T,   T = (2 w - 1 - R) / (1 - R),
/// g_s and w of the spheres, T the share of light that meets a crystal and comes out of it again, R = 0.06 what its surface
/// reflects (the same for all convex bodies in random orientation: van de Hulst 1957, ch. 8), and 0.75 as rough aggregates of
/// columns have it (Platnick et al. 2017, IEEE Trans. Geosci. Remote Sens. 55, 502; Yang et al. 2013, J. Atmos. Sci. 70, 330).
///
/// Half of what crystals take is diffracted: that share of what they scatter, 1 / (2 w), has the pattern of discs of the spheres'
/// radii (van de Hulst 1957, ch. 8.3), and the rest is Henyey and Greenstein's function of what asymmetry is left. No halos;
/// light that is scattered has no polarization.
class IceCrystals : public Particles {
 public:
  /// InputError for what MieParticles refuses.
  IceCrystals(double effective_radius_um, double effective_variance);
  AerosolProperties properties(double wavelength_um) const override;
  PhaseFunction phase_function(double wavelength_um) const override;
  ParticleError cloud_error(double wavelength_um) const override { return crystal_error(wavelength_um); }
  const MieParticles& spheres() const { return spheres_; }

 private:
  /// Of what is scattered, the part that is diffracted, its asymmetry, and that of the rest.
  struct Parts {
    double diffracted = 0.5, of_diffracted = 1.0, of_rest = 0.5;
    double asymmetry() const { return diffracted * of_diffracted + (1.0 - diffracted) * of_rest; }
  };
  Parts parts(const AerosolProperties& of_spheres, double wavelength_um) const;
  double size_parameter(double wavelength_um) const;  ///< of the effective radius
  /// Light diffracted by discs of the spheres' radii over that straight ahead; z: size parameter times sine.
  double diffracted(double z) const;

  MieParticles spheres_;
  double excess_ = 0.0;            ///< of the spheres' asymmetry where they absorb nothing
  double mean_inverse_ = 1.0;      ///< mean of effective radius over radius, weighted with area
  std::vector<double> logarithm_;  ///< of `diffracted`, at equal steps of ln z
};

/// Extinction at 550 nm, m2/g, of a substance of this density.
double mass_extinction_m2_g(const MieParticles& spheres, double density_g_m3);

}  // namespace ifov::atmosphere
