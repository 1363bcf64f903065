#pragma once

#include "materials/bsdf/bsdf.h"

namespace ifov::materials {

/// Whether highlights of the Sun may be far smaller than the thing that shows them.
inline bool has_narrow_lobe(const Bsdf& bsdf) {
  constexpr double kWide = 0.3;  // a tenth of a ball shows a highlight of this slope
  const double least = bsdf.lobe_slopes().least;
  return least > 0.0 && least < kWide;
}

/// Paths find what a lobe of this slope throws on other surfaces, not what a narrower one does.
inline constexpr double kLeastFoundSlope = 0.1;

/// Whether sunlight that a lobe throws on other surfaces is met so seldom that paths do not know how seldom.
inline bool throws_rarely(const Bsdf& bsdf) {
  const double least = bsdf.lobe_slopes().least;
  return least > 0.0 && least < kLeastFoundSlope;
}

/// Whether sunlight that comes through is thrown in a lobe so narrow that paths meet it too seldom to know how seldom: a lobe that facets of
/// kLeastFoundSlope reflect is twice as wide as their slope.
inline bool passes_rarely(const Bsdf& bsdf) {
  const double spread = bsdf.passed_spread();
  return spread > 0.0 && spread < 2.0 * kLeastFoundSlope;
}

}  // namespace ifov::materials
