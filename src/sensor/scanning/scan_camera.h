#pragma once

#include <memory>

#include "sensor/flying/picture_stack.h"
#include "sensor/scanning/sweep_camera.h"

namespace ifov::sensor {

/// An image made by sweeps across the track of a moving platform (SweepPattern), one below the other: elements of the first, then those of the
/// second. Neighbouring sweeps may see the same ground, or leave some out, so what lies between them is nothing: each is a
/// picture of its own, to be sampled by itself through its own camera (sweep()). Asked as a whole, a point belongs to the sweep whose lines
/// hold it.
class ScanCamera final : public Camera, public PictureStack {
 public:
  struct Settings {
    SweepPattern pattern;
    std::shared_ptr<const platform::Trajectory>
        platform;  ///< scene frame, with what is between it and the camera
    std::shared_ptr<const platform::Trajectory> reported = nullptr;  ///< as it is reported; null: as it is
    double lowest_m = 0.0, highest_m = 0.0;                          ///< of what is looked at, z
  };

  /// ifov::InputError on numbers that are not positive; a sweep that takes longer than the period, or wider than its mirror swings; a trajectory
  /// that does not cover the image, with by how much; a platform that turns as fast as the sweep, or so that an element of a width sees
  /// more than kMost_px from where along_line() has it.
  explicit ScanCamera(const Settings& settings);

  static constexpr double kMost_px = 0.005;

  const PictureStack* pictures() const override { return this; }
  int lines_of_each() const override { return pattern().elements; }
  std::unique_ptr<const Camera> picture(int number) const override { return sweep(number); }
  const SweepPattern& pattern() const { return settings_.pattern; }
  std::unique_ptr<const SweepCamera> sweep(int number) const;

  int width_px() const override { return pattern().samples; }
  int height_px() const override { return pattern().elements * pattern().sweeps; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  /// In the sweep that sees the point nearest to the middle of its elements.
  bool project(math::Point3 position_m, sampling::FocalPoint& point) const override;
  double gsd_m(math::Point3 position_m) const override;
  CameraPose pose(double line_px) const override;
  std::optional<GroundGrid> ground_grid() const override { return std::nullopt; }
  /// Of a sweep: also between two.
  Ifov ifov(double line_px) const override;
  AlongTrack along_line() const override { return sweep_of(0.0).along_line(); }
  const Camera& reported() const override { return reported_ ? *reported_ : *this; }

 private:
  struct Unjudged {};
  ScanCamera(const Settings& settings, Unjudged) : settings_(settings) {}
  int number_of(double line_px) const;
  SweepCamera sweep_of(double line_px) const;
  void cover() const;
  void hold_together() const;

  Settings settings_;
  std::unique_ptr<const ScanCamera> reported_;
};

}  // namespace ifov::sensor
