#pragma once

#include <memory>

#include "sensor/camera.h"

namespace ifov::sensor {

/// A picture of one pixel, [0, 1) x [0, 1), whose mean is a quantity of its own: what leaves an area towards a direction, what
/// reaches a point, what comes along a ray. Beside the pixel the picture goes on without a break.
class SingleView : public Camera {
 public:
  int width_px() const final { return 1; }
  int height_px() const final { return 1; }
  std::optional<GroundGrid> ground_grid() const final { return std::nullopt; }
};

/// Parallel rays from a direction to a rectangle of the plane z = height, whose sides run east and north: the pixel's mean is the radiance
/// that leaves the rectangle towards there. In a scene that repeats a rectangle of its period has all of it.
class AreaView final : public SingleView {
 public:
  struct Settings {
    double centre_x_m = 0.0, centre_y_m = 0.0, height_m = 0.0;  ///< scene frame
    double width_m = 1.0, depth_m = 1.0;                        ///< east-west, north-south
    double zenith_rad = 0.0, azimuth_rad = 0.0;  ///< of the direction towards the sensor, below pi/2
    double start_height_m = 0.0;                 ///< z at which rays start, above everything
  };
  /// ifov::InputError on sides that are not positive or a direction at or below the horizon.
  explicit AreaView(const Settings& settings);
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;
  double gsd_m(math::Point3) const override;
  CameraPose pose(double line_px) const override;

 private:
  Settings settings_;
  math::Vec3 towards_sensor_;
  math::Point3 corner_;  // north-west, at the plane
};

/// The half space before a plane as a surface there sees it, by Nusselt's projection: the pixel is the unit disc of directions'
/// components in the plane, turned into a square by the map of Shirley and Chiu (1997), which keeps areas. So that pi times the pixel's
/// mean radiance is the irradiance on the plane, and the share of what meets nothing its view factor of the sky.
class HemisphereView final : public SingleView {
 public:
  /// `normal`: unit vector, into the half space. Rays start kOff_m off the point, so that it may lie on a surface.
  HemisphereView(math::Point3 position_m, math::Vec3 normal);
  static constexpr double kOff_m = 1e-4;

  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;
  /// Of what is met face to face: the pixel is pi of projected solid angle.
  double gsd_m(math::Point3 position_m) const override;
  CameraPose pose(double line_px) const override;
  bool bends_sharply() const override { return true; }  ///< along the diagonals of its square

 private:
  math::Point3 origin_m_;
  CameraAxes axes_;  // forward is the normal
};

/// The same ray through every point: the pixel's mean is the radiance that comes along it.
class RayView final : public SingleView {
 public:
  /// `direction`: unit vector, in which the ray goes and so against the light.
  RayView(math::Point3 origin_m, math::Vec3 direction);
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  /// Nothing has a place on it.
  bool project(math::Point3, sampling::FocalPoint&) const override { return false; }
  double gsd_m(math::Point3) const override;
  CameraPose pose(double line_px) const override;

 private:
  math::Point3 origin_m_;
  math::Vec3 direction_;
};

}  // namespace ifov::sensor
