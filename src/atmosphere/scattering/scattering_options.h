#pragma once

namespace ifov::atmosphere {

struct ScatteringOptions {
  /// Gauss nodes of the zenith angle in each hemisphere, 2 to 24; 2 nodes are 2 terms of the phase function.
  int nodes_per_hemisphere = 8;
  /// (I, Q, U), or I alone, which is wrong by up to 10 % in blue skies and three times faster.
  bool polarized = true;
  /// Degree of polarization of light that aerosol scatters by 90 degrees.
  double aerosol_polarization = 0.1;
  /// Sunlight comes down through spherical shells (Chapman), and skies are seen through them; else flat
  /// layers.
  bool spherical_earth = true;
  /// Layers are divided until a part has at most this scattering depth, or ten times this absorption depth
  /// ...
  double sublayer_depth = 0.01;
  /// ... but into this many parts at most.
  int most_sublayers = 24;
  /// Orders are added until one is below this fraction of their sum; a geometric series stands for the rest.
  double tolerance = 1e-5;
  int most_orders = 300;  ///< 1: light scattered once, no more
};

}  // namespace ifov::atmosphere
