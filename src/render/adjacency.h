#pragma once

#include <memory>

#include "transport/sky/adjacent_ground.h"

namespace ifov::atmosphere {
class SensorAtmosphere;
struct ChannelSpread;
}  // namespace ifov::atmosphere
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// The ground of a scene spread by the air over what a camera sees (docs/theory/atmosphere_adjacency.md), with its error.
/// `spreads`: by channel. Null where the ground is everywhere as the surroundings are, where the camera sees none, or
/// where the scene's trees are made only when rays come near (World::Storage::chunks). The same for any number of
/// threads.
std::unique_ptr<const transport::AdjacentGround> adjacent_ground(
    const transport::SpectralScene& scene, const atmosphere::SensorAtmosphere& air,
    const std::vector<atmosphere::ChannelSpread>& spreads, const sensor::Camera& camera, int threads);

}  // namespace ifov::render
