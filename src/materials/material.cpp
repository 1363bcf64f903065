#include "materials/material.h"

#include "core/error.h"

namespace ifov::materials {

void check(const Material& material) {
  constexpr double kSlack = 1e-9;
  const double low = material.reflectance.minimum(), high = material.reflectance.maximum();
  if (low < -kSlack || high > 1.0 + kSlack)
    throw InputError(
        format("material '{}': reflectance must lie between 0 and 1; it reaches from {:g} to {:g}",
               material.name, low, high));
  if (material.temperature_k && !(*material.temperature_k > 0.0))
    throw InputError(format("material '{}': a temperature must be above 0 K; found {:g} K", material.name,
                            *material.temperature_k));
}

}  // namespace ifov::materials
