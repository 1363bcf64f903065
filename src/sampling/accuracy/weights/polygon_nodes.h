#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "sampling/random.h"

namespace ifov::sampling {

class PixelFootprint;
struct Polygon;

/// Places and weights of a rule over a polygon, exact to the second degree: the midpoints of the edges of its fan of triangles,
/// none of which is longer than asked. Where triangles meet they share a place.
class PolygonNodes {
 public:
  void place(const Polygon& polygon, double longest);
  /// Integral of a footprint that stands at `centre`; the sign is that of the polygon's area.
  double over(const PixelFootprint& footprint, Point2 centre) const;

 private:
  void add(Point2 at, double weight);

  std::vector<double> x_, y_, weight_;
  mutable std::vector<double> density_;
};

}  // namespace ifov::sampling
