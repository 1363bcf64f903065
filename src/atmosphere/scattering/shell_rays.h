#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/shell_orders.h"

namespace ifov::atmosphere {

/// A place on a ray: between boundaries `layer` and `layer` + 1 of layers, and between altitudes `low` and `low` + 1.
struct ShellOrders::End {
  double length = 0.0, radius_start = 0.0, inverse_radius = 0.0;
  std::size_t layer = 0, low = 0;
  double mu = 0.0, level = 1.0;  ///< cosine and sine of the ray with the vertical there
  double below = 0.0;            ///< share of boundary `layer` + 1
  double high_share = 0.0;       ///< share of altitude `low` + 1
};
struct ShellOrders::Piece {
  double molecules, rest;  ///< albedos
  double asymmetry;        ///< the aerosol's mean cosine
  LinearSource step;
  /// Sunlight scattered, by the cosine of the scattering angle: by molecules, and by aerosol as Henyey and Greenstein have it. Few
  /// of Legendre's polynomials would do, but for falling below 0, where the Sun is high and all light that goes up is scattered back.
  double scattered(double cosine) const { return scattered(cosine, by_aerosol(cosine)); }
  double scattered(double cosine, double aerosol) const {
    return (molecules * 0.75 * (1.0 + cosine * cosine) + rest * aerosol) * 0.25 / std::numbers::pi;
  }
  double by_aerosol(double cosine) const {
    const double root = 1.0 + asymmetry * (asymmetry - 2.0 * cosine);
    return (1.0 - asymmetry * asymmetry) / (root * std::sqrt(root));
  }
  /// Scattered light that is scattered again: its mean, and the mean of it times the cosine with the direction it goes on to. Two terms
  /// tell of a beam more than there is.
  double again(double mean, double along) const {
    return std::max(kLeast * (molecules + rest) * mean, (molecules + rest) * mean + kept() * along);
  }
  /// Of light's mean cosine with a direction.
  double kept() const { return 3.0 * asymmetry * rest; }
  /// Whether nothing is cut off, whatever the azimuth.
  bool is_whole(double mean, double along, double across) const {
    return (1.0 - kLeast) * (molecules + rest) * mean + kept() * along >= std::abs(kept() * across);
  }
  static constexpr double kLeast = 0.1;
};
/// Pieces from the observer on, and their ends.
struct ShellOrders::Ray {
  std::vector<Piece> pieces;
  std::vector<End> ends;
  /// [angle][azimuth][end]: zenith angle of the Sun, its place among the angles (number and share of the way to the next), and
  /// cosine of the ray with the horizontal towards it.
  std::vector<float> sun_rad, place, sunward;
};

}  // namespace ifov::atmosphere
