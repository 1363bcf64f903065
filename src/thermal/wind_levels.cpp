#include "thermal/wind_levels.h"

#include <algorithm>
#include <cmath>

namespace ifov::thermal {

WindLevels::WindLevels(Terrain terrain)
    : roughness_m_(roughness_length_m(terrain)), lowest_ln_(log_height(0.0, roughness_m_)) {
  const double all = std::log(log_height(kBlending_m, roughness_m_) / lowest_ln_);
  highest_ = static_cast<int>(std::ceil(all / std::log(kMostRatio)));
  ln_ratio_ = all / highest_;
}

double WindLevels::height_m(int level) const {
  return level == 0 ? 0.0 : roughness_m_ * std::exp(lowest_ln_ * std::exp(level * ln_ratio_));
}

double WindLevels::place(double height_m) const {
  const double wind = log_height(std::min(height_m, kBlending_m), roughness_m_) / lowest_ln_;
  return std::clamp(std::log(wind) / ln_ratio_, 0.0, static_cast<double>(highest_));
}

}  // namespace ifov::thermal
