#pragma once

#include <variant>

#include "geodesy/attitude.h"
#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/image_size.h"
#include "io/document/cameras/lens_settings.h"

namespace ifov::io {

/// Turns the camera so that its axis passes through a point.
struct LookAt {
  math::Point3 target_m;
  std::optional<math::Vec3> up;  ///< scene direction that is up in the image; absent: +z, or north (+y) where
                                 ///< the camera looks along z
};

struct FrameCamera final : CameraSettings {
  static const CameraModel kModel;

  double focal_length_m = 0.0;
  double pitch_m = 0.0;  ///< of the detector elements
  ImageSize size;
  /// Of one that stands still, as is `orientation`.
  math::Point3 position_m;
  /// An attitude is that of the aircraft that the camera hangs below (sensor::axes_from_attitude).
  std::variant<LookAt, geodesy::Attitude> orientation;
  bool placed = true;         ///< whether these say where it is; otherwise a platform carries it
  double exposure_s = 0.0;    ///< of each row
  double row_period_s = 0.0;  ///< from row to row, of a rolling shutter; 0: all rows at once
  LensSettings lens;
  std::shared_ptr<const PlatformFlight> flight;  ///< of one that is not placed; null before carried_by()

  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string description(math::Vec3 shift_m, std::string_view axes) const override;
  std::shared_ptr<const CameraSettings> shrunk(int longest_px) const override;
  std::shared_ptr<const CameraSettings> seen_from(double zenith_rad, double azimuth_rad) const override;
  std::optional<Optics> optics() const override { return Optics{focal_length_m, pitch_m}; }
  Exposed exposed() const override;
  const PlatformFlight* carrier() const override { return flight.get(); }
  std::string_view made_of() const override { return !placed && row_period_s > 0.0 ? "row" : ""; }
  std::shared_ptr<const CameraSettings> carried_by(std::shared_ptr<const PlatformFlight> by) const override;
  std::vector<std::string> remarks() const override;
  std::optional<SensitiveSide> sensitive_side() const override;

  std::optional<FocalPlane> focal_plane() const override;
};

}  // namespace ifov::io
