#include "thermal/convection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ifov::thermal {
namespace {

struct RoughnessRow {
  std::string_view name;
  double factor;
};
constexpr std::array<RoughnessRow, kRoughnesses> kRoughnessRows{{{"very rough", 2.17},
                                                                 {"rough", 1.67},
                                                                 {"medium rough", 1.52},
                                                                 {"medium smooth", 1.13},
                                                                 {"smooth", 1.11},
                                                                 {"very smooth", 1.0}}};

}  // namespace

std::string_view name_of(Roughness roughness) {
  return kRoughnessRows[static_cast<std::size_t>(roughness)].name;
}

double roughness_factor(Roughness roughness) {
  return kRoughnessRows[static_cast<std::size_t>(roughness)].factor;
}

Coefficient natural_convection(double warmer_k, double cos_tilt) {
  const bool unstable = warmer_k * cos_tilt > 0.0;
  const double steep = std::abs(cos_tilt);
  const double factor = unstable ? 9.482 / (7.238 - steep) : 1.810 / (1.382 + steep);
  // The slope has no limit at equal temperatures; there h is 0, and so is what it is multiplied with.
  const double size_k = std::max(std::abs(warmer_k), 1e-9);
  const double h = factor * std::cbrt(size_k);
  return {h, std::copysign(h / (3.0 * size_k), warmer_k)};
}

double forced_convection(double wind_m_s, bool windward) {
  return windward ? 3.26 * std::pow(wind_m_s, 0.89) : 3.55 * std::pow(wind_m_s, 0.617);
}

Coefficient convection(double warmer_k, double cos_tilt, double wind_m_s, bool windward,
                       Roughness roughness) {
  const Coefficient natural = natural_convection(warmer_k, cos_tilt);
  const double forced = forced_convection(wind_m_s, windward), factor = roughness_factor(roughness);
  const double both = std::hypot(natural.h_w_m2_k, forced);
  const double by_natural = both > 0.0 ? 1.0 + factor * (natural.h_w_m2_k / both - 1.0) : 1.0;
  return {natural.h_w_m2_k + factor * (both - natural.h_w_m2_k), natural.slope_w_m2_k2 * by_natural};
}

bool faces_wind(double tilt_rad, double azimuth_rad, double wind_from_rad) {
  constexpr double kDeg = std::numbers::pi / 180.0;
  if (tilt_rad < 8.0 * kDeg) return true;
  return std::abs(std::remainder(azimuth_rad - wind_from_rad, 2.0 * std::numbers::pi)) <= 100.0 * kDeg;
}

}  // namespace ifov::thermal
