#pragma once

#include <cstdint>
#include <vector>

#include "render/wings/wing_spots.h"

namespace ifov {
class CancelToken;
}
namespace ifov::render {

/// Boxes about the places of maps that outshine what lies around them, which pieces of surface do not tell: pixels of the picture, and
/// beside it as far as WingSpots::kOutside_px, in which a map's highest number is 3 times as bright as the middle. Looked for where some
/// surface with maps may shine so (transport::ShiningParts), by a ray a pixel. Throws Cancelled.
std::vector<WingSpots::Box> shining_map_places(const transport::SpectralScene& scene,
                                               const sensor::Camera& camera, std::uint64_t seed,
                                               const CancelToken* cancel, sampling::Field& field);

}  // namespace ifov::render
