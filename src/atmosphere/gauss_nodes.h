#pragma once

#include <vector>

namespace ifov::atmosphere {

/// Gauss-Legendre quadrature on [0, 1]: the integral of f is the sum of weight[i] f(position[i]), exact for
/// polynomials up to degree 2 count - 1. Positions rise.
struct GaussNodes {
  std::vector<double> position, weight;
};

/// Nodes to 1e-15, by Newton's method on the Legendre polynomial. count >= 1.
GaussNodes gauss_nodes(int count);

}  // namespace ifov::atmosphere
