#pragma once

namespace ifov::atmosphere {

/// Molecular scattering of air after Bodhaine et al. (1999), J. Atmos. Oceanic Technol. 16, 1854-1861:
/// refractive index of Peck and Reeder (1972), King factors of Bates (1984).

/// n - 1 at 288.15 K and 1013.25 hPa.
double air_refractivity(double wavelength_um, double co2_ppm);
/// King factor F = (6 + 3 rho)/(6 - 7 rho) of dry air.
double king_factor(double wavelength_um, double co2_ppm);
/// Depolarization factor rho = 6 (F - 1)/(3 + 7 F).
double rayleigh_depolarization(double wavelength_um, double co2_ppm);
/// Scattering cross-section of a molecule, cm2.
double rayleigh_cross_section_cm2(double wavelength_um, double co2_ppm);

}  // namespace ifov::atmosphere
