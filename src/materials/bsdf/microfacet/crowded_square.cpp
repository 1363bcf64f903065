#include "materials/bsdf/microfacet/crowded_square.h"

#include <cmath>

namespace ifov::materials {

namespace {

double crowded_at_ends(double t) { return t * t * t * (10.0 - t * (15.0 - 6.0 * t)); }

}  // namespace

std::vector<SquarePoint> crowded_square(int across) {
  constexpr double kGolden = 0.61803398874989485;
  std::vector<SquarePoint> points;
  double whole = 0.0;
  for (int i = 0; i < across; ++i) {
    const double shift = std::fmod((i + 1) * kGolden, 1.0), s = (i + 0.5) / across;
    for (int j = 0; j < across; ++j) {
      const double t = (j + shift) / across, root = s * (1.0 - s) * t * (1.0 - t), weight = root * root;
      points.push_back({crowded_at_ends(s), crowded_at_ends(t), weight});
      whole += weight;
    }
  }
  for (SquarePoint& point : points) point.weight /= whole;
  return points;
}

}  // namespace ifov::materials
