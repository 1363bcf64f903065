#pragma once

#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace ifov::sampling {

/// Random rays that have looked at a pixel. A lattice counts for nothing: it has no probability.
struct RandomLooks {
  std::vector<int> grids;    ///< sides of jittered grids over the pixel, one ray to a cell
  double independent = 0.0;  ///< rays anywhere in the pixel besides
  friend bool operator<(const RandomLooks& a, const RandomLooks& b) {
    return std::tie(a.grids, a.independent) < std::tie(b.grids, b.independent);
  }
};

/// Chance that no ray meets a square of the given area (share of a pixel), upright and anywhere with equal chance; the
/// pixels around are taken to be looked at in the same way.
double chance_missed(const RandomLooks& looks, double area);

/// The area that is met with a probability of 0.95; 1 where that would be a whole pixel or more.
class Detection {
 public:
  float missable_fraction(const RandomLooks& looks);

 private:
  std::map<RandomLooks, float> known_;
};

}  // namespace ifov::sampling
