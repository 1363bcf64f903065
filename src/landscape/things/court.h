#pragma once

#include "geometry/triangle_mesh.h"

namespace ifov::landscape {

/// Sizes of a tennis court by the ITF's Rules of Tennis, measured to the outer edges of the lines, and of the lot
/// around it. Metres.
struct CourtSize {
  static constexpr double kLength = 23.77, kDoubles_width = 10.97, kSingles_width = 8.23;
  static constexpr double kService_line = 6.40;  ///< from the net
  static constexpr double kLine = 0.05, kCentre_mark = 0.10;
  static constexpr double kPost_out = 0.914, kPost_height = 1.07, kNet_middle = 0.914;
  static constexpr double kLot_length = 36.57, kLot_width = 18.29;
};

/// A hard court with its net, centred at the origin, its length along x, its surface 3 cm above z = 0; a fence
/// posts and rails around it. Slots: surround, court, line, steel, net, concrete.
geometry::TriangleMesh court_mesh();

}  // namespace ifov::landscape
