#pragma once

#include "thermal/faces/convection.h"

namespace ifov::thermal {

/// How a surface gives off water: the wet share of it, and what stands in the vapour's way before the air does, s/m: 0 for
/// water and wet soil, the stomata of a canopy (70 of a lawn: Allen et al. 1998, FAO Irrigation and Drainage Paper 56, eq. 5).
struct Wetness {
  double share = 0.0;
  double resistance_s_m = 0.0;
  bool operator==(const Wetness&) const = default;
};

struct MoistAir {
  double temperature_k = 0.0;
  double vapour_pa = 0.0;
  double pressure_pa = 101325.0;
};

inline constexpr double kLatentHeat_j_kg = 2.45e6;  ///< Allen et al. (1998), at 20 degrees Celsius
inline constexpr double kAirHeat_j_kg_k = 1013.0;  ///< specific heat of moist air at constant pressure, ibid.
double air_density_kg_m3(const MoistAir& air);

/// Latent heat that a surface loses, W m-2, and its derivative by the surface's temperature: rho 0.622 lambda / p (e_s(T) -
/// e) / (r_a + r_s) with r_a = rho c_p / h of the surface's own convection. With the balance of the surface, which is solved
/// here and not linearised, this is Penman and Monteith's equation (Monteith 1965; Allen et al. 1998, eq. 3). Dew (negative)
/// forms past no stomata.
struct LatentHeat {
  double w_m2 = 0.0;
  double slope_w_m2_k = 0.0;
};
LatentHeat latent_heat(const Wetness& wetness, double surface_k, const MoistAir& air,
                       const Coefficient& convection);

}  // namespace ifov::thermal
