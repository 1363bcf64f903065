#pragma once

#include <cmath>
#include <memory>

#include "sensor/camera.h"
#include "sensor/camera_axes.h"
#include "sensor/lens/lens.h"

namespace ifov::sensor {

/// Perspective camera: of a pinhole, an image point (x, y) in pixels looks along
///   d = forward + (x - width/2) (p/f) right + (y - height/2) (p/f) down,
/// with pixel pitch p and focal length f; the principal point is the middle of the image. With a lens, along the direction whose image is
/// there (sensor/lens/lens.h).
class FrameCamera final : public Camera {
 public:
  struct Settings {
    int width_px = 0, height_px = 0;
    double focal_length_m = 0.0;
    double pitch_m = 0.0;     ///< distance between the centres of neighbouring detector elements
    math::Point3 position_m;  ///< perspective centre, scene frame
    CameraAxes axes;
    double exposure_s = 0.0;    ///< of each row
    double row_period_s = 0.0;  ///< from row to row, of a rolling shutter: the middle of the image at 0 s
    std::shared_ptr<const Lens> lens = nullptr;  ///< null: a pinhole
  };

  /// ifov::InputError on sizes, pitch or focal length that are not positive, values that are not finite, or a lens that folds
  /// the image back.
  explicit FrameCamera(const Settings& settings);

  int width_px() const override { return settings_.width_px; }
  int height_px() const override { return settings_.height_px; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;
  /// Depth along the optical axis times pitch over focal length: the pixel's side on a plane parallel to the
  /// image, on which a square as large as it is with distortion.
  double gsd_m(math::Point3 position_m) const override;
  CameraPose pose(double line_px) const override {
    return {settings_.axes, settings_.position_m, settings_.focal_length_m, settings_.pitch_m,
            row_time_s(line_px)};
  }
  std::optional<GroundGrid> ground_grid() const override { return std::nullopt; }

  double exposure_s() const override { return settings_.exposure_s; }
  double row_period_s() const override { return settings_.row_period_s; }

  const Settings& settings() const { return settings_; }

 private:
  /// The middle of the exposure of the row that holds a y.
  double row_time_s(double y_px) const {
    return settings_.row_period_s == 0.0
               ? 0.0
               : (std::floor(y_px) + 0.5 - 0.5 * settings_.height_px) * settings_.row_period_s;
  }
  /// Beside the axis, in focal lengths.
  Lens::Place beside(double x_px, double y_px) const {
    const double step = settings_.pitch_m / settings_.focal_length_m;
    return {(x_px - 0.5 * settings_.width_px) * step, (y_px - 0.5 * settings_.height_px) * step};
  }
  void check_folds() const;

  Settings settings_;
  math::Vec3 right_step_, down_step_;  // per pixel, at unit depth
  math::Vec3 first_;                   // direction of image point (0, 0), at unit depth
};

}  // namespace ifov::sensor
