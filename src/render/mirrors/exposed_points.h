#pragma once

#include <cstdint>
#include <vector>

namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

struct GlintPoint;

/// Points of light that is sought by the shapes of what stands still, at times of their exposure: what moves may pass before them, or
/// before what they show. Each becomes several of as much area together, stratified over the exposure; few where there are many
/// of them. As they were where nothing moves, the camera is exposed at one instant, or flies and was asked at several (SoughtInstants).
void spread_over_exposure(const scene::Scene& scene, const sensor::Camera& camera, std::uint64_t seed,
                          std::vector<GlintPoint>& points);

}  // namespace ifov::render
