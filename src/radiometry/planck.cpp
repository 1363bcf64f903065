#include "radiometry/planck.h"

#include <cmath>

namespace ifov::radiometry {
namespace {

constexpr double kPlanck_J_s = 6.62607015e-34;
constexpr double kLight_m_s = 299792458.0;
constexpr double kBoltzmann_J_K = 1.380649e-23;
constexpr double kFirst = 2.0 * kPlanck_J_s * kLight_m_s * kLight_m_s * 1e24;  // W m-2 sr-1 um^4
constexpr double kSecond = kPlanck_J_s * kLight_m_s / kBoltzmann_J_K * 1e6;    // um K

double fifth_power(double x) { return x * x * x * x * x; }

}  // namespace

double planck_w_m2_sr_um(double wavelength_um, double temperature_k) {
  if (!(temperature_k > 0.0)) return 0.0;
  return kFirst / (fifth_power(wavelength_um) * std::expm1(kSecond / (wavelength_um * temperature_k)));
}

double planck_slope_w_m2_sr_um_k(double wavelength_um, double temperature_k) {
  if (!(temperature_k > 0.0)) return 0.0;
  const double x = kSecond / (wavelength_um * temperature_k);
  const double radiance = planck_w_m2_sr_um(wavelength_um, temperature_k);
  return radiance == 0.0 ? 0.0 : radiance * x / temperature_k / -std::expm1(-x);
}

double brightness_temperature_k(double wavelength_um, double radiance_w_m2_sr_um) {
  if (!(radiance_w_m2_sr_um > 0.0)) return 0.0;
  const double ratio = kFirst / (fifth_power(wavelength_um) * radiance_w_m2_sr_um);
  const double x = ratio < 1e300
                       ? std::log1p(ratio)
                       : std::log(kFirst) - 5.0 * std::log(wavelength_um) - std::log(radiance_w_m2_sr_um);
  return kSecond / (wavelength_um * x);
}

}  // namespace ifov::radiometry
