#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include "atmosphere/scattering/scattering_column.h"

namespace ifov::atmosphere {

inline constexpr double kEndless_km = std::numeric_limits<double>::infinity();

/// What a slant path crosses within one sublayer. Positions count from 0 at the sublayer's top to 1 at its
/// bottom.
struct PathPiece {
  std::size_t sublayer = 0;
  double near_position = 0.0, far_position = 0.0;
  double depth = 0.0, true_depth = 0.0;  ///< along the path
};

/// Visits the pieces of a straight path (flat layers) from an observer backwards along light that propagates
/// with cosine `mu` from the zenith: for mu > 0 the observer looks down. The path ends after `length_km`, at
/// the ground or in space. visit(const PathPiece&) returns false to stop.
template <class Visit>
void walk_path(const ScatteringColumn& column, double observer_km, double mu, double length_km,
               Visit&& visit) {
  const auto& altitude = column.altitude_km;
  double z = observer_km;
  if (z > altitude.front()) {
    if (mu <= 0.0) return;
    length_km -= (z - altitude.front()) / mu;
    z = altitude.front();
  }
  z = std::max(z, altitude.back());
  if (length_km <= 0.0) return;
  // The sublayer that holds z; on a boundary, the one that the path enters.
  const auto after = mu > 0.0 ? std::upper_bound(altitude.begin(), altitude.end(), z, std::greater<>())
                              : std::lower_bound(altitude.begin(), altitude.end(), z, std::greater<>());
  std::ptrdiff_t s = after - altitude.begin() - 1;
  if (mu == 0.0) s = std::clamp<std::ptrdiff_t>(s, 0, static_cast<std::ptrdiff_t>(column.sublayers()) - 1);
  const double slope = std::abs(mu);
  while (s >= 0 && s < static_cast<std::ptrdiff_t>(column.sublayers())) {
    const double top = altitude[s], bottom = altitude[s + 1], height = top - bottom;
    const double available = mu > 0.0 ? z - bottom : mu < 0.0 ? top - z : 0.0;
    const bool ends = mu == 0.0 || length_km * slope <= available;
    const double rise = !ends ? available : mu == 0.0 ? 0.0 : length_km * slope;
    const double crossed = ends ? length_km : rise / slope;
    const double next = ends ? (mu > 0.0 ? z - rise : z + rise) : (mu > 0.0 ? bottom : top);
    const double share = crossed / height;
    // 0 times infinity: an endless level path through nothing.
    const auto along = [&](double depth) { return depth > 0.0 ? depth * share : 0.0; };
    if (!visit(PathPiece{static_cast<std::size_t>(s), (top - z) / height, (top - next) / height,
                         along(column.depth[s]), along(column.true_depth[s])}) ||
        ends) {
      return;
    }
    length_km -= crossed;
    z = next;
    s += mu > 0.0 ? 1 : -1;
  }
}

}  // namespace ifov::atmosphere
