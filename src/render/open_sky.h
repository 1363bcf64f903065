#pragma once

#include <vector>

namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// For TransportOptions::sky_shares: about how much of the sky that they face the surfaces of each material see, weighed by
/// cosines, where a coarse grid of the camera's rays meets them; at most 0.9, so that values never agree by
/// it alone. Materials that no ray meets have the mean of the others. Empty where the sky has no dome, or geometry would
/// have to be loaded for it.
std::vector<float> open_sky_shares(const transport::SpectralScene& scene, const sensor::Camera& camera);

}  // namespace ifov::render
