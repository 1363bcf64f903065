#pragma once

#include <cstdint>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

/// Pixels [x0, x1) x [y0, y1).
struct FieldRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Detail of a rectangle of pixels that need not be searched for.
struct KnownDetail {
  std::vector<FocalPoint> points;     ///< one in each part of the picture that a pixel is known to hold
  std::vector<std::uint8_t> full;     ///< by pixel, row by row: 1 where it holds too many parts to name
  std::vector<FocalPoint> standouts;  ///< where something is known to stand out from all about it
};

}  // namespace ifov::sampling
