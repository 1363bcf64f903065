#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace ifov::atmosphere {

class GroundAtNodes;

/// Light of ground that reflects by direction, by node. It leaves such ground with an
/// exitance M = (lit + of_even B) / (1 - back), B the radiance of what the ground emits, alike in every direction, and is
/// shaped by direction as sunlight and skylight shape it. Radiances below are for M = pi.
struct DirectionalLight {
  std::vector<double> lit;      ///< M of Sun and sky alone, W m-2 um-1
  std::vector<double> of_even;  ///< of B = 1, which the air sends back
  std::vector<double> back;     ///< share of M that comes back and is reflected
  std::vector<double> albedo;   ///< of the air for this light: what comes down, over M
  std::vector<double> up,
      down;                  ///< as LevelFluxes::ground_up and ground_down, where the geometry wants them
  std::vector<double> view;  ///< scattered into the geometry's own line of sight, as view_radiance
  std::vector<double> path_i, path_q,
      path_u;                               ///< into lines of sight, [line][node]
  std::vector<double> sky_i, sky_q, sky_u;  ///< [zenith][azimuth][node]
  std::shared_ptr<const GroundAtNodes> ground;
  double exitance(std::size_t node, double emitted) const {
    return (lit[node] + of_even[node] * emitted) / (1.0 - back[node]);
  }
};

}  // namespace ifov::atmosphere
