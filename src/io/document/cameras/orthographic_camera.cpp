#include "io/document/cameras/orthographic_camera.h"

#include <numbers>

#include "core/format.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/schema/record.h"
#include "sensor/orthographic_camera.h"

namespace ifov::io {
namespace {

SchemaType<std::shared_ptr<const CameraSettings>> orthographic_type() {
  Record<OrthographicCamera> record("orthographic camera",
                                    "Looks down with parallel rays; pixels are squares of the plane z = 0.");
  record
      .required("gsd", &OrthographicCamera::gsd_m, quantity(kLength, Range::above(0.0, "m")),
                "ground sample distance")
      .required("pixels", &OrthographicCamera::size, image_size_type(), "columns and rows")
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
  return settings_type(record.type());
}

}  // namespace

constinit const CameraModel OrthographicCamera::kModel{"orthographic", "looks down with parallel rays",
                                                       orthographic_type};

std::unique_ptr<sensor::Camera> OrthographicCamera::build(const CameraSite& site) const {
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = size.width_px;
  settings.height_px = size.height_px;
  settings.gsd_m = gsd_m;
  if (centre_m) {
    settings.centre_x_m = (*centre_m)[0] - site.offset_m.x;
    settings.centre_y_m = (*centre_m)[1] - site.offset_m.y;
  }
  settings.rotation_rad = rotation_rad;
  settings.view_zenith_rad = view_zenith_rad;
  settings.view_azimuth_rad = view_azimuth_rad;
  // Above everything, by enough that no surface touches the plane the rays start from.
  settings.start_height_m = height_m ? *height_m - site.offset_m.z : site.highest_m + 1.0;
  return std::make_unique<sensor::OrthographicCamera>(settings);
}

std::string OrthographicCamera::description(math::Vec3, std::string_view) const {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::string text = format("orthographic, {} x {} pixels of {:g} m", size.width_px, size.height_px, gsd_m);
  if (view_zenith_rad > 0.0)
    text += format(", {:.4g} deg from the vertical, seen from azimuth {:.4g} deg", view_zenith_rad * kDegrees,
                   view_azimuth_rad * kDegrees);
  return text;
}

std::shared_ptr<const CameraSettings> OrthographicCamera::shrunk(int longest_px) const {
  auto camera = std::make_shared<OrthographicCamera>(*this);
  const double factor = size.times(longest_px);
  camera->size = size.divided(factor);
  camera->gsd_m *= factor;
  return camera;
}

std::shared_ptr<const CameraSettings> OrthographicCamera::seen_from(double zenith_rad,
                                                                    double azimuth_rad) const {
  auto camera = std::make_shared<OrthographicCamera>(*this);
  camera->view_zenith_rad = zenith_rad;
  camera->view_azimuth_rad = azimuth_rad;
  return camera;
}

std::optional<FocalPlane> OrthographicCamera::focal_plane() const {
  return FocalPlane{size.width_px, size.height_px, 0.0, std::nullopt};
}

}  // namespace ifov::io
