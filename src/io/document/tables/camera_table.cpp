#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr int kMostPixelsASide = 100000;
constexpr std::int64_t kMostPixels = 1000000000;

Kind<std::array<int, 2>> pixels_kind() {
  const auto pair = tuple<int, 2>(integer(1, kMostPixelsASide));
  return {pair.description, [read = pair.read](const DocumentNode& node) {
            const std::array<int, 2> size = read(node);
            if (std::int64_t{size[0]} * size[1] > kMostPixels) {
              node.fail(format("{} has {} x {} pixels, more than the {} allowed", node.title(), size[0],
                               size[1], kMostPixels));
            }
            return size;
          }};
}

template <class Camera>
void set_pixels(Camera& camera, std::array<int, 2> size) {
  camera.width_px = size[0];
  camera.height_px = size[1];
}

Kind<OrthographicCamera> orthographic_kind() {
  Record<OrthographicCamera> record("orthographic camera",
                                    "Looks down with parallel rays; pixels are squares of the plane z = 0.");
  record
      .required("gsd", &OrthographicCamera::gsd_m, quantity(kLength, Range::above(0.0, "m")),
                "ground sample distance")
      .required("pixels", set_pixels<OrthographicCamera>, pixels_kind(), "columns and rows")
      .optional("center", &OrthographicCamera::centre_m, tuple<double, 2>(quantity(kLength)),
                "ground point at the image's centre; the scene's origin if not given")
      .with_default("rotation", &OrthographicCamera::rotation_rad, quantity(kAngle), "\"0 deg\"",
                    "azimuth, clockwise from north, that the top of the image points to")
      .optional("height", &OrthographicCamera::height_m, quantity(kLength),
                "z where rays start; above everything if not given")
      .with_default("view_zenith", &OrthographicCamera::view_zenith_rad,
                    quantity(kAngle, Range::between(0.0, 89.0, "deg")), "\"0 deg\"",
                    "angle between the vertical and the direction from the ground to the sensor")
      .with_default("view_azimuth", &OrthographicCamera::view_azimuth_rad, quantity(kAngle), "\"0 deg\"",
                    "azimuth, clockwise from north, of the direction from the ground to the sensor");
  return record.kind();
}

Kind<Attitude> attitude_kind() {
  Record<Attitude> record(
      "attitude",
      "Attitude of the aircraft that the camera hangs below, its axis along the body's down and the "
      "top of the image at the nose: 3-2-1 sequence in north-east-down axes. All zero looks "
      "straight down with north at the top.");
  record
      .with_default("yaw", &Attitude::yaw_rad, quantity(kAngle), "\"0 deg\"", "heading, clockwise from north")
      .with_default("pitch", &Attitude::pitch_rad, quantity(kAngle, Range::between(-90.0, 90.0, "deg")),
                    "\"0 deg\"", "nose up")
      .with_default("roll", &Attitude::roll_rad, quantity(kAngle), "\"0 deg\"", "right wing down");
  return record.kind();
}

struct FrameEntry {
  FrameCamera camera;
  std::optional<math::Vec3> up;
};

Kind<FrameCamera> frame_kind() {
  const Kind<double> length = quantity(kLength, Range::above(0.0, "m"));
  Record<FrameEntry> record("frame camera", "A pinhole with a frame of detector elements behind it.");
  record
      .required(
          "focal_length", [](FrameEntry& e, double v) { e.camera.focal_length_m = v; }, length,
          "focal length")
      .required(
          "pitch", [](FrameEntry& e, double v) { e.camera.pitch_m = v; }, length,
          "distance between detector elements")
      .required(
          "pixels", [](FrameEntry& e, std::array<int, 2> size) { set_pixels(e.camera, size); }, pixels_kind(),
          "columns and rows")
      .required(
          "position", [](FrameEntry& e, math::Point3 p) { e.camera.position_m = p; }, point(),
          "where the camera is")
      .exactly_one()
      .one(
          "look_at",
          [](FrameEntry& e, math::Point3 p) {
            e.camera.orientation = LookAt{p, {}};
          },
          point(), "point at the image's centre")
      .one(
          "attitude", [](FrameEntry& e, Attitude a) { e.camera.orientation = a; }, attitude_kind(),
          "instead: angles")
      .optional("up", &FrameEntry::up, direction(),
                "direction that is up in the image; +z if not given, or north where the camera looks along z")
      .needs("up", "look_at")
      .check([](const FrameEntry& entry, const DocumentNode& node) {
        const auto* look_at = std::get_if<LookAt>(&entry.camera.orientation);
        if (look_at != nullptr && look_at->target_m == entry.camera.position_m) {
          node.given("look_at").fail(
              format("{} is where the camera itself is", node.given("look_at").title()));
        }
      });
  return converted<FrameCamera>(record.kind(), [](FrameEntry entry) {
    if (auto* look_at = std::get_if<LookAt>(&entry.camera.orientation)) look_at->up = entry.up;
    return std::move(entry.camera);
  });
}

}  // namespace

Kind<CameraDocument> camera_kind() {
  Record<CameraDocument> record("camera", "Where the rays of pixels go.");
  record.exactly_one()
      .one("orthographic", &CameraDocument::model, orthographic_kind(), "looks down with parallel rays")
      .one("frame", &CameraDocument::model, frame_kind(), "a perspective camera");
  return record.kind();
}

}  // namespace ifov::io
