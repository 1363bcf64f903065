#pragma once

#include "sensor/camera.h"

namespace ifov::sensor {

/// Parallel rays, straight down or aslant: every pixel covers the same square of the scene's horizontal plane z = 0.
/// Unrotated, image x grows to the east and image y to the south.
class OrthographicCamera final : public Camera {
 public:
  struct Settings {
    int width_px = 0, height_px = 0;
    double gsd_m = 1.0;                         ///< side of a pixel
    double centre_x_m = 0.0, centre_y_m = 0.0;  ///< scene point (ENU) under the middle of the image
    double rotation_rad = 0.0;     ///< azimuth of the image's upward direction, clockwise from north
    double start_height_m = 0.0;   ///< z at which rays start; nothing above it is seen
    double view_zenith_rad = 0.0;  ///< angle between the vertical and the direction to the sensor, below pi/2
    double view_azimuth_rad = 0.0;  ///< of the direction from the ground to the sensor, clockwise from north
  };

  /// ifov::InputError on sizes or a GSD that are not positive, or values that are not finite.
  explicit OrthographicCamera(const Settings& settings);

  int width_px() const override { return settings_.width_px; }
  int height_px() const override { return settings_.height_px; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;
  double gsd_m(math::Point3) const override { return settings_.gsd_m; }
  CameraPose pose(double line_px) const override;
  std::optional<GroundGrid> ground_grid() const override {
    return GroundGrid{corner_, settings_.gsd_m, settings_.rotation_rad};
  }

  const Settings& settings() const { return settings_; }

 private:
  Settings settings_;
  math::Vec3 right_m_, down_m_;  // one pixel along image x and y, scene frame
  math::Vec3 towards_sensor_;
  math::Point3 corner_;  // of the upper left pixel, at z = 0
};

}  // namespace ifov::sensor
