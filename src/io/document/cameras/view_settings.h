#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/document/cameras/camera_settings.h"

namespace ifov::sensor {
class SingleView;
struct ViewList;
}  // namespace ifov::sensor

namespace ifov::io {

template <class V>
struct SchemaType;

/// A sensor that makes no picture: single views (sensor::ViewListCamera), of which each has a value of its own.
class ViewSettings : public CameraSettings {
 public:
  /// "directions", "points" as they stand in the document or in a table; for messages and descriptions.
  virtual std::string what() const = 0;
  /// Whether views begin within the scene and look up as well.
  virtual bool within_scene() const { return false; }

  std::string description(math::Vec3, std::string_view) const override { return what(); }
  /// Both throw InputError: they are asked of pictures.
  std::shared_ptr<const CameraSettings> shrunk(int longest_px) const override;
  std::shared_ptr<const CameraSettings> seen_from(double zenith_rad, double azimuth_rad) const override;
};

/// A rectangle of a horizontal plane; lengths in metres, coordinates of the document.
struct ViewedArea {
  std::optional<std::array<double, 2>> centre_m;  ///< absent: the scene's origin
  std::optional<std::array<double, 2>> size_m;    ///< east-west, north-south; absent: the period of the scene
  double height_m = 0.0;                          ///< of the plane above the origin's
};

/// Of the direction towards a sensor; a negative zenith angle lies on the other side of the vertical.
struct ViewedDirection {
  double zenith_rad = 0.0, azimuth_rad = 0.0;
};
struct ViewedPoint {
  math::Point3 position_m;
  math::Vec3 normal{0.0, 0.0, 1.0};  ///< of any length
};
struct ViewedRay {
  math::Point3 from_m;
  math::Vec3 direction;  ///< in which it goes, against the light; of any length
};

/// What leaves an area towards each of a list of directions.
struct DistantSensor final : ViewSettings {
  ViewedArea area;
  std::vector<ViewedDirection> directions;
  std::optional<DocumentFile> file;  ///< in place of these

  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string what() const override;
};

/// The same of directions by chance over the hemisphere, and from them the albedo: the unit disc of Nusselt's projection in cells of
/// equal areas, two directions in each.
struct HemisphereSensor final : ViewSettings {
  ViewedArea area;
  int cells = 6;  ///< along a side of the square that the disc is turned into

  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string what() const override;
};

/// Irradiance on planes at points.
struct PointsSensor final : ViewSettings {
  std::vector<ViewedPoint> points;
  std::optional<DocumentFile> file;  ///< in place of these

  bool within_scene() const override { return true; }
  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string what() const override;
};

/// Radiance along rays.
struct RaysSensor final : ViewSettings {
  std::vector<ViewedRay> rays;
  std::optional<DocumentFile> file;  ///< in place of these

  bool within_scene() const override { return true; }
  std::unique_ptr<sensor::Camera> build(const CameraSite& site) const override;
  std::string what() const override;
};

SchemaType<DistantSensor> distant_type();
SchemaType<HemisphereSensor> hemisphere_type();
SchemaType<PointsSensor> points_type();
SchemaType<RaysSensor> rays_type();

}  // namespace ifov::io
