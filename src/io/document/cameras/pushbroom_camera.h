#pragma once

#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/image_size.h"
#include "io/document/cameras/lens_settings.h"

namespace ifov::io {

/// A line of elements across the track of the document's platform.
struct PushbroomCamera final : CameraSettings {
  static const CameraModel kModel;

  ImageSize size;  ///< elements, lines
  /// Either the first two or the third.
  std::optional<double> focal_length_m, pitch_m, field_of_view_rad;
  double start_s = 0.0, line_period_s = 0.0;
  std::optional<double> exposure_s, element_length_m;
  int stages = 1;
  LensSettings lens;
  std::shared_ptr<const PlatformFlight> flight;  ///< null before carried_by()

  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string description(math::Vec3 shift_m, std::string_view axes) const override;
  std::shared_ptr<const CameraSettings> shrunk(int longest_px) const override;
  std::shared_ptr<const CameraSettings> seen_from(double zenith_rad, double azimuth_rad) const override;
  std::optional<Optics> optics() const override;
  Exposed exposed() const override { return {start_s, start_s + size.height_px * line_period_s}; }
  const PlatformFlight* carrier() const override { return flight.get(); }
  std::shared_ptr<const CameraSettings> carried_by(std::shared_ptr<const PlatformFlight> by) const override;
  sensor::ReadOut read_out() const override;
  std::vector<std::string> remarks() const override;
  std::optional<SensitiveSide> sensitive_side() const override;

  /// Pitch over focal length.
  double step() const;
  std::optional<FocalPlane> focal_plane() const override;
};

}  // namespace ifov::io
