#pragma once

#include "landscape/plants/tree.h"
#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {

/// A clipped hedge, one metre of it along x: leaves one by one around stems, denser at its surface. Segments are set
/// 1 m apart. Slots as trees.
Tree grow_hedge(const RandomStream& random);
inline constexpr double kHedge_half_width_m = 0.4, kHedge_height_m = 1.35;

/// A shrub as wide as twice its radius.
Tree grow_shrub(double radius_m, double height_m, int leaves, double leaf_length_m,
                const RandomStream& random);

}  // namespace ifov::landscape
