#include "sensor/detector/brightness_scale.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <vector>

namespace ifov::sensor {
namespace {

constexpr int kSteps = 320;
constexpr double kColdest_k = 50.0, kHottest_k = 5000.0;
/// Of radiance: less may be rounded.
constexpr double kFaintest = 1e-250;

/// Through the four points of a table about one that lies before the point `above`.
double cubic(const std::vector<double>& at, const std::vector<double>& values, std::ptrdiff_t above,
             double x) {
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(at.size()) - 4));
  double sum = 0.0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (x - at[j]) / (at[i] - at[j]);
    sum += weight * values[i];
  }
  return sum;
}

}  // namespace

struct BrightnessScale::Table {
  explicit Table(const radiometry::Channel& of) : channel(of) {}

  void make() {
    for (int k = 0; k <= kSteps; ++k) {
      const double kelvin = kColdest_k * std::pow(kHottest_k / kColdest_k, static_cast<double>(k) / kSteps);
      const double radiance = radiometry::channel_planck_w_m2_sr_um(channel, kelvin);
      if (!(radiance > kFaintest)) continue;
      log_radiance.push_back(std::log(radiance));
      per_kelvin.push_back(1.0 / kelvin);
    }
  }

  const radiometry::Channel channel;
  std::once_flag is_made;
  std::vector<double> log_radiance, per_kelvin;  // rising; 1/T of each
};

BrightnessScale::BrightnessScale(const radiometry::Channel& channel)
    : table_(std::make_shared<Table>(channel)) {}

const radiometry::Channel& BrightnessScale::channel() const { return table_->channel; }

double BrightnessScale::kelvin(double radiance_w_m2_sr_um) const {
  if (!(radiance_w_m2_sr_um > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  std::call_once(table_->is_made, [this] { table_->make(); });
  const std::vector<double>&log_radiance = table_->log_radiance, &per_kelvin = table_->per_kelvin;
  const double x = std::log(radiance_w_m2_sr_um);
  if (log_radiance.size() < 4 || x < log_radiance.front() || x > log_radiance.back())
    return radiometry::channel_brightness_temperature_k(table_->channel, radiance_w_m2_sr_um);
  // 1/T is nearly straight over the logarithm, by Wien's law.
  const auto above = std::upper_bound(log_radiance.begin(), log_radiance.end(), x) - log_radiance.begin();
  return 1.0 / cubic(log_radiance, per_kelvin, above, x);
}

double BrightnessScale::radiance_w_m2_sr_um(double kelvin) const {
  if (!(kelvin > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  std::call_once(table_->is_made, [this] { table_->make(); });
  const std::vector<double>&log_radiance = table_->log_radiance, &per_kelvin = table_->per_kelvin;
  const double x = 1.0 / kelvin;
  if (log_radiance.size() < 4 || x > per_kelvin.front() || x < per_kelvin.back())
    return radiometry::channel_planck_w_m2_sr_um(table_->channel, kelvin);
  const auto above =
      std::upper_bound(per_kelvin.begin(), per_kelvin.end(), x, std::greater<>()) - per_kelvin.begin();
  return std::exp(cubic(per_kelvin, log_radiance, above, x));
}

}  // namespace ifov::sensor
