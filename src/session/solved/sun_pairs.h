#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "geometry/surface_point.h"

namespace ifov::exposure {
class SolvedSurface;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// Two points that one pixel sees.
using PointsOfPixel = std::pair<geometry::SurfacePoint, geometry::SurfacePoint>;

/// How many pairs of rays to where the Sun stood an image of a surface is worth at most: where temperatures differ more within pixels than
/// rays scatter them, few. By pixels' pairs of points, the same whoever asks.
int sun_pairs_worth(const exposure::SolvedSurface& surface, std::span<const PointsOfPixel> seen);

/// Pairs of points of one material, each pair in one pixel of a grid over the image. `firsts`: by number of Scene::solved whose they count as.
std::map<std::uint32_t, std::vector<PointsOfPixel>> points_of_pixels(
    const scene::Scene& scene, const sensor::Camera& camera,
    const std::map<std::uint32_t, std::uint32_t>& firsts);

}  // namespace ifov::session
