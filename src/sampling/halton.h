#pragma once

#include <cstdint>

#include "sampling/random.h"

namespace ifov::sampling {

/// Radical inverse: the digits of `index` in `base`, mirrored at the point.
constexpr double radical_inverse(std::uint32_t index, std::uint32_t base) {
  const double inverse_base = 1.0 / base;
  double digit_value = 1.0, result = 0.0;
  for (; index != 0; index /= base) {
    digit_value *= inverse_base;
    result += digit_value * (index % base);
  }
  return result;
}

/// Element `index`, counted from 0, of the Halton sequence in bases 2 and 3 without its first point, the
/// origin (Halton 1960).
constexpr Point2 halton_point(std::uint32_t index) {
  return {radical_inverse(index + 1, 2), radical_inverse(index + 1, 3)};
}

}  // namespace ifov::sampling
