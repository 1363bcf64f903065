#include "thermal/sun_split.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::thermal {

double diffuse_share(double clearness) {
  if (clearness <= 0.22) return 1.0 - 0.09 * clearness;
  if (clearness > 0.80) return 0.165;
  return 0.9511 + clearness * (-0.1604 + clearness * (4.388 + clearness * (-16.638 + clearness * 12.336)));
}

SunAndSky split_global(double global_w_m2, double sun_elevation_rad, double sun_distance_au) {
  constexpr double kDegree = std::numbers::pi / 180.0, kLowest_rad = 3.0 * kDegree,
                   kWhole_rad = 6.0 * kDegree;
  const double global = std::max(0.0, global_w_m2);
  if (sun_elevation_rad < kLowest_rad) return {0.0, global};
  const double outside = kSolarConstant_w_m2 / (sun_distance_au * sun_distance_au);
  const double height = std::sin(sun_elevation_rad);
  const double share = diffuse_share(global / (outside * height));
  const double in_full = std::min(1.0, (sun_elevation_rad - kLowest_rad) / (kWhole_rad - kLowest_rad));
  const double direct = in_full * std::min((1.0 - share) * global / height, outside);
  return {direct, global - direct * height};
}

}  // namespace ifov::thermal
