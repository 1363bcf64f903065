#include "sensor/detector/brightness_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

namespace ifov::sensor {
namespace {

constexpr int kSteps = 320;
constexpr double kColdest_k = 50.0, kHottest_k = 5000.0;
/// Of radiance: less may be rounded.
constexpr double kFaintest = 1e-250;

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
  // The cubic through four points about it: 1/T is nearly straight over the logarithm, by Wien's law.
  const auto above = std::upper_bound(log_radiance.begin(), log_radiance.end(), x) - log_radiance.begin();
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(log_radiance.size()) - 4));
  double sum = 0.0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (x - log_radiance[j]) / (log_radiance[i] - log_radiance[j]);
    sum += weight * per_kelvin[i];
  }
  return 1.0 / sum;
}

}  // namespace ifov::sensor
