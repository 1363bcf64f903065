#include "sampling/accuracy/weights/polygon_nodes.h"

#include <algorithm>

#include "sampling/accuracy/borders/polygon.h"
#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

void PolygonNodes::add(Point2 at, double weight) {
  x_.push_back(at.x), y_.push_back(at.y), weight_.push_back(weight);
}

void PolygonNodes::place(const Polygon& polygon, double longest) {
  constexpr double kMostCuts = 32.0;
  x_.clear(), y_.clear(), weight_.clear();
  const Point2 o = polygon.vertex[0];
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Point2 p = polygon.vertex[i], q = polygon.vertex[i + 1];
    const double side = std::max({length(p - o), length(q - p), length(o - q)});
    const int n = static_cast<int>(std::clamp(std::ceil(side / longest), 1.0, kMostCuts));
    const Point2 u = (1.0 / n) * (p - o), v = (1.0 / n) * (q - o);
    const double weight = cross(u, v) / 6.0;
    // Edges along u, along v and across; those on the rim belong to one small triangle, others to two.
    for (int b = 0; b < n; ++b)
      for (int a = 0; a + b < n; ++a) {
        const Point2 corner = o + static_cast<double>(a) * u + static_cast<double>(b) * v;
        add(corner + 0.5 * u, b == 0 ? weight : 2.0 * weight);
        add(corner + 0.5 * v, a == 0 ? weight : 2.0 * weight);
        add(corner + 0.5 * (u + v), a + b == n - 1 ? weight : 2.0 * weight);
      }
  }
}

double PolygonNodes::over(const PixelFootprint& footprint, Point2 centre) const {
  density_.resize(x_.size());
  footprint.densities(x_, y_, centre, density_);
  double sum = 0.0;
  for (std::size_t k = 0; k < weight_.size(); ++k) sum += weight_[k] * density_[k];
  return sum;
}

}  // namespace ifov::sampling
