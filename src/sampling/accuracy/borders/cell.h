#pragma once

#include <cstdint>

namespace ifov::sampling {

/// What a cell of the quadtree is known to hold.
enum class CellKind : std::uint8_t {
  fresh,      ///< corners not looked at yet
  uniform,    ///< four equal corners
  tentative,  ///< two labels and two crossings: a chord that has not been verified
  chord,      ///< a verified chord, with its curve
  junction,   ///< three labels and three crossings: borders that meet at one point
  complex,    ///< more than a chord, small enough to be counted by its corners
  split,      ///< four children
};

/// One square of the quadtree; corners go round: (0,0), (1,0), (1,1), (0,1). Side e joins corners e and e
/// + 1.
struct Cell {
  std::int32_t x = 0, y = 0;     ///< top left corner, fine units
  std::uint32_t children = 0;    ///< first of four, row by row
  std::uint32_t chord = 0;       ///< number of its Curve or Junction, where it has one
  std::uint32_t pixel = 0;       ///< index in the domain
  std::uint32_t corner[4] = {};  ///< labels
  std::uint8_t level = 0;
  CellKind kind = CellKind::fresh;
};

/// Where the corners lie, in sides of the cell.
constexpr int kCornerX[4] = {0, 1, 1, 0}, kCornerY[4] = {0, 0, 1, 1};

/// Share of the allowed standard error that one unresolved cell may claim at first.
constexpr double kLooseCell = 0.3;
/// Standard deviation of a fraction that may be anything: 1 / sqrt(12).
constexpr double kUniformSpread = 0.28867513459481287;

/// Whether no third label is among the corners.
inline bool has_two_labels(const Cell& cell) {
  std::uint32_t other = cell.corner[0];
  for (std::uint32_t l : cell.corner) {
    if (l == cell.corner[0]) continue;
    if (other != cell.corner[0] && other != l) return false;
    other = l;
  }
  return true;
}

}  // namespace ifov::sampling
