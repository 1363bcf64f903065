#include "thermal/faces/leaf.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/weather_series.h"

namespace ifov::thermal {
namespace {

constexpr double kAirHeat_j_mol_k = 29.3, kLatentHeat_j_mol = 44100.0;
constexpr double kGusts = 1.4, kHeat = 0.135, kVapour = 0.147, kFree = 0.05;
constexpr double kOfWidth = 0.72;

}  // namespace

double leaf_forced_convection(double wind_m_s, double width_m) {
  return kAirHeat_j_mol_k * kGusts * kHeat * std::sqrt(wind_m_s / (kOfWidth * width_m));
}

Coefficient leaf_convection(double warmer_k, double cos_tilt, double forced_w_m2_k, double width_m) {
  const bool stable = warmer_k * cos_tilt < 0.0;
  const double size_k = std::max(std::abs(warmer_k), 1e-9);
  const double free = kAirHeat_j_mol_k * kFree * (stable ? 1.0 - 0.5 * std::abs(cos_tilt) : 1.0) *
                      std::pow(size_k / (kOfWidth * width_m), 0.25);
  const double h = std::cbrt(forced_w_m2_k * forced_w_m2_k * forced_w_m2_k + free * free * free);
  // dh / dT = (free / h)^2 d free / dT
  return {h, std::copysign(free * free * free / (4.0 * size_k * h * h), warmer_k)};
}

LatentHeat leaf_latent_heat(const Leaf& leaf, double surface_k, const MoistAir& air,
                            const Coefficient& of_one_face, const Coefficient& of_other) {
  constexpr double kStep_k = 1e-3;
  const double deficit_pa = atmosphere::saturation_pressure_pa(surface_k) - air.vapour_pa;
  const double by_temperature = (atmosphere::saturation_pressure_pa(surface_k + kStep_k) -
                                 atmosphere::saturation_pressure_pa(surface_k - kStep_k)) /
                                (2.0 * kStep_k);
  const bool is_dew = deficit_pa < 0.0;
  constexpr double kVapourByHeat = kVapour / (kHeat * kAirHeat_j_mol_k);
  const double stomata = leaf.stomatal_mol_m2_s;
  LatentHeat sum;
  const double scale = kLatentHeat_j_mol / air.pressure_pa;
  // Stomata of one face alone are taken to have the mean of both boundary layers before them.
  const double share = is_dew ? 1.0 : 0.5 * leaf.stomatal_faces;
  for (const Coefficient& face : {of_one_face, of_other}) {
    const double layer = kVapourByHeat * face.h_w_m2_k, layer_slope = kVapourByHeat * face.slope_w_m2_k2;
    double conductance = layer, slope = layer_slope;
    if (!is_dew) {
      const double both = layer + stomata;
      conductance = both > 0.0 ? layer * stomata / both : 0.0;
      slope = both > 0.0 ? layer_slope * stomata * stomata / (both * both) : 0.0;
    }
    sum.w_m2 += share * scale * conductance * deficit_pa;
    sum.slope_w_m2_k += share * scale * (conductance * by_temperature + slope * deficit_pa);
  }
  return sum;
}

}  // namespace ifov::thermal
