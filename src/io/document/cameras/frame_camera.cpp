#include "io/document/cameras/frame_camera.h"

#include <cmath>
#include <numbers>

#include "core/format.h"
#include "geodesy/sun_position.h"
#include "io/document/schema/record.h"
#include "sensor/frame_camera.h"

namespace ifov::io {
namespace {

SchemaType<geodesy::Attitude> attitude_type() {
  Record<geodesy::Attitude> record(
      "attitude",
      "Attitude of the aircraft that the camera hangs below, its axis along the body's down and the "
      "top of the image at the nose: 3-2-1 sequence in north-east-down axes. All zero looks "
      "straight down with north at the top.");
  record
      .with_default("yaw", &geodesy::Attitude::yaw_rad, quantity(kAngle), "\"0 deg\"",
                    "heading, clockwise from north")
      .with_default("pitch", &geodesy::Attitude::pitch_rad,
                    quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "\"0 deg\"", "nose up")
      .with_default("roll", &geodesy::Attitude::roll_rad, quantity(kAngle), "\"0 deg\"", "right wing down");
  return record.type();
}

struct Axes {
  math::Point3 position_m;  // in the scene
  math::Vec3 offset_m;

  sensor::CameraAxes operator()(const LookAt& look) const {
    const math::Point3 target_m = look.target_m - offset_m;
    const math::Vec3 along = math::normalized(target_m - position_m);
    const bool vertical = std::abs(along.z) > 1.0 - 1e-9;
    const math::Vec3 up = look.up.value_or(vertical ? math::Vec3{0.0, 1.0, 0.0} : math::Vec3{0.0, 0.0, 1.0});
    return sensor::axes_looking_at(position_m, target_m, up);
  }
  sensor::CameraAxes operator()(const geodesy::Attitude& attitude) const {
    return sensor::axes_from_attitude(attitude);
  }
};

struct FrameEntry {
  FrameCamera camera;
  std::optional<math::Vec3> up;
};

SchemaType<std::shared_ptr<const CameraSettings>> frame_type() {
  const SchemaType<double> length = quantity(kLength, Range::above(0.0, "m"));
  Record<FrameEntry> record("frame camera", "A pinhole with a frame of detector elements behind it.");
  record
      .required("focal_length", path(&FrameEntry::camera, &FrameCamera::focal_length_m), length,
                "focal length")
      .required("pitch", path(&FrameEntry::camera, &FrameCamera::pitch_m), length,
                "distance between detector elements")
      .required("pixels", path(&FrameEntry::camera, &FrameCamera::size), image_size_type(),
                "columns and rows")
      .required("position", path(&FrameEntry::camera, &FrameCamera::position_m), point(),
                "where the camera is")
      .exactly_one()
      .one("look_at",
           via(
               [](FrameEntry& e, math::Point3 p) {
                 e.camera.orientation = LookAt{p, {}};
               },
               [](const FrameEntry& e) {
                 const auto* look_at = std::get_if<LookAt>(&e.camera.orientation);
                 return look_at != nullptr ? &look_at->target_m : nullptr;
               }),
           point(), "point at the image's centre")
      .one("attitude", path(&FrameEntry::camera, &FrameCamera::orientation), attitude_type(),
           "instead: angles")
      .optional("up", &FrameEntry::up, direction(),
                "direction that is up in the image; +z if not given, or north where the camera looks along z")
      .needs("up", "look_at")
      .with_default(
          "exposure", path(&FrameEntry::camera, &FrameCamera::exposure_s),
          quantity(kDuration, Range::at_least(0.0, "s")), "\"0 s\"",
          "for which a row is exposed; what moves in the scene is blurred by its way in that time. The document's `time` is in its "
          "middle")
      .with_default(
          "row_period", path(&FrameEntry::camera, &FrameCamera::row_period_s),
          quantity(kDuration, Range::at_least(0.0, "s")), "\"0 s\"",
          "of a rolling shutter: by how much later each row is exposed than that above it, the middle of the image at the "
          "document's `time`; 0 s: all rows at once")
      .check([](const FrameEntry& entry, const DocumentNode& node) {
        const auto* look_at = std::get_if<LookAt>(&entry.camera.orientation);
        if (look_at != nullptr && look_at->target_m == entry.camera.position_m) {
          node.given("look_at").fail(
              format("{} is where the camera itself is", node.given("look_at").title()));
        }
      });
  return settings_type(converted<FrameCamera>(
      record.type(),
      [](FrameEntry entry) {
        if (auto* look_at = std::get_if<LookAt>(&entry.camera.orientation)) look_at->up = entry.up;
        return std::move(entry.camera);
      },
      [](const FrameCamera& camera) {
        const auto* look_at = std::get_if<LookAt>(&camera.orientation);
        return FrameEntry{camera, look_at != nullptr ? look_at->up : std::nullopt};
      }));
}

}  // namespace

constinit const CameraModel FrameCamera::kModel{"frame", "a perspective camera", frame_type};

std::unique_ptr<sensor::Camera> FrameCamera::build(const CameraSite& site) const {
  sensor::FrameCamera::Settings settings;
  settings.width_px = size.width_px;
  settings.height_px = size.height_px;
  settings.focal_length_m = focal_length_m;
  settings.pitch_m = pitch_m;
  settings.position_m = position_m - site.offset_m;
  settings.exposure_s = exposure_s, settings.row_period_s = row_period_s;
  settings.axes = std::visit(Axes{settings.position_m, site.offset_m}, orientation);
  return std::make_unique<sensor::FrameCamera>(settings);
}

CameraSettings::Exposed FrameCamera::exposed() const {
  const double half_s = 0.5 * (exposure_s + (size.height_px - 1) * row_period_s);
  return {-half_s, half_s};
}

std::string FrameCamera::description(math::Vec3 shift_m, std::string_view axes) const {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const math::Point3 p = position_m + shift_m;
  return format("frame, {} x {} pixels, {:.4g} x {:.4g} deg, at {} {:.8g}, {:.8g}, {:.6g} m", size.width_px,
                size.height_px, 2.0 * std::atan(0.5 * size.width_px * pitch_m / focal_length_m) * kDegrees,
                2.0 * std::atan(0.5 * size.height_px * pitch_m / focal_length_m) * kDegrees, axes, p.x, p.y,
                p.z);
}

std::shared_ptr<const CameraSettings> FrameCamera::shrunk(int longest_px) const {
  auto camera = std::make_shared<FrameCamera>(*this);
  const double factor = size.times(longest_px);
  camera->size = size.divided(factor);
  camera->pitch_m *= factor;
  // The same time for all rows.
  camera->row_period_s *= static_cast<double>(size.height_px) / camera->size.height_px;
  return camera;
}

std::shared_ptr<const CameraSettings> FrameCamera::seen_from(double zenith_rad, double azimuth_rad) const {
  auto camera = std::make_shared<FrameCamera>(*this);
  const math::Vec3 up = geodesy::direction_enu(azimuth_rad, 0.5 * std::numbers::pi - zenith_rad).v;
  camera->orientation = LookAt{position_m - up, std::nullopt};
  return camera;
}

}  // namespace ifov::io
