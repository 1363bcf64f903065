#pragma once

#include <vector>

namespace ifov::studies {

namespace glint {
inline constexpr double kWavelength_um = 0.55, kIrradiance_w_m2_um = 1000.0, kSalinity = 35.0;
}  // namespace glint

/// Mean-square slope out of a square image that looks straight down on a sea under a point Sun in the zenith. `half`: tangent of the
/// view's angle at the middle of a side; facets steeper than `last` are left out.
double slope_of_glint(const std::vector<float>& radiance, int pixels, double half, double last);

}  // namespace ifov::studies
