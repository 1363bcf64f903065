#pragma once

#include <optional>
#include <span>

#include "math/ray.h"
#include "sampling/field.h"
#include "sensor/camera_axes.h"

namespace ifov::sensor {

/// How a camera stands in the scene.
struct CameraPose {
  CameraAxes axes;  ///< of rays that diverge, unit vectors; of parallel ones `down` lies on the ground
  /// Perspective centre, scene frame; none where rays are parallel: above all air.
  std::optional<math::Point3> position_m;
  double focal_length_m = 0.0, pitch_m = 0.0;  ///< 0 where rays are parallel
};

/// Where the pixels of an image lie on the scene's plane z = 0, as squares of one size.
struct GroundGrid {
  math::Point3 upper_left_m;  ///< outer corner of the upper left pixel, scene frame
  double gsd_m = 0.0;         ///< side of a pixel
  double rotation_rad = 0.0;  ///< azimuth of the image's upward direction, clockwise from north
};

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

  /// Ground sample distance at a scene point, metres per pixel.
  virtual double gsd_m(math::Point3 position_m) const = 0;

  virtual CameraPose pose() const = 0;

  /// None where pixels are no squares of one size on the ground.
  virtual std::optional<GroundGrid> ground_grid() const = 0;
};

}  // namespace ifov::sensor
