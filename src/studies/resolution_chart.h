#pragma once

#include <vector>

#include "studies/common/exact_area.h"

namespace ifov::studies {

/// Resolving power target of MIL-STD-150A (1959), "USAF 1951": element E (1 to 6) of group G has
/// 2^(G + (E - 1) / 6) line pairs per millimetre, three bars of width w = half a pair, 5 w long and w apart,
/// once upright and once lying.
double line_pairs_per_mm(int group, int element);

/// Where a chart lies on the focal plane.
struct ChartPlacement {
  double centre_x_px = 0.0, centre_y_px = 0.0;
  double px_per_mm = 1.0;
  double angle_rad = 0.0;  ///< from +x towards +y
};

/// The bars of groups first_group to last_group on the focal plane, one column of elements a group.
std::vector<Outline> chart_bars(int first_group, int last_group, const ChartPlacement& placement);

/// Fraction of each pixel that outlines which do not overlap cover together, row by row.
std::vector<double> covered_fraction(const std::vector<Outline>& outlines, int width_px, int height_px);

}  // namespace ifov::studies
