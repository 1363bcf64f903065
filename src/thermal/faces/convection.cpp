#include "thermal/faces/convection.h"

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

constexpr double kFlat_rad = 8.0 * std::numbers::pi / 180.0, kWindward_rad = 100.0 * std::numbers::pi / 180.0;

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

double forced_convection(double wind_m_s, double windward) {
  if (windward == 1.0) return 3.26 * std::pow(wind_m_s, 0.89);
  if (windward == 0.0) return 3.55 * std::pow(wind_m_s, 0.617);
  return std::lerp(forced_convection(wind_m_s, 0.0), forced_convection(wind_m_s, 1.0), windward);
}

Coefficient convection(double warmer_k, double cos_tilt, double forced, Roughness roughness) {
  const Coefficient natural = natural_convection(warmer_k, cos_tilt);
  const double factor = roughness_factor(roughness);
  const double both = std::sqrt(natural.h_w_m2_k * natural.h_w_m2_k + forced * forced);
  const double by_natural = both > 0.0 ? 1.0 + factor * (natural.h_w_m2_k / both - 1.0) : 1.0;
  return {natural.h_w_m2_k + factor * (both - natural.h_w_m2_k), natural.slope_w_m2_k2 * by_natural};
}

bool faces_wind(double tilt_rad, double azimuth_rad, double wind_from_rad) {
  if (tilt_rad < kFlat_rad) return true;
  return std::abs(std::remainder(azimuth_rad - wind_from_rad, 2.0 * std::numbers::pi)) <= kWindward_rad;
}

double windward_share(double tilt_rad, double azimuth_rad, double wind_from_rad, double spread_rad) {
  if (tilt_rad < kFlat_rad) return 1.0;
  if (std::isnan(wind_from_rad)) return kWindward_rad / std::numbers::pi;
  if (!(spread_rad > 0.0)) return faces_wind(tilt_rad, azimuth_rad, wind_from_rad) ? 1.0 : 0.0;
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double apart_rad = std::remainder(azimuth_rad - wind_from_rad, kTurn_rad);
  const double scale = 1.0 / (std::numbers::sqrt2 * spread_rad);
  // A wind that fluctuates past all sides comes round again.
  const int turns = 1 + static_cast<int>(std::ceil(6.0 * spread_rad / kTurn_rad));
  double share = 0.0;
  for (int turn = -turns; turn <= turns; ++turn) {
    const double middle_rad = apart_rad + turn * kTurn_rad;
    share += 0.5 * (std::erf((middle_rad + kWindward_rad) * scale) -
                    std::erf((middle_rad - kWindward_rad) * scale));
  }
  return share;
}

}  // namespace ifov::thermal
