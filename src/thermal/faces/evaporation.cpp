#include "thermal/faces/evaporation.h"

#include "atmosphere/weather_series.h"

namespace ifov::thermal {

double air_density_kg_m3(const MoistAir& air) {
  constexpr double kGas_j_kg_k = 287.05, kVapourShare = 0.378;
  return (air.pressure_pa - kVapourShare * air.vapour_pa) / (kGas_j_kg_k * air.temperature_k);
}

LatentHeat latent_heat(const Wetness& wetness, double surface_k, const MoistAir& air,
                       const Coefficient& convection) {
  constexpr double kMolarRatio = 0.622, kStep_k = 1e-3;
  if (!(wetness.share > 0.0) || !(convection.h_w_m2_k > 0.0)) return {};
  const double density = air_density_kg_m3(air);
  const double saturated = atmosphere::saturation_pressure_pa(surface_k);
  const double by_temperature = (atmosphere::saturation_pressure_pa(surface_k + kStep_k) -
                                 atmosphere::saturation_pressure_pa(surface_k - kStep_k)) /
                                (2.0 * kStep_k);
  const double air_part = density * kAirHeat_j_kg_k;
  const double resistance = saturated > air.vapour_pa ? wetness.resistance_s_m : 0.0;
  // 1 / (r_a + r_s) = h / (rho c_p + h r_s)
  const double below = air_part + convection.h_w_m2_k * resistance;
  const double conductance = convection.h_w_m2_k / below;
  const double conductance_slope = convection.slope_w_m2_k2 * air_part / (below * below);
  const double scale = wetness.share * density * kMolarRatio * kLatentHeat_j_kg / air.pressure_pa;
  const double deficit = saturated - air.vapour_pa;
  return {scale * conductance * deficit,
          scale * (conductance * by_temperature + conductance_slope * deficit)};
}

}  // namespace ifov::thermal
