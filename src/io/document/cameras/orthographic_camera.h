#pragma once

#include <array>

#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/image_size.h"

namespace ifov::io {

/// Parallel rays, straight down or aslant; pixels are squares of the plane z = 0. Rotation 0 has north (+y) at the top of the image.
struct OrthographicCamera final : CameraSettings {
  static const CameraModel kModel;

  double gsd_m = 0.0;
  ImageSize size;
  /// Ground point of the image's centre; absent: the scene's origin.
  std::optional<std::array<double, 2>> centre_m;
  double rotation_rad = 0.0;  ///< of the camera about the vertical, clockwise seen from above: the top of the
                              ///< image points to this azimuth
  std::optional<double> height_m;                        ///< z at which rays start; absent: above everything
  double view_zenith_rad = 0.0, view_azimuth_rad = 0.0;  ///< of the direction from the ground to the sensor

  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string description(math::Vec3 shift_m, std::string_view axes) const override;
  std::shared_ptr<const CameraSettings> shrunk(int longest_px) const override;
  std::shared_ptr<const CameraSettings> seen_from(double zenith_rad, double azimuth_rad) const override;
  std::optional<double> start_height_m() const override { return height_m; }
  std::optional<FocalPlane> focal_plane() const override;
};

}  // namespace ifov::io
