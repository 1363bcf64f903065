#pragma once

#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/image_size.h"

namespace ifov::sensor {
struct SweepPattern;
}

namespace ifov::io {

/// A few elements that are swept across the track of the document's platform, again and again.
struct ScanningCamera : CameraSettings {
  ImageSize size;    ///< samples of a sweep, lines: elements times sweeps
  int elements = 1;  ///< along the track
  /// Either the first two or the third.
  std::optional<double> focal_length_m, pitch_m, element_angle_rad;
  double sweep_angle_rad = 0.0;  ///< of a whole sweep, about the axis that the line of sight turns about
  double start_s = 0.0, period_s = 0.0;
  std::optional<double> sweep_time_s, element_width_m;
  double exposure_share = 1.0;  ///< of a sample's time
  bool reversed = false, both_ways = false;
  std::shared_ptr<const PlatformFlight> flight;  ///< null before carried_by()

  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string description(math::Vec3 shift_m, std::string_view axes) const override;
  std::shared_ptr<const CameraSettings> shrunk(int longest_px) const override;
  std::shared_ptr<const CameraSettings> seen_from(double zenith_rad, double azimuth_rad) const override;
  std::optional<Optics> optics() const override;
  Exposed exposed() const override;
  const PlatformFlight* carrier() const override { return flight.get(); }
  std::shared_ptr<const CameraSettings> carried_by(std::shared_ptr<const PlatformFlight> by) const override;
  sensor::ReadOut read_out() const override;
  bool sweeps() const override { return true; }
  std::string_view made_of() const override { return "sweep"; }
  std::vector<std::string> remarks() const override;

  /// Pitch over focal length, or the angle that is given instead.
  double step() const;

 protected:
  virtual sensor::SweepPattern pattern() const;
  virtual std::string name() const = 0;
  virtual std::shared_ptr<ScanningCamera> copy() const = 0;
};

/// Sweeps a plane across the track: a mirror turns or swings about the nose's axis.
struct WhiskbroomCamera final : ScanningCamera {
  static const CameraModel kModel;
  std::optional<double> amplitude_rad;  ///< of a line of sight that oscillates as a sine does

 protected:
  sensor::SweepPattern pattern() const override;
  std::string name() const override;
  std::shared_ptr<ScanningCamera> copy() const override { return std::make_shared<WhiskbroomCamera>(*this); }
};

/// Sweeps a cone about the belly's axis.
struct ConicalCamera final : ScanningCamera {
  static const CameraModel kModel;
  double cone_rad = 0.0;  ///< of the line of sight from that axis
  enum class Looks { ahead, behind } looks = Looks::ahead;

 protected:
  sensor::SweepPattern pattern() const override;
  std::string name() const override;
  std::shared_ptr<ScanningCamera> copy() const override { return std::make_shared<ConicalCamera>(*this); }
};

}  // namespace ifov::io
