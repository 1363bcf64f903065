#pragma once

#include <vector>

namespace ifov::materials {

struct SquarePoint {
  double u1, u2, weight;
};

/// Points of the unit square for integrals of what is sampled from them, and their weights, which sum to 1: rows of one u1, `across` of as many, crowded at
/// both edges (the polynomial transformation of Korobov 1963, of fifth degree), each row shifted by the golden ratio, so that edges within, beyond
/// which lobes are cut off by the horizon, meet points at all distances.
std::vector<SquarePoint> crowded_square(int across);

}  // namespace ifov::materials
