#pragma once

#include "geometry/world.h"
#include "sampling/tile.h"
#include "sensor/camera.h"

namespace ifov::render {

/// Fills TileResult::position_m.
void locate_pixels(const geometry::World& world, const sensor::Camera& camera, sampling::TileResult& tile);

}  // namespace ifov::render
