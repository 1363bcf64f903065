#pragma once

#include <vector>

#include "math/vec3.h"
#include "thermal/surface_balance.h"

namespace ifov::studies {

/// A box on the ground about the origin, by its outline alone: nothing of the program's rays. For shadows in tests and studies.
struct OutlinedBox {
  double half_x_m, half_y_m, top_m;

  /// Whether it stands in a direction from a place on the ground, or about the place.
  bool is_in(double x_m, double y_m, math::Vec3 direction) const;
  /// The share of the sky beside it that is free, by cosines.
  double free_sky(double x_m, double y_m) const;
  /// Shares of the Sun's disc that it leaves free at a place, by row; means over what is linear between rows.
  std::vector<double> free_sun(const thermal::OutdoorsSeries& series, double x_m, double y_m) const;
};

/// Towards the Sun, east, north and up.
math::Vec3 to_sun(const thermal::Outdoors& now);

}  // namespace ifov::studies
