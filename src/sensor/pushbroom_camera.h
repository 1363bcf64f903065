#pragma once

#include <array>
#include <memory>

#include "sensor/along_track.h"
#include "sensor/camera.h"

namespace ifov::platform {
class Trajectory;
}

namespace ifov::sensor {

class Lens;

/// A line of detector elements across the track of a moving platform: the image's y is time. A point (x, y) looks, at
///   t = start + y * line period,
/// from where the platform then is along
///   d = forward + (x - width/2) (p/f) right,
/// with pitch p and focal length f; `forward` is the body's belly, `right` its left wing, so that the image, whose lines follow each
/// other towards the nose, is not mirrored. With a lens an element looks along forward + X right + Y down, whatever direction (X, Y) has its image
/// there: project() then finds x by X and y by Y together. An element of a length sees, v pitches ahead of its middle, along d + v (p/f) down, what a line
/// sees b v lines later: along_track() holds that, with one b for the image. How far that is from the truth is worked out when the camera
/// is made, for all lines and on the lowest and the highest ground, and refused beyond kMost_px.
class PushbroomCamera final : public Camera {
 public:
  struct Settings {
    int width_px = 0, height_px = 0;  ///< elements across, lines
    double step = 0.0;                ///< p/f
    double focal_length_m = 0.0;      ///< 0: only the step is known
    double start_s = 0.0;             ///< when the first line begins, after the document's instant
    double line_period_s = 0.0;
    std::shared_ptr<const platform::Trajectory>
        platform;  ///< scene frame, with what is between it and the camera
    /// The same as it is reported; null: as it is. What it does not cover or see in order is not judged.
    std::shared_ptr<const platform::Trajectory> reported = nullptr;
    double exposure_s = 0.0;                 ///< 0: the whole period
    double element_px = 0.0;                 ///< sensitive length along the track, over the pitch
    int stages = 1;                          ///< a pitch apart, a line period one after the other, added up
    double lowest_m = 0.0, highest_m = 0.0;  ///< of what is looked at, z
    std::shared_ptr<const Lens> lens = nullptr;  ///< null: elements look along the line above
  };

  /// ifov::InputError on sizes, step or period that are not positive; a trajectory that does not cover the image, with by how much; and
  /// a line that does not look ahead of the one before it where their rays meet z = 0, from above: the platform stands, or turns back faster
  /// than it flies.
  explicit PushbroomCamera(const Settings& settings);

  /// Lines before the first and after the last in which the platform's own motion still counts, for what samplers look at beyond
  /// the image; further away it flies on straight, so that where a point lies there has one answer.
  static constexpr double kBeyond_px = 64.0;

  /// How far, in pixels along x or lines along y, what an element sees may lie from where along_track() has it.
  static constexpr double kMost_px = 0.005;

  int width_px() const override { return settings_.width_px; }
  int height_px() const override { return settings_.height_px; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;

  /// When the plane of the line passes the point: the root of f(y) = (point - position(y)) . down(y), by Newton's method in its
  /// secant form within a bracket. The step that is left is at most 1e-11 lines, where rounding of coordinates (1e-16 of the distance,
  /// over the spacing of lines) is less. False also where the platform does not pass the point.
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;

  /// Side of the square that is as large as the pixel, in the plane through the point across the line of sight: the geometric mean of the
  /// spacing of elements there and that of lines.
  double gsd_m(math::Point3 position_m) const override;

  CameraPose pose(double line_px) const override;
  std::optional<GroundGrid> ground_grid() const override { return std::nullopt; }
  AlongTrack along_track() const override;
  const Camera& reported() const override { return reported_ ? *reported_ : *this; }

  const Settings& settings() const { return settings_; }

 private:
  struct Unjudged {};
  PushbroomCamera(const Settings& settings, Unjudged) : settings_(settings) {}
  struct Line;  // where one is, and how it stands
  Line line_at(double y_px, double time_s = 0.0) const;
  /// Beside the axis, of the direction of a place of the line, or so many pitches ahead of it.
  std::array<double, 2> towards(double x_px, double ahead_px = 0.0) const;
  void check_lens() const;
  /// The place whose direction lies so far to the right.
  double place_of(double right) const;
  double ahead_m(const Line& line, math::Point3 point_m) const;
  std::optional<double> line_of(math::Point3 point_m) const;
  void hold_together() const;
  /// What an element sees v pitches ahead of its middle in a line, on level ground, is seen by a line's middle this far along x and y
  /// from there; none where it does not look down.
  std::optional<std::array<double, 2>> displaced_px(double x_px, double y_px, double ahead_px,
                                                    double ground_m) const;
  void find_lines_a_pitch();
  /// What optics are blurred by along the track where elements have no length: a mean over the image, about which it may vary.
  double mean_lines_a_pitch() const;

  Settings settings_;
  double lines_a_pitch_ = 1.0;  // b
  std::unique_ptr<const PushbroomCamera> reported_;
};

}  // namespace ifov::sensor
