#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "math/vec3.h"

namespace ifov::thermal {

struct NodeOfTimes;

/// The corners of one direction at one level of wind taken together, by lane. What weights are made of is a product of two things that are
/// linear in the free share f of the sky: three rows of lanes, for (1 - f)^2, f (1 - f) and f^2, none below 0.
struct DirectionOfTimes {
  struct Corner {
    const NodeOfTimes* node = nullptr;
    float share = 0.0f;
  };
  std::uint64_t of = 0;  ///< whose it is; 0: nobody's yet
  math::Vec3 normal;
  int level = 0;
  std::array<Corner, 4> corners;
  std::vector<float> shaded_k, of_sky_k;  ///< T_0 with the sky hidden, and what a free one adds
  std::vector<float> all, weight;         ///< three rows: of all bins; by bin
  std::vector<float> kernel, bent;        ///< by bin; empty until asked for
  std::vector<float> bend;                ///< their ratio within 1, where no other level is mixed in
  std::vector<float>
      row;  ///< three rows by row and side, those that were asked for; empty until the first is
  std::vector<std::uint8_t> has_row;
};

/// The ratio that SurfaceClasses::bends() goes by; of no kernel it says nothing.
inline float bend_of(float bent, float kernel) {
  constexpr float kSmall = 1e-30f;  // of a kernel, in place of 0
  return std::min(1.0f, std::max(-1.0f, bent / std::max(kernel, kSmall)));
}

}  // namespace ifov::thermal
