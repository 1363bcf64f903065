#include "studies/surfaces/glint_slopes.h"

#include <cmath>
#include <complex>

#include "materials/bsdf/sea/sea.h"
#include "radiometry/fresnel.h"
#include "radiometry/refractive_index.h"

namespace ifov::studies {

double slope_of_glint(const std::vector<float>& radiance, int pixels, double half, double last) {
  const std::complex<double> index{materials::sea_water_index(glint::kSalinity).at(glint::kWavelength_um),
                                   radiometry::refractive_index("water").k.at(glint::kWavelength_um)};
  double whole = 0.0, square = 0.0;
  for (int j = 0; j < pixels; ++j)
    for (int i = 0; i < pixels; ++i) {
      const double tangent =
          half * std::hypot(2.0 * (i + 0.5) / pixels - 1.0, 2.0 * (j + 0.5) / pixels - 1.0);
      const double view = std::atan(tangent), slope = std::tan(0.5 * view), tilt = std::cos(0.5 * view);
      if (slope > last) continue;
      const auto r = radiometry::fresnel_reflection_amplitudes(index, tilt);
      const double bsdf = static_cast<double>(radiance[static_cast<std::size_t>(j * pixels + i)]) /
                          glint::kIrradiance_w_m2_um;
      const double density =
          4.0 * std::cos(view) * std::pow(tilt, 4) * bsdf / (0.5 * (std::norm(r.p) + std::norm(r.s)));
      // Of slopes by that of tangents, each of the plane.
      const double area =
          tangent > 0.0 ? slope * (1.0 + slope * slope) / (2.0 * tangent * (1.0 + tangent * tangent)) : 0.25;
      whole += density * area;
      square += density * area * slope * slope;
    }
  return square / whole;
}

}  // namespace ifov::studies
