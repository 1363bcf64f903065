#pragma once

#include <optional>

#include "math/vec3.h"

namespace ifov::sensor {

class Camera;
class FlyingFrameCamera;

/// How far the image of a place moves in a time about the middle of the exposure, by the camera's own motion: there and back counts twice.
/// None where it gets out of sight.
std::optional<double> image_way_px(const FlyingFrameCamera& camera, math::Point3 place_m, double span_s);

/// The longest of those of nine places of the image on level ground: while a row is exposed, and from a row's exposure to the next's.
struct FrameMotion {
  double exposure_px = 0.0, row_px = 0.0;
};
/// None of a camera that does not fly, or looks at no ground.
std::optional<FrameMotion> frame_motion(const Camera& camera, double ground_m);

}  // namespace ifov::sensor
