#include "render/tolerance/atmosphere_half_width.h"

#include <algorithm>
#include <cmath>

namespace ifov::render {

double AtmosphereHalfWidth::sum(double of_path, double of_surface, double of_sky, double radiance) const {
  const double from_surface = std::max(0.0, radiance - path_radiance);
  return of_path + of_surface * from_surface + of_sky * std::min(from_surface, white_in_sky);
}

double AtmosphereHalfWidth::of(double radiance, double before) const {
  if (!(passed > 0.0)) return sum(path, surface, sky, radiance);
  const double all = std::max(radiance / passed, before);  // at least what would leave so much, unpolarized
  return passed * (sum(path, surface, sky, all) + of_polarization_alone(all));
}

double AtmosphereHalfWidth::of_nodes(double radiance) const {
  if (!(passed > 0.0)) return sum(nodes_path, nodes_surface, nodes_sky, radiance);
  return passed * sum(nodes_path, nodes_surface, nodes_sky, radiance / passed);
}

double AtmosphereHalfWidth::of_polarization(double radiance, double before) const {
  return passed > 0.0 ? of(radiance, before) : of(radiance) + of_polarization_alone(radiance);
}

double AtmosphereHalfWidth::of_polarization_alone(double radiance) const {
  return sum(polarization_path * path_radiance, 0.0, polarization_sky, radiance);
}

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
