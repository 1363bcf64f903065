#pragma once

#include <optional>
#include <vector>

#include "atmosphere/scattering/sun_cell.h"

namespace ifov::atmosphere {

/// Directions of the sky's table: zenith angles from 0 to just below 90 degrees, azimuths from the Sun's, 0
/// to pi (the sky is symmetric about the Sun's plane). Between them the sky is linear in both angles; below
/// the last zenith angle it stays as it is there.
struct SkyDirections {
  std::vector<double> zenith_rad, azimuth_rad;
  /// Every 10 degrees, closer at the horizon and around the Sun.
  static SkyDirections standard(std::optional<double> sun_zenith_rad);
  /// The cells beside the Sun; none where no direction of the table is the Sun's.
  SunCell sun_cell(double sun_zenith_rad) const;
  /// What each direction of the table, [zenith][azimuth], counts in the irradiance of a level surface, sr.
  std::vector<double> level_weights() const;
};

}  // namespace ifov::atmosphere
