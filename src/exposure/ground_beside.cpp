#include "exposure/ground_beside.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "exposure/past_scene.h"

namespace ifov::exposure {
namespace {

constexpr int kDirections = 8, kLeastDrops = 5;
constexpr double kStep_m = 0.5, kFarthest_m = 60.0, kNarrow_m = 1e-3;

/// The ground at the foot of the first drop along a direction.
std::optional<double> foot_m(const PastScene& scene, math::Point3 place_m, double turn_rad, double least_m) {
  const auto at = [&](double along_m) {
    return scene.ground_m(place_m.x + along_m * std::sin(turn_rad), place_m.y + along_m * std::cos(turn_rad),
                          place_m.z + kFarthest_m);
  };
  double last_m = 0.0, height_m = place_m.z;
  for (double along_m = kStep_m; along_m <= kFarthest_m; along_m += kStep_m) {
    const std::optional<double> next = at(along_m);
    if (!next) continue;
    double near_m = last_m, far_m = along_m, foot = *next;
    while (height_m - foot > least_m && far_m - near_m > kNarrow_m) {
      const double middle_m = 0.5 * (near_m + far_m);
      const std::optional<double> ground = at(middle_m);
      if (ground && height_m - *ground > least_m)
        far_m = middle_m, foot = *ground;
      else
        near_m = middle_m, height_m = ground.value_or(height_m);
    }
    if (height_m - foot > least_m) return foot;
    last_m = along_m;
    height_m = *next;
  }
  return std::nullopt;
}

}  // namespace

double height_above_ground_beside_m(const PastScene& scene, math::Point3 place_m, double least_m) {
  std::vector<double> feet_m;
  for (int k = 0; k < kDirections; ++k)
    if (const auto foot = foot_m(scene, place_m, 2.0 * std::numbers::pi * (k + 0.5) / kDirections, least_m))
      feet_m.push_back(*foot);
  if (feet_m.size() < kLeastDrops) return 0.0;
  std::nth_element(feet_m.begin(), feet_m.begin() + feet_m.size() / 2, feet_m.end());
  return std::max(0.0, place_m.z - feet_m[feet_m.size() / 2]);
}

}  // namespace ifov::exposure
