#pragma once

#include <cstdint>

#include "sampling/random.h"

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
  std::uint32_t chord = 0;       ///< index of its Curve or Junction, where it has one
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

/// The border between two labels in a cell: it runs from bracket[0] on side side[0] to bracket[1] on side
/// side[1], side[0] < side[1]. Corners side[0] + 1 ... side[1] carry label `inner`, the others `outer`.
struct Curve {
  std::uint32_t cell = 0;
  std::uint32_t bracket[2] = {};
  std::uint32_t inner = 0, outer = 0;
  std::uint8_t side[2] = {};
  bool corner = false;           ///< two straight legs that meet at the middle, instead of an arc
  Point2 origin, normal;         ///< the line on which the middle was looked for
  double low = 0.0, high = 0.0;  ///< the curve meets that line between origin + low n and origin + high n
  double bend = 0.0;             ///< where it was predicted, from the middle of the chord
  bool measured = false;      ///< it was searched for; else it is where it was predicted, within those bounds
  double middle_width = 0.0;  ///< width of the error claimed for it, px
  double leg_width = 0.0;     ///< of a corner: width of the band in which its legs were confirmed, px
  double loose_area = 0.0;    ///< standard deviation of the area that the model cannot follow, px^2
  double wanted_middle = 0.0;  ///< half-distance of the two verifying rays, set by the tolerance
};

/// Where a curve runs: its ends, the sagitta of its arc over their chord (0 for straight legs).
struct CurveShape {
  Point2 a, b;
  double chord = 0.0, sagitta = 0.0;
};

}  // namespace ifov::sampling
