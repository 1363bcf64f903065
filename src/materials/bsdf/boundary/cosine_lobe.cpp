#include "materials/bsdf/boundary/cosine_lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::materials {
namespace {

constexpr std::size_t kLobeSteps = 256;

}  // namespace

CosineLobe::CosineLobe(const std::function<double(double cosine)>& level) {
  constexpr double kFloor = 1e-9;
  below_.push_back(0.0);
  for (std::size_t k = 0; k <= kLobeSteps; ++k) {
    const double t = static_cast<double>(k) / kLobeSteps, cosine = t * t;
    height_.push_back((std::max(0.0, level(cosine)) + kFloor) * cosine * 2.0 * t);
    if (k > 0) below_.push_back(below_.back() + 0.5 * (height_[k - 1] + height_[k]) / kLobeSteps);
  }
  const double whole = below_.back();
  for (double& height : height_) height /= whole;
  for (double& share : below_) share /= whole;
}

math::Vec3 CosineLobe::sample(sampling::Point2 u) const {
  const auto above =
      static_cast<std::size_t>(std::upper_bound(below_.begin(), below_.end(), u.x) - below_.begin());
  const std::size_t k = std::clamp<std::size_t>(above, 1, kLobeSteps) - 1;
  const double a = height_[k], b = height_[k + 1], left = std::max(0.0, u.x - below_[k]) * kLobeSteps;
  // a s + (b - a) s^2 / 2 = left
  const double root = a + std::sqrt(std::max(0.0, a * a + 2.0 * (b - a) * left));
  const double step = root > 0.0 ? std::min(1.0, 2.0 * left / root) : 0.0;
  const double t = (static_cast<double>(k) + step) / kLobeSteps, cosine = t * t;
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), turn = 2.0 * std::numbers::pi * u.y;
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

double CosineLobe::density(double cosine) const {
  if (!(cosine > 0.0)) return 0.0;
  const double t = std::sqrt(std::min(1.0, cosine)), at = t * kLobeSteps;
  const auto k = std::min(static_cast<std::size_t>(at), kLobeSteps - 1);
  const double height = height_[k] + (at - static_cast<double>(k)) * (height_[k + 1] - height_[k]);
  return height / (2.0 * t * 2.0 * std::numbers::pi);
}

sampling::Point2 CosineLobe::invert(math::Vec3 direction) const {
  const double at = std::sqrt(std::clamp(direction.z, 0.0, 1.0)) * kLobeSteps;
  const auto k = std::min(static_cast<std::size_t>(at), kLobeSteps - 1);
  const double s = at - static_cast<double>(k);
  const double share = below_[k] + s * (height_[k] + 0.5 * s * (height_[k + 1] - height_[k])) / kLobeSteps;
  const double turn = std::atan2(direction.y, direction.x) / (2.0 * std::numbers::pi);
  return {share, turn < 0.0 ? turn + 1.0 : turn};
}

}  // namespace ifov::materials
