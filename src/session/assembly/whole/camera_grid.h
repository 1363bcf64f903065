#pragma once

#include <vector>

#include "geometry/world.h"

namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// What a grid of `across` x `across` rays over the whole image, and `margin_px` more on each side, meets: row by row, the
/// middle of a cell each.
std::vector<geometry::SurfacePoint> hits_of_camera(const geometry::World& world, const sensor::Camera& camera,
                                                   int across, std::vector<math::Ray>* rays = nullptr,
                                                   double margin_px = 0.0);

}  // namespace ifov::session
