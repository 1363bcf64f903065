#pragma once

#include <span>

#include "math/ray.h"
#include "sampling/field.h"

namespace ifov::sensor {

/// Where light that falls on a point of the focal plane comes from. Frames: scene (ENU metres) for rays,
/// image (pixels, x right, y down) for points.
class Camera {
 public:
  virtual ~Camera() = default;
  virtual int width_px() const = 0;
  virtual int height_px() const = 0;

  /// Rays through focal-plane points, from the camera towards the scene.
  virtual void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const = 0;

  /// Image of a scene point; false where it is behind the camera.
  virtual bool project(math::Point3 position_m, sampling::FocalPoint& point) const = 0;

  /// Ground sample distance at a scene point, metres per pixel (for sizes of seeds and for map info).
  virtual double gsd_m(math::Point3 position_m) const = 0;
};

}  // namespace ifov::sensor
