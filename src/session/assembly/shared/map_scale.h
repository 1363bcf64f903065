#pragma once

#include <string>
#include <vector>

namespace ifov::geometry {
class World;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// A map draped from above, the size of its cells, and where it lies in the scene.
struct MapScale {
  std::string path;
  double cell_width_m = 0.0, cell_height_m = 0.0;
  double west_m = 0.0, north_m = 0.0, width_m = 0.0, height_m = 0.0;
  bool repeats = false;  ///< goes on beyond its edges
  friend bool operator==(const MapScale&, const MapScale&) = default;
};

/// Side of a pixel at the middle of the scene, metres; not above 0 where the camera looks away from it.
double ground_sample_m(const sensor::Camera& camera, const geometry::World& world);

/// One line for each map whose cells are more than ten times smaller or larger than a pixel.
std::vector<std::string> scale_statements(const std::vector<MapScale>& scales, double ground_sample_m);

}  // namespace ifov::session
