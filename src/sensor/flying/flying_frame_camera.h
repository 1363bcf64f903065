#pragma once

#include <memory>
#include <optional>

#include "math/transform.h"
#include "sensor/camera.h"
#include "sensor/flying/picture_stack.h"

namespace ifov::platform {
class Trajectory;
}

namespace ifov::sensor {

class Lens;

/// FrameCamera on a platform: its axis along the body's belly, the top of the image at the nose. A row looks from where the platform is in the
/// middle of its exposure, and a point of it at another time from where it is then; so the image is blurred by the way of an
/// exposure and, with a rolling shutter, sheared by that from row to row. Rows of a rolling shutter are pictures of their own.
class FlyingFrameCamera final : public Camera, public PictureStack {
 public:
  struct Settings {
    int width_px = 0, height_px = 0;
    double focal_length_m = 0.0, pitch_m = 0.0;
    double exposure_s = 0.0, row_period_s = 0.0;  ///< as FrameCamera's
    std::shared_ptr<const platform::Trajectory>
        platform;  ///< scene frame, with what is between it and the camera
    std::shared_ptr<const platform::Trajectory> reported = nullptr;  ///< as it is reported; null: as it is
    std::shared_ptr<const Lens> lens = nullptr;                      ///< as FrameCamera's
  };

  /// ifov::InputError as of a FrameCamera, and on a trajectory that does not cover the exposure, with by how much.
  explicit FlyingFrameCamera(const Settings& settings);

  /// Rows before the first and after the last in which the platform's own motion still counts, for what is looked for beyond the image.
  static constexpr double kBeyond_px = 64.0;

  int width_px() const override { return settings_.width_px; }
  int height_px() const override { return rows_; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;

  /// In the middle of the exposure of the row that then sees it: of a rolling shutter by the secant form of Newton's method. What no row sees is
  /// at the border of the nearest.
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override {
    return project_when(position_m, 0.0, point);
  }
  /// The same so long after the middle of an exposure.
  bool project_when(math::Point3 position_m, double time_s, sampling::FocalPoint& point) const;
  double gsd_m(math::Point3 position_m) const override;
  CameraPose pose(double line_px) const override;
  CameraAxes axes_at(const sampling::FocalPoint& point) const override;
  std::optional<GroundGrid> ground_grid() const override { return std::nullopt; }

  double exposure_s() const override { return settings_.exposure_s; }
  double row_period_s() const override { return settings_.row_period_s; }
  const FlyingFrameCamera* flying() const override { return this; }
  /// Itself as it stands at an instant, so long after the middle of each point's exposure.
  std::unique_ptr<const Camera> at_instant(double time_s) const;
  /// The shortest time in which the platform may turn back; infinite where it flies straight.
  double step_s() const;
  const Camera& reported() const override { return reported_ ? *reported_ : *this; }

  const PictureStack* pictures() const override { return settings_.row_period_s > 0.0 ? this : nullptr; }
  int lines_of_each() const override { return 1; }
  std::unique_ptr<const Camera> picture(int number) const override;

 private:
  struct Unjudged {};
  FlyingFrameCamera(const Settings& settings, Unjudged);
  std::unique_ptr<FlyingFrameCamera> row(int number) const;
  struct Stand;  // where it is, and how it is turned
  Stand stand_at(double time_s) const;
  double row_time_s(double y_px) const;
  bool seen(const Stand& stand, math::Point3 position_m, sampling::FocalPoint& point) const;

  Settings settings_;
  int rows_ = 0;            // of this picture
  double first_row_ = 0.0;  // of the whole frame
  double middle_s_ = 0.0;   // of the exposure of all rows, or of the middle of a rolling shutter
  std::unique_ptr<const FlyingFrameCamera> reported_;
};

}  // namespace ifov::sensor
