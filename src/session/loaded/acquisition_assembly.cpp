#include "session/loaded/acquisition_assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesy/sun_position.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "io/raster/map_reference.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

io::Acquisition::Light light_of(const scene::Sun& sun) {
  return {sun.zenith_rad() * kDegrees, geodesy::compass_deg(sun.azimuth_rad()), sun.is_moon};
}

/// What a ray of the camera meets.
std::optional<math::Point3> ground_position(const Parts& parts, const math::Ray& ray) {
  geometry::SurfacePoint hit;
  parts.scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit.hit() ? std::optional(hit.position_m) : std::nullopt;
}

io::Acquisition::Pose pose_of(const sensor::CameraPose& pose, math::Vec3 map_offset_m) {
  return {pose.position_m.value_or(math::Point3{}) + map_offset_m, pose.axes.right, pose.axes.down,
          pose.axes.forward};
}

io::Acquisition::Camera camera_of(const Parts& parts) {
  const sensor::Camera& reported = parts.camera->reported();
  const sensor::CameraPose pose = reported.pose(parts.camera->middle_line_px());
  io::Acquisition::Camera camera;
  camera.model = parts.document.sensor.camera.model;
  camera.right = pose.axes.right, camera.down = pose.axes.down, camera.forward = pose.axes.forward;
  camera.focal_length_m = pose.focal_length_m, camera.pitch_m = pose.pitch_m;
  if (pose.position_m) camera.position_m = *pose.position_m + parts.map_offset_m;
  const int height = parts.camera->height_px();
  const double first = parts.camera->pose(0.5).time_s, last = parts.camera->pose(height - 0.5).time_s;
  if (first != last) {
    const int lines = std::min(height, io::Acquisition::Camera::kMostLines);
    for (int k = 0; k < lines; ++k) {
      const double line = 0.5 + std::round(static_cast<double>(k) * (height - 1) / (lines - 1));
      const sensor::CameraPose at = reported.pose(line);
      camera.lines.push_back({line, at.time_s, pose_of(at, parts.map_offset_m), std::nullopt});
      if (&reported != parts.camera.get())
        camera.lines.back().truth = pose_of(parts.camera->pose(line), parts.map_offset_m);
    }
  }
  if (const auto grid = parts.camera->ground_grid())
    camera.ground_sample_m = grid->gsd_m;
  else if (const auto middle = ground_position(parts, parts.camera->middle_ray()))
    camera.ground_sample_m = parts.camera->gsd_m(*middle);
  return camera;
}

/// Longitude and latitude of places on the scene's map; nothing where it has no system.
class Degrees {
 public:
  explicit Degrees(const std::string& system) {
    if (system != "Arbitrary") transform_.emplace(io::MapReference(system), io::MapReference("EPSG:4326"));
  }
  std::optional<io::Acquisition::Position> operator()(math::Point3 position_m) const {
    if (!transform_) return std::nullopt;
    try {
      const io::MapPoint p = (*transform_)({position_m.x, position_m.y});
      return io::Acquisition::Position{p.y, p.x};
    } catch (const InputError&) {  // a place far outside of the projection
      return std::nullopt;
    }
  }

 private:
  std::optional<io::MapTransform> transform_;
};

}  // namespace

std::optional<io::Acquisition::Position> geographic_position(const std::string& map_system,
                                                             math::Point3 on_map_m) {
  return Degrees(map_system)(on_map_m);
}

io::Acquisition assemble_acquisition(const Parts& parts) {
  const io::Document& document = parts.document;
  io::Acquisition result;
  if (document.time) result.time = geodesy::format_utc(*document.time);
  if (parts.scene.sun) result.light = light_of(*parts.scene.sun);
  const Degrees degrees(parts.info.map_projection);
  result.origin_on_map_m = math::Point3{} + parts.map_offset_m;
  result.origin_height_m = document.scene.origin.height_m;
  if (const auto& position = document.scene.origin.geographic)
    result.origin =
        io::Acquisition::Position{position->latitude_rad * kDegrees, position->longitude_rad * kDegrees};
  else
    result.origin = degrees(result.origin_on_map_m);
  result.camera = camera_of(parts);
  const double width = parts.info.width_px, height = parts.info.height_px;
  const double corners[][2] = {{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}};
  for (const auto& [x, y] : corners) {
    result.footprint.emplace_back();
    if (const auto position = ground_position(parts, parts.camera->reported().ray({x, y}))) {
      const math::Point3 on_map = *position + parts.map_offset_m;
      result.footprint.back() = {on_map, degrees(on_map)};
    }
  }
  return result;
}

}  // namespace ifov::session
