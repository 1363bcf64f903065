#pragma once

#include <numbers>

namespace ifov::math {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< radians

}  // namespace ifov::math
