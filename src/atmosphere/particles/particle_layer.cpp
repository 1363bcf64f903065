#include "atmosphere/particles/particle_layer.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/profile/profile.h"
#include "core/error.h"
#include "core/format.h"

namespace ifov::atmosphere {

LayerHeights::LayerHeights(const ParticleLayer& layer, double ground_km)
    : base_km_(layer.base_km.value_or(ground_km)),
      top_km_(layer.top_km.value_or(kTopOfAtmosphereKm)),
      scale_km_(layer.scale_height_km) {
  constexpr double kRounding_km = 1e-6;
  if (base_km_ < ground_km - kRounding_km)
    throw InputError(format("the {} begins at {:g} km, inside the ground, which is at {:g} km", layer.name,
                            base_km_, ground_km));
  if (top_km_ > kTopOfAtmosphereKm || base_km_ >= kTopOfAtmosphereKm)
    throw InputError(format("the {} reaches to {:g} km, above the air, which ends at {:g} km", layer.name,
                            std::max(top_km_, base_km_), kTopOfAtmosphereKm));
  if (!(top_km_ > base_km_))
    throw InputError(
        format("the {} ends at {:g} km, not above its base at {:g} km", layer.name, top_km_, base_km_));
  base_km_ = std::max(base_km_, ground_km);
  if (!layer.top_km && !scale_km_) scale_km_ = kUsualScale_km;
}

/// What of a layer without an end lies above an altitude, as a share of all of it.
double LayerHeights::above(double altitude_km) const {
  const double at = std::clamp(altitude_km, base_km_, top_km_);
  return scale_km_ ? std::exp((base_km_ - at) / *scale_km_) : (top_km_ - at) / (top_km_ - base_km_);
}

double LayerHeights::share(double low_km, double high_km) const {
  return (above(low_km) - above(high_km)) / (1.0 - above(top_km_));
}

double LayerHeights::density(double altitude_km) const {
  if (altitude_km < base_km_ || altitude_km > top_km_) return 0.0;
  return scale_km_ ? above(altitude_km) / (*scale_km_ * (1.0 - above(top_km_))) : 1.0 / (top_km_ - base_km_);
}

}  // namespace ifov::atmosphere
