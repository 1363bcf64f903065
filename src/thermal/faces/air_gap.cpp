#include "thermal/faces/air_gap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "thermal/faces/sky_longwave.h"

namespace ifov::thermal {
namespace {

constexpr std::array<std::string_view, kHeatFlows> kHeatFlowNames{"horizontal", "up", "down"};

double of_moving_air_w_m2_k(const AirGap& gap) {
  switch (gap.flow) {
    case HeatFlow::up: return 1.95;
    case HeatFlow::down: return 0.12 * std::pow(gap.thickness_m, -0.44);
    case HeatFlow::horizontal: break;
  }
  return 1.25;
}

}  // namespace

std::string_view name_of(HeatFlow flow) { return kHeatFlowNames[static_cast<std::size_t>(flow)]; }

double resistance_m2_k_w(const AirGap& gap) {
  constexpr double kConductivity_w_m_k = 0.025, kMean_k = 283.15;
  const double air = std::max(kConductivity_w_m_k / gap.thickness_m, of_moving_air_w_m2_k(gap));
  const double between = 1.0 / (1.0 / gap.emissivity_one + 1.0 / gap.emissivity_other - 1.0);
  const double radiation = 4.0 * kStefanBoltzmann_w_m2_k4 * kMean_k * kMean_k * kMean_k * between;
  return 1.0 / (air + radiation);
}

}  // namespace ifov::thermal
