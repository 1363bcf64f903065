#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace ifov::geometry {
class World;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// Where a sensor stands and what it looks at, in a few lines to be drawn; scene frame, metres.
struct SensorSketch {
  struct Sight {
    math::Point3 from_m;
    math::Vec3 direction;              ///< unit
    std::optional<math::Point3> to_m;  ///< what it meets; none: nothing
  };
  std::string kind;  ///< "image", "directions", "hemisphere", "points", "rays"
  int width_px = 0, height_px = 0;
  /// Perspective centres while the image is taken, where the sensor moves or turns; empty: it stands still, or its rays are parallel.
  std::vector<math::Point3> track_m;
  double duration_s = 0.0;  ///< from the middle of the first line's exposure to that of the last
  bool is_parallel = false;
  Sight axis;                  ///< through the middle of the image
  std::vector<Sight> corners;  ///< of the image: upper left, upper right, lower right, lower left
  std::vector<Sight> views;    ///< single views, at most kMostViews of them
  std::size_t view_count = 0;
  /// The outline of the image on what it meets, closed; none where a ray meets nothing.
  std::vector<std::optional<math::Point3>> outline_m;

  static constexpr std::size_t kMostViews = 400;
};

SensorSketch sketch_of(const sensor::Camera& camera, const geometry::World& world);

}  // namespace ifov::session
