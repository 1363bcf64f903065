#include "io/document/cameras/frame_camera.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/format.h"
#include "geodesy/sun_position.h"
#include "io/document/cameras/flight_motion.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/platform_document.h"
#include "io/document/schema/record.h"
#include "platform/trajectory.h"
#include "sensor/flying/flying_frame_camera.h"
#include "sensor/frame_camera.h"
#include "sensor/lens/lens.h"

namespace ifov::io {
namespace {

constexpr const char* kPlaceless =
    "a frame camera is somewhere or flies: expected its 'position', or a 'platform' beside the 'sensor'";

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
  std::optional<math::Point3> position_m, look_at_m;
  std::optional<geodesy::Attitude> attitude;
  std::optional<math::Vec3> up;
};

FrameCamera frame_of(FrameEntry entry) {
  entry.camera.placed = entry.position_m.has_value();
  entry.camera.position_m = entry.position_m.value_or(math::Point3{});
  if (entry.look_at_m)
    entry.camera.orientation = LookAt{*entry.look_at_m, entry.up};
  else
    entry.camera.orientation = entry.attitude.value_or(geodesy::Attitude{});
  return std::move(entry.camera);
}

FrameEntry entry_of_frame(const FrameCamera& camera) {
  FrameEntry entry;
  entry.camera = camera;
  if (!camera.placed) return entry;
  entry.position_m = camera.position_m;
  if (const auto* look_at = std::get_if<LookAt>(&camera.orientation))
    entry.look_at_m = look_at->target_m, entry.up = look_at->up;
  else
    entry.attitude = std::get<geodesy::Attitude>(camera.orientation);
  return entry;
}

SchemaType<std::shared_ptr<const CameraSettings>> frame_type() {
  const SchemaType<double> length = quantity(kLength, Range::above(0.0, "m"));
  Record<FrameEntry> record(
      "frame camera",
      "A pinhole with a frame of detector elements behind it. It stands at a `position`, or flies on the document's `platform`, looking "
      "along the body's down with the top of the image at the nose.");
  record
      .required("focal_length", path(&FrameEntry::camera, &FrameCamera::focal_length_m), length,
                "focal length")
      .required("pitch", path(&FrameEntry::camera, &FrameCamera::pitch_m), length,
                "distance between detector elements")
      .required("pixels", path(&FrameEntry::camera, &FrameCamera::size), image_size_type(),
                "columns and rows")
      .optional("position", &FrameEntry::position_m, point(),
                "where the camera is; if not given the document's `platform` carries it")
      .optional("look_at", &FrameEntry::look_at_m, point(),
                "of a camera with a `position`: point at the image's centre")
      .needs("look_at", "position")
      .optional("attitude", &FrameEntry::attitude, attitude_type(), "instead of `look_at`: angles")
      .needs("attitude", "position")
      .optional("up", &FrameEntry::up, direction(),
                "direction that is up in the image; +z if not given, or north where the camera looks along z")
      .needs("up", "look_at")
      .with_default(
          "exposure", path(&FrameEntry::camera, &FrameCamera::exposure_s),
          quantity(kDuration, Range::at_least(0.0, "s")), "\"0 s\"",
          "for which a row is exposed; what moves in the image is blurred by its way in that time. The document's `time` is in its "
          "middle")
      .with_default(
          "row_period", path(&FrameEntry::camera, &FrameCamera::row_period_s),
          quantity(kDuration, Range::at_least(0.0, "s")), "\"0 s\"",
          "of a rolling shutter: by how much later each row is exposed than that above it, the middle of the image at the "
          "document's `time`; 0 s: all rows at once")
      .at_most_one()
      .one("distortion", path(&FrameEntry::camera, &FrameCamera::lens, &LensSettings::distortion),
           distortion_type(), "of the lens; none if not given")
      .one(
          "elements", path(&FrameEntry::camera, &FrameCamera::lens, &LensSettings::elements), elements_type(),
          "instead: where each element looks and how wide; `focal_length` and `pitch` then scale the optics' blur alone")
      .check([](const FrameEntry& entry, const DocumentNode& node) {
        if (entry.position_m && entry.look_at_m.has_value() == entry.attitude.has_value())
          (entry.look_at_m ? node.given("attitude") : node.given("position"))
              .fail("a frame camera with a 'position' needs exactly one of 'look_at' or 'attitude'");
        if (entry.look_at_m && *entry.look_at_m == *entry.position_m)
          node.given("look_at").fail(
              format("{} is where the camera itself is", node.given("look_at").title()));
      });
  return settings_type(converted<FrameCamera>(record.type(), frame_of, entry_of_frame));
}

std::unique_ptr<sensor::Camera> build_flying(const FrameCamera& camera, const CameraSite& site) {
  if (!camera.flight) throw InputError(kPlaceless);
  sensor::FlyingFrameCamera::Settings settings;
  settings.width_px = camera.size.width_px, settings.height_px = camera.size.height_px;
  settings.focal_length_m = camera.focal_length_m, settings.pitch_m = camera.pitch_m;
  settings.exposure_s = camera.exposure_s, settings.row_period_s = camera.row_period_s;
  settings.lens = lens_of(camera.lens, *camera.focal_plane());
  const CameraSettings::Exposed exposed = camera.exposed();
  const double beyond_s = sensor::FlyingFrameCamera::kBeyond_px * camera.row_period_s;
  const Motions motions =
      motions_of(*camera.flight, {site.offset_m, site.maps}, exposed.from_s, exposed.to_s, beyond_s);
  settings.platform = motions.truth, settings.reported = motions.reported;
  auto built = std::make_unique<sensor::FlyingFrameCamera>(settings);
  check_flatness(*built, *camera.flight);
  return built;
}

}  // namespace

