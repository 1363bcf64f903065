#pragma once

#include <numbers>
#include <vector>

#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/shell_orders.h"

namespace ifov::atmosphere {

/// A place on a ray: between boundaries `layer` and `layer` + 1 of layers, and between altitudes `low` and `low` + 1.
struct ShellOrders::End {
  double length = 0.0, radius_start = 0.0, inverse_radius = 0.0;
  std::size_t layer = 0, low = 0;
  double mu = 0.0;          ///< of the ray with the vertical there
  double below = 0.0;       ///< share of boundary `layer` + 1
  double high_share = 0.0;  ///< share of altitude `low` + 1
};
struct ShellOrders::Piece {
  double molecules, rest;  ///< albedos
  double first, second;    ///< 3 and 5 times the aerosol's moments
  LinearSource step;
  /// The aerosol's phase function, of Legendre's P_1 and P_2 of the scattering angle's cosine.
  double aerosol(double p1, double p2) const {
    return (1.0 + first * p1 + second * p2) * 0.25 / std::numbers::pi;
  }
};
/// Pieces from the observer on, and their ends.
struct ShellOrders::Ray {
  std::vector<Piece> pieces;
  std::vector<End> ends;
  /// [angle][azimuth][end]: zenith angle of the Sun, and cosine of the ray with the horizontal towards it.
  std::vector<float> sun_rad, sunward;
};

}  // namespace ifov::atmosphere
