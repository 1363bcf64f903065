#include "thermal/solid.h"

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::thermal {
namespace {

constexpr double kDay_s = 86400.0;

void check_value(std::size_t index, const char* name, double value, const char* unit) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InputError(
      format("layer {}: {} is {:g} {}, expected a number above 0", index + 1, name, value, unit));
}

}  // namespace

double daily_depth_m(const SolidLayer& layer) {
  const double diffusivity = layer.conductivity_w_m_k / (layer.density_kg_m3 * layer.specific_heat_j_kg_k);
  return std::sqrt(diffusivity * kDay_s / std::numbers::pi);
}

double thermal_inertia(const SolidLayer& layer) {
  return std::sqrt(layer.conductivity_w_m_k * layer.density_kg_m3 * layer.specific_heat_j_kg_k);
}

double resistance_across_m2_k_w(const std::vector<SolidLayer>& layers) {
  double sum = 0.0;
  for (const SolidLayer& layer : layers)
    sum += layer.thickness_m / layer.conductivity_w_m_k + layer.gap_behind_m2_k_w;
  return sum;
}

void check(const Solid& solid) {
  if (solid.layers.empty()) throw InputError("expected at least one layer, found none");
  for (std::size_t i = 0; i < solid.layers.size(); ++i) {
    const SolidLayer& layer = solid.layers[i];
    check_value(i, "thickness", layer.thickness_m, "m");
    if (layer.thickness_m < kThinnestLayer_m)
      throw InputError(format("layer {}: it is {:g} um thick, expected at least {:g} um", i + 1,
                              1e6 * layer.thickness_m, 1e6 * kThinnestLayer_m));
    check_value(i, "conductivity", layer.conductivity_w_m_k, "W m-1 K-1");
    check_value(i, "density", layer.density_kg_m3, "kg m-3");
    check_value(i, "specific heat", layer.specific_heat_j_kg_k, "J kg-1 K-1");
    if (!std::isfinite(layer.gap_behind_m2_k_w) || layer.gap_behind_m2_k_w < 0.0)
      throw InputError(format("layer {}: the resistance behind it is {:g} m2 K W-1, expected 0 or above",
                              i + 1, layer.gap_behind_m2_k_w));
  }
  if (std::holds_alternative<OtherFace>(solid.back)) {
    const double across = resistance_across_m2_k_w(solid.layers);
    if (across > kMostAcross_m2_k_w)
      throw InputError(format(
          "the two faces of a sheet are taken to have one temperature, and this one's layers have a resistance of "
          "{:.3g} m2 K W-1, expected at most {:g}: say what is behind it otherwise, as a room or insulated",
          across, kMostAcross_m2_k_w));
  }
  if (!(solid.layers.back().gap_behind_m2_k_w > 0.0)) return;
  if (std::holds_alternative<Insulated>(solid.back) || std::holds_alternative<OtherFace>(solid.back))
    throw InputError("the last layer has air behind it and then nothing that heat passes to");
  if (std::holds_alternative<DeepGround>(solid.back))
    throw InputError("the last layer goes on as ground, and has air behind it");
}

}  // namespace ifov::thermal
