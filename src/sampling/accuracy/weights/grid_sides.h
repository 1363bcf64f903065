#pragma once

#include <cmath>
#include <compare>

namespace ifov::sampling {

/// Cells of a grid over a pixel, across and down.
struct GridSides {
  int columns = 0, rows = 0;

  static GridSides square(int side) { return {side, side}; }
  friend auto operator<=>(const GridSides&, const GridSides&) = default;

  /// Even sides of a grid of `count` cells or a few more: as long as each other, or one of them by two cells longer, across where `wide`.
  static GridSides even(double count, bool wide) {
    int longer = 2 * static_cast<int>(std::ceil(0.5 * std::sqrt(count) - 1e-9));
    if (longer < 2) longer = 2;
    const int shorter = longer > 2 && longer * (longer - 2.0) >= count ? longer - 2 : longer;
    return wide ? GridSides{longer, shorter} : GridSides{shorter, longer};
  }
};

}  // namespace ifov::sampling