constinit const CameraModel FrameCamera::kModel{"frame", "a perspective camera", frame_type};

std::unique_ptr<sensor::Camera> FrameCamera::build(const CameraSite& site) const {
  if (!placed) return build_flying(*this, site);
  sensor::FrameCamera::Settings settings;
  settings.width_px = size.width_px;
  settings.height_px = size.height_px;
  settings.focal_length_m = focal_length_m;
  settings.pitch_m = pitch_m;
  settings.position_m = position_m - site.offset_m;
  settings.exposure_s = exposure_s, settings.row_period_s = row_period_s;
  settings.lens = lens_of(lens, *focal_plane());
  settings.axes = std::visit(Axes{settings.position_m, site.offset_m}, orientation);
  return std::make_unique<sensor::FrameCamera>(settings);
}

CameraSettings::Exposed FrameCamera::exposed() const {
  const double half_s = 0.5 * (exposure_s + (size.height_px - 1) * row_period_s);
  return {-half_s, half_s};
}

namespace {

/// How much further out than without distortion the direction of a corner appears.
double moved_px_of(const sensor::Lens& lens, double right, double down, double pixels) {
  const sensor::Lens::Place at = lens.image_of({right, down});
  return pixels * (std::hypot(at.x, at.y) - std::hypot(right, down));
}

}  // namespace

std::string FrameCamera::description(math::Vec3 shift_m, std::string_view axes) const {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const math::Point3 p = position_m + shift_m;
  const double right = 0.5 * size.width_px * pitch_m / focal_length_m,
               down = 0.5 * size.height_px * pitch_m / focal_length_m;
  const std::shared_ptr<const sensor::Lens> optics = lens_of(lens, *focal_plane());
  const auto side = [&](double x, double y) {
    const sensor::Lens::Place at = optics ? optics->direction_of({x, y}) : sensor::Lens::Place{x, y};
    return std::atan(std::hypot(at.x, at.y));
  };
  return format("frame, {} x {} pixels, {:.4g} x {:.4g} deg{}, {}", size.width_px, size.height_px,
                (side(-right, 0.0) + side(right, 0.0)) * kDegrees,
                (side(0.0, -down) + side(0.0, down)) * kDegrees,
                !optics         ? std::string()
                : lens.elements ? std::string(", elements by a table")
                                : format(", lens distortion by {:.3g} px at the lower right corner",
                                         moved_px_of(*optics, right, down, focal_length_m / pitch_m)),
                placed   ? format("at {} {:.8g}, {:.8g}, {:.6g} m", axes, p.x, p.y, p.z)
                : flight ? path_description(*flight, shift_m, axes)
                         : "without a platform");
}

std::shared_ptr<const CameraSettings> FrameCamera::shrunk(int longest_px) const {
  auto camera = std::make_shared<FrameCamera>(*this);
  const double factor = size.times(longest_px);
  camera->size = size.divided(factor);
  camera->lens = lens.of(size);
  camera->pitch_m *= factor;
  // The same time for all rows.
  camera->row_period_s *= static_cast<double>(size.height_px) / camera->size.height_px;
  return camera;
}

std::shared_ptr<const CameraSettings> FrameCamera::seen_from(double zenith_rad, double azimuth_rad) const {
  if (!placed)
    throw InputError(
        "a frame camera without a 'position' looks where its platform carries it: it cannot be asked to look from elsewhere");
  auto camera = std::make_shared<FrameCamera>(*this);
  const math::Vec3 up = geodesy::direction_enu(azimuth_rad, 0.5 * std::numbers::pi - zenith_rad).v;
  camera->orientation = LookAt{position_m - up, std::nullopt};
  return camera;
}

std::shared_ptr<const CameraSettings> FrameCamera::carried_by(
    std::shared_ptr<const PlatformFlight> by) const {
  if (placed && by)
    throw InputError(
        "the frame camera has a 'position' of its own, at which it stands, so that no platform carries it; expected no 'position', 'look_at', "
        "'attitude' or 'up', or no 'platform'");
  if (placed) return nullptr;
  if (!by) throw InputError(kPlaceless);
  check_flight(*by);
  auto camera = std::make_shared<FrameCamera>(*this);
  camera->flight = std::move(by);
  return camera;
}

std::optional<FocalPlane> FrameCamera::focal_plane() const {
  return FocalPlane{size.width_px, size.height_px, pitch_m / focal_length_m, focal_length_m};
}

std::optional<SensitiveSide> FrameCamera::sensitive_side() const {
  return io::sensitive_side(lens, *focal_plane());
}

std::vector<std::string> FrameCamera::remarks() const {
  return flight ? flight_remarks(*flight) : std::vector<std::string>{};
}

}  // namespace ifov::io
