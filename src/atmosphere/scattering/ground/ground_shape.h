#pragma once

#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "radiometry/stokes.h"

namespace ifov::atmosphere {

/// Light that leaves ground in one azimuthal mode, or comes down on it: [component of (I, Q, U)][direction]. I and Q go as
/// cos(mode azimuth), U as sin.
using GroundLight = std::vector<double>;

/// The light that leaves a ground, all modes, for an exitance of pi: a mean radiance of 1.
struct GroundShape {
  GaussNodes out;
  int components = 1;
  std::vector<GroundLight> modes;
  /// Radiance towards a direction (mu > 0): cubic in mu between nodes, held beyond the outermost.
  radiometry::StokesVector radiance(double mu, double azimuth_rad) const;
};

}  // namespace ifov::atmosphere
