#pragma once

#include <numbers>

namespace ifov::geodesy::orbit {

inline constexpr double kPi = std::numbers::pi, kTwoPi = 2.0 * std::numbers::pi;

constexpr double square(double x) { return x * x; }
constexpr double cube(double x) { return x * x * x; }

}  // namespace ifov::geodesy::orbit
