#pragma once

#include <vector>

#include "landscape/shapes/plane.h"
#include "landscape/shapes/random_stream.h"
#include "landscape/shapes/region.h"

namespace ifov::landscape {

/// Widths of what runs along a street, from the asphalt outwards; heights above the gutter. Metres.
struct StreetSection {
  static constexpr double kMainWidth = 8.4, kSideWidth = 7.0;  ///< of the asphalt
  static constexpr double kKerb = 0.15, kVerge = 1.8, kSidewalk = 1.5;
  static constexpr double kCorridor = kKerb + kVerge + kSidewalk;
  static constexpr double kKerbReturn = 6.0;  ///< radius of the corners of junctions
  static constexpr double kLand = 0.15;       ///< height of all land above the streets
};

struct Street {
  std::vector<Vec2> axis;  ///< about 1 m apart
  double width = StreetSection::kMainWidth;

  double length_m() const;
  /// The point `along_m` from its start, and the direction there (unit).
  Vec2 at(double along_m) const;
  Vec2 direction(double along_m) const;
};

/// The streets of a square, which reaches `half_m` from the origin to each side: curved ones from south to north, and
/// straight ones that end at them.
struct StreetPlan {
  double half_m = 0.0;
  std::vector<Street> mains, sides;
  Region domain, asphalt, corridor;  ///< the corridor is the asphalt with kerbs, verges and sidewalks

  /// No street's corridor (but for the rounding of corners) reaches into the footprint.
  bool is_clear(const Footprint& footprint) const;
};

StreetPlan plan_streets(double half_m, const RandomStream& random);

}  // namespace ifov::landscape
