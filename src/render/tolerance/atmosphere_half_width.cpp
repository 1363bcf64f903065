#include "render/tolerance/atmosphere_half_width.h"

#include <cmath>

namespace ifov::render {

double AtmosphereHalfWidth::of_model(double radiance, double before) const {
  if (!(passed > 0.0)) return model_sum(radiance);
  return passed * model_sum(std::max(radiance / passed, before));
}

double AtmosphereHalfWidth::in_interval(double radiance, double before) const {
  return model_counted > 0.0 ? of_model(radiance, before) : 0.0;
}

/// Air that absorbs less shows more of the ground and less of itself: where both are as bright nothing is seen of it, but
/// for kApart of each, because not all gases err alike.
double AtmosphereHalfWidth::model_sum(double radiance) const {
  constexpr double kApart = 0.25;
  const double from_surface = std::max(0.0, radiance - path_radiance), ground = model_surface * from_surface;
  const double contrast = std::abs(ground + model_emission),
               apart = kApart * (ground + std::abs(model_emission));
  return std::max(contrast, apart) + model_sunlight * from_surface + model_path +
         model_sky * std::min(from_surface, white_in_sky);
}

}  // namespace ifov::render
