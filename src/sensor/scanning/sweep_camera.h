#pragma once

#include <array>
#include <memory>
#include <optional>

#include "sensor/along_track.h"
#include "sensor/camera.h"

namespace ifov::platform {
class Trajectory;
}

namespace ifov::sensor {

/// How a few elements are swept across the track, again and again, by a mirror that turns or an antenna that does. The line of sight keeps an
/// angle, `cone_rad`, from an axis of the body and turns about it: x of the image is that turn, in equal steps, and so when. With the axis along
/// the nose and a right angle it sweeps a plane (whisk-broom), with the axis along the belly a cone.
struct SweepPattern {
  enum class Axis { nose, belly_looking_ahead, belly_looking_behind };

  int samples = 0;   ///< of a sweep
  int elements = 1;  ///< along the track, seen together; lines of the image that one sweep makes
  int sweeps = 1;
  Axis axis = Axis::nose;
  double cone_rad = 0.0;        ///< between the line of sight and the axis
  double turn_rad = 0.0;        ///< of a whole sweep about the axis, about the middle of it
  double step = 0.0;            ///< angle between elements: pitch over focal length
  double focal_length_m = 0.0;  ///< 0: only the step is known
  double start_s = 0.0;         ///< when the first sweep begins, after the document's instant
  double period_s = 0.0;        ///< from the beginning of a sweep to that of the next
  double sweep_s = 0.0;         ///< that a sweep takes
  double amplitude_rad = 0.0;   ///< of a line of sight that oscillates as a sine does; 0: it turns evenly
  bool reversed = false;        ///< sweeps run against the image's x
  bool both_ways = false;       ///< every second sweep runs back
  double element_px = 0.0;      ///< sensitive width along the sweep, over the pitch
  double exposure = 1.0;        ///< share of a sample's time, in its middle

  double turn_per_sample_rad() const { return turn_rad / samples; }
  /// At the ends of a sweep: of one that a sine makes the longest.
  double longest_sample_s() const;
  /// A sine's time from one end of `turn_rad` to the other, where a turn there and back takes `cycle_s`.
  static double sine_sweep_s(double turn_rad, double amplitude_rad, double cycle_s);
};

/// The part of a scanner's image that one sweep makes: samples along x, elements along y. Its own picture, for what lies beside it was seen
/// elsewhere: optics blur over its edges into what they would have seen there and then.
class SweepCamera final : public Camera {
 public:
  /// `number`: of the sweep. Of settings that were found to be good; see ScanCamera.
  SweepCamera(const SweepPattern& pattern, int number, std::shared_ptr<const platform::Trajectory> platform,
              std::shared_ptr<const platform::Trajectory> reported);

  /// Samples before the first and after the last in which the platform's own motion still counts, for what samplers look at beyond
  /// the image.
  static constexpr double kBeyond_px = 256.0;

  int width_px() const override { return pattern_.samples; }
  int height_px() const override { return pattern_.elements; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;

  /// The sample at which the turn from the axis to the point is that of the line of sight, by Newton's method in its secant form; what
  /// is left is at most 1e-11 samples, or rounding. Where that is the distance from the cone tells the element.
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;

  /// Side of the square that is as large as the pixel, across the line of sight.
  double gsd_m(math::Point3 position_m) const override;
  /// Along the sweep, towards elements ahead, and the line of sight, as they are turned for a sample.
  CameraAxes axes_at(const sampling::FocalPoint& point) const override;
  /// In the middle of the sweep, whatever the line.
  CameraPose pose(double line_px) const override;
  std::optional<GroundGrid> ground_grid() const override { return std::nullopt; }
  AlongTrack along_line() const override;
  const Camera& reported() const override { return reported_ ? *reported_ : *this; }

  /// When a place of the image's x is looked at, after the document's instant.
  double time_s(double x_px) const;
  /// Ray of the place (ahead, beside) on the focal plane, in pitches off the axis, when x is in its middle.
  math::Ray element_ray(double x_px, double ahead_px, double beside_px) const;

 private:
  struct Axes;  // axis, direction where the turn is 0, direction where it is a right angle
  static Axes axes_of(const SweepPattern& pattern, const CameraAxes& body);
  struct Look;
  Look look(double x_px, double time_s = 0.0) const;

  SweepPattern pattern_;
  int number_;
  bool back_;  // whether it runs against x
  std::shared_ptr<const platform::Trajectory> platform_;
  std::unique_ptr<const SweepCamera> reported_;
};

}  // namespace ifov::sensor
