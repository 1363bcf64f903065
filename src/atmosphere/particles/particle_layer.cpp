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
      scale_km_(layer.scale_height_km),
      table_(layer.heights) {
  if (!table_.empty()) {
    base_km_ = table_.front().altitude_km;
    top_km_ = table_.back().altitude_km;
    for (std::size_t k = 1; k < table_.size(); ++k)
      if (!(table_[k].altitude_km > table_[k - 1].altitude_km))
        throw InputError(format("the altitudes of the {} must rise: {:g} km follows {:g} km", layer.name,
                                table_[k].altitude_km, table_[k - 1].altitude_km));
  }
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
  if (!table_.empty() && !(above_in_table(base_km_) > 0.0))
    throw InputError(format("the {} has a density of 0 at all its altitudes", layer.name));
  if (table_.empty() && !layer.top_km && !scale_km_) scale_km_ = kUsualScale_km;
}

/// The integral of the table's density from an altitude up.
double LayerHeights::above_in_table(double altitude_km) const {
  double sum = 0.0;
  for (std::size_t k = 1; k < table_.size(); ++k) {
    const auto &low = table_[k - 1], &high = table_[k];
    const double from = std::clamp(altitude_km, low.altitude_km, high.altitude_km);
    const double there = low.density + (high.density - low.density) * (from - low.altitude_km) /
                                           (high.altitude_km - low.altitude_km);
    sum += 0.5 * (there + high.density) * (high.altitude_km - from);
  }
  return sum;
}

std::vector<double> LayerHeights::boundaries_km() const {
  std::vector<double> all{base_km_};
  for (const ParticleLayer::Height& height : table_)
    if (height.altitude_km > base_km_ && height.altitude_km < top_km_) all.push_back(height.altitude_km);
  all.push_back(top_km_);
  return all;
}

/// What of a layer without an end lies above an altitude, as a share of all of it.
double LayerHeights::above(double altitude_km) const {
  const double at = std::clamp(altitude_km, base_km_, top_km_);
  if (!table_.empty()) return above_in_table(at) / above_in_table(base_km_);
  return scale_km_ ? std::exp((base_km_ - at) / *scale_km_) : (top_km_ - at) / (top_km_ - base_km_);
}

double LayerHeights::share(double low_km, double high_km) const {
  return (above(low_km) - above(high_km)) / (1.0 - above(top_km_));
}

double LayerHeights::density(double altitude_km) const {
  if (altitude_km < base_km_ || altitude_km > top_km_) return 0.0;
  for (std::size_t k = 1; k < table_.size(); ++k) {
    const auto &low = table_[k - 1], &high = table_[k];
    if (altitude_km > high.altitude_km) continue;
    const double share = (altitude_km - low.altitude_km) / (high.altitude_km - low.altitude_km);
    return (low.density + (high.density - low.density) * share) / above_in_table(base_km_);
  }
  return scale_km_ ? above(altitude_km) / (*scale_km_ * (1.0 - above(top_km_))) : 1.0 / (top_km_ - base_km_);
}

}  // namespace ifov::atmosphere
