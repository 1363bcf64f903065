#pragma once

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "sampling/accuracy/weights/grid_sides.h"

namespace ifov::sampling {

/// Random rays that a pixel has had. A lattice counts for nothing: it has no probability.
struct RandomRays {
  std::vector<GridSides> grids;  ///< jittered grids over the pixel, one ray to a cell
  double independent = 0.0;      ///< rays anywhere in the pixel besides
  friend bool operator<(const RandomRays& a, const RandomRays& b) {
    return std::tie(a.grids, a.independent) < std::tie(b.grids, b.independent);
  }
};

/// Probability that no ray meets a square of the given area (share of a pixel), upright and anywhere with equal probability;
/// the pixels around are taken to have had the same.
double probability_missed(const RandomRays& rays, double area);

/// The area that is met with a probability of 0.95; 1 where that would be a whole pixel or more.
class Detection {
 public:
  float missable_fraction(const RandomRays& rays);

 private:
  std::map<RandomRays, float> known_;
};

}  // namespace ifov::sampling
