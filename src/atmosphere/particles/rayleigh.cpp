#include "atmosphere/particles/rayleigh.h"

#include <numbers>

namespace ifov::atmosphere {

double air_refractivity(double wavelength_um, double co2_ppm) {
  const double s = 1.0 / (wavelength_um * wavelength_um);
  const double with_300_ppm = 1e-8 * (8060.51 + 2480990.0 / (132.274 - s) + 17455.7 / (39.32957 - s));
  return with_300_ppm * (1.0 + 0.54 * (1e-6 * co2_ppm - 0.0003));
}

double king_factor(double wavelength_um, double co2_ppm) {
  const double s = 1.0 / (wavelength_um * wavelength_um);
  const double nitrogen = 1.034 + 3.17e-4 * s;
  const double oxygen = 1.096 + 1.385e-3 * s + 1.448e-4 * s * s;
  const double co2_percent = 1e-4 * co2_ppm;
  return (78.084 * nitrogen + 20.946 * oxygen + 0.934 * 1.0 + co2_percent * 1.15) /
         (78.084 + 20.946 + 0.934 + co2_percent);
}

double rayleigh_depolarization(double wavelength_um, double co2_ppm) {
  const double f = king_factor(wavelength_um, co2_ppm);
  return 6.0 * (f - 1.0) / (3.0 + 7.0 * f);
}

double rayleigh_cross_section_cm2(double wavelength_um, double co2_ppm) {
  constexpr double kMoleculesCm3 = 2.546899e19;  // at 288.15 K and 1013.25 hPa
  constexpr double kPi3 = std::numbers::pi * std::numbers::pi * std::numbers::pi;
  const double n = 1.0 + air_refractivity(wavelength_um, co2_ppm);
  const double lorentz = (n * n - 1.0) / (n * n + 2.0);
  const double wavelength_cm = 1e-4 * wavelength_um;
  const double wavelength2 = wavelength_cm * wavelength_cm;
  return 24.0 * kPi3 * lorentz * lorentz / (wavelength2 * wavelength2 * kMoleculesCm3 * kMoleculesCm3) *
         king_factor(wavelength_um, co2_ppm);
}

}  // namespace ifov::atmosphere
