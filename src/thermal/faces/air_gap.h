#pragma once

#include <string_view>

namespace ifov::thermal {

/// Which way heat mostly goes through a layer of air: what is warm below rises, what is warm above lies still.
enum class HeatFlow { horizontal, up, down };
inline constexpr int kHeatFlows = 3;
std::string_view name_of(HeatFlow flow);  ///< "horizontal"

/// Air between two faces of a wall or a roof that does not change with that outdoors, its faces much longer than it is thick.
struct AirGap {
  double thickness_m = 0.0;
  double emissivity_one = 0.9, emissivity_other = 0.9;
  HeatFlow flow = HeatFlow::horizontal;
};
/// Thicker ones are rooms.
inline constexpr double kThickestGap_m = 0.3;

/// Resistance of it, m2 K W-1, 1 / (h_a + h_r): ISO 6946 (2007, annex B; 2017, annex D), for faces that differ by 5 K or less and
/// are at 10 degrees Celsius in the mean. h_a is the larger of conduction, 0.025 W m-1 K-1 / d, and convection: 1.25 W m-2 K-1 where
/// heat goes horizontally, 1.95 upwards and 0.12 d^-0.44 downwards; h_r = 4 sigma T^3 / (1 / e_1 + 1 / e_2 - 1).
double resistance_m2_k_w(const AirGap& gap);

}  // namespace ifov::thermal
