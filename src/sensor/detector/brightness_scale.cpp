#include "sensor/detector/brightness_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifov::sensor {
namespace {

constexpr int kSteps = 320;
constexpr double kColdest_k = 50.0, kHottest_k = 5000.0;
/// Of radiance: less may be rounded.
constexpr double kFaintest = 1e-250;

}  // namespace

BrightnessScale::BrightnessScale(const radiometry::Channel& channel) : channel_(channel) {
  for (int k = 0; k <= kSteps; ++k) {
    const double kelvin = kColdest_k * std::pow(kHottest_k / kColdest_k, static_cast<double>(k) / kSteps);
    const double radiance = radiometry::channel_planck_w_m2_sr_um(channel, kelvin);
    if (!(radiance > kFaintest)) continue;
    log_radiance_.push_back(std::log(radiance));
    per_kelvin_.push_back(1.0 / kelvin);
  }
}

double BrightnessScale::kelvin(double radiance_w_m2_sr_um) const {
  if (!(radiance_w_m2_sr_um > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const double x = std::log(radiance_w_m2_sr_um);
  if (log_radiance_.size() < 4 || x < log_radiance_.front() || x > log_radiance_.back())
    return radiometry::channel_brightness_temperature_k(channel_, radiance_w_m2_sr_um);
  // The cubic through four points about it: 1/T is nearly straight over the logarithm, by Wien's law.
  const auto above = std::upper_bound(log_radiance_.begin(), log_radiance_.end(), x) - log_radiance_.begin();
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(log_radiance_.size()) - 4));
  double sum = 0.0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (x - log_radiance_[j]) / (log_radiance_[i] - log_radiance_[j]);
    sum += weight * per_kelvin_[i];
  }
  return 1.0 / sum;
}

}  // namespace ifov::sensor
