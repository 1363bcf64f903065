#include "scene/lamp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ifov::scene {

SpotPattern::SpotPattern(math::Vec3 axis, double half_angle_rad, double edge_rad)
    : axis_(math::normalized(axis)), half_angle_rad_(half_angle_rad), edge_rad_(edge_rad) {}

double SpotPattern::relative(double angle_rad) const {
  if (angle_rad <= half_angle_rad_) return 1.0;
  if (angle_rad >= half_angle_rad_ + edge_rad_) return 0.0;
  const double t = 1.0 - (angle_rad - half_angle_rad_) / edge_rad_;
  return t * t * (3.0 - 2.0 * t);
}

double SpotPattern::at(math::Vec3 outgoing) const {
  return relative(std::atan2(math::length(math::cross(axis_, outgoing)), math::dot(axis_, outgoing)));
}

double SpotPattern::solid_angle_sr() const {
  constexpr int kSteps = 2000;  // of the edge; Simpson's rule
  double edge = 0.0;
  const double last = std::min(half_angle_rad_ + edge_rad_, std::numbers::pi);
  const double step = (last - half_angle_rad_) / kSteps;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = half_angle_rad_ + k * step;
    const double weight = k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    edge += weight * relative(angle) * std::sin(angle);
  }
  return 2.0 * std::numbers::pi * ((1.0 - std::cos(half_angle_rad_)) + edge * step / 3.0);
}

GoniometerPattern::GoniometerPattern(radiometry::LuminousIntensity intensity, math::Vec3 down,
                                     math::Vec3 about)
    : intensity_(std::move(intensity)), down_(math::normalized(down)) {
  about_ = math::normalized(about - math::dot(about, down_) * down_);
  across_ = math::cross(about_, down_);  // seen from above, angles go round from `about` to the left
}

double GoniometerPattern::at(math::Vec3 outgoing) const {
  const double x = math::dot(outgoing, about_), y = math::dot(outgoing, across_);
  return intensity_.at(std::atan2(std::hypot(x, y), math::dot(outgoing, down_)), std::atan2(y, x)) /
         intensity_.highest();
}

}  // namespace ifov::scene
