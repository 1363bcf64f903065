#pragma once

#include <memory>
#include <span>
#include <vector>

#include "transport/sky/adjacent_ground.h"

namespace ifov::atmosphere {
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
/// `spreads`: by channel; `spherical_albedo`: of the air, by node. Null where the ground is everywhere as the surroundings are, where the camera sees none, or
/// where the scene's trees are made only when rays come near (World::Storage::chunks). The same for any number of
/// threads.
std::shared_ptr<const transport::AdjacentGround> adjacent_ground(
    const transport::SpectralScene& scene, std::span<const double> spherical_albedo,
    const std::vector<atmosphere::ChannelSpread>& spreads, const sensor::Camera& camera, int threads);

}  // namespace ifov::render
