#include "thermal/wind_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::thermal {
namespace {

struct TerrainRow {
  std::string_view name;
  double roughness_m;
};
constexpr std::array<TerrainRow, kTerrains> kTerrainRows{
    {{"sea", 0.0002}, {"smooth", 0.005}, {"open", 0.03}, {"rough", 0.25}, {"suburb", 1.0}}};
constexpr double kBlending_m = 60.0;

/// ln(z / z0), of heights that the law holds for.
double log_height(double height_m, double roughness_m) {
  return std::log(std::max({height_m, kLowestWind_m, 2.0 * roughness_m}) / roughness_m);
}

}  // namespace

std::string_view name_of(Terrain terrain) { return kTerrainRows[static_cast<std::size_t>(terrain)].name; }

double roughness_length_m(Terrain terrain) {
  return kTerrainRows[static_cast<std::size_t>(terrain)].roughness_m;
}

double wind_at_m_s(double measured_m_s, const Anemometer& anemometer, double height_m, Terrain terrain) {
  const double there = roughness_length_m(anemometer.terrain), here = roughness_length_m(terrain);
  const double above = measured_m_s * log_height(kBlending_m, there) / log_height(anemometer.height_m, there);
  return above * log_height(std::min(height_m, kBlending_m), here) / log_height(kBlending_m, here);
}

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
