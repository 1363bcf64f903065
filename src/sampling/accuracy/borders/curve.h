#pragma once

#include <cstdint>

#include "sampling/random.h"

namespace ifov::sampling {

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

struct CurveEnds {
  Point2 a, b;
};

/// Where a curve runs: its ends, the sagitta of its arc over their chord (0 for straight legs).
struct CurveShape {
  Point2 a, b;
  double chord = 0.0, sagitta = 0.0;
};

}  // namespace ifov::sampling
