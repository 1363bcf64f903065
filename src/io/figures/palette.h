#pragma once

#include <array>
#include <cstddef>

#include "io/figures/canvas.h"

namespace ifov::io {

/// M. Okabe and K. Ito (Color universal design, 2008): told apart by colour-blind readers too.
inline constexpr Ink kBlueInk{0.00, 0.45, 0.70}, kRedInk{0.84, 0.37, 0.00}, kGreenInk{0.00, 0.62, 0.45},
    kPurpleInk{0.80, 0.47, 0.65}, kSkyInk{0.34, 0.71, 0.91}, kOrangeInk{0.90, 0.62, 0.00};
inline constexpr std::array kCurveInks{kBlueInk, kRedInk, kGreenInk, kPurpleInk, kSkyInk, kOrangeInk};

/// Of the k-th of many curves: colours repeat, dark the second time and light from then on.
constexpr Ink curve_ink(std::size_t k) {
  const Ink base = kCurveInks[k % kCurveInks.size()];
  const std::size_t round = k / kCurveInks.size();
  const double share = round == 0 ? 0.0 : 0.45, towards = round == 1 ? 0.0 : 1.0;
  const auto blend = [&](double value) { return value + share * (towards - value); };
  return {blend(base.red), blend(base.green), blend(base.blue)};
}

}  // namespace ifov::io
