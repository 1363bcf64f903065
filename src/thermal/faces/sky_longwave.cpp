#include "thermal/faces/sky_longwave.h"

#include <cmath>

namespace ifov::thermal {

double clear_sky_emissivity(double air_k, double vapour_pa) {
  const double water = 46.5 * 0.01 * vapour_pa / air_k;
  return 1.0 - (1.0 + water) * std::exp(-std::sqrt(1.2 + 3.0 * water));
}

double sky_emissivity(double clear, double cloud_fraction) {
  return cloud_fraction + (1.0 - cloud_fraction) * clear;
}

double sky_longwave_w_m2(double air_k, double vapour_pa, double cloud_fraction) {
  const double squared = air_k * air_k;
  return sky_emissivity(clear_sky_emissivity(air_k, vapour_pa), cloud_fraction) * kStefanBoltzmann_w_m2_k4 *
         squared * squared;
}

}  // namespace ifov::thermal
