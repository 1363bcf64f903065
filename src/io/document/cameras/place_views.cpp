#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/cameras/view_table.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"

namespace ifov::io {
namespace {

using sensor::ViewList;

/// Positions and directions of a table with these columns.
std::vector<double> read_places(const std::string& path, std::span<const ViewColumn> columns) {
  std::vector<double> rows = read_view_table(path, columns);
  for (std::size_t k = 0; k < rows.size(); k += 6)
    if (rows[k + 3] == 0.0 && rows[k + 4] == 0.0 && rows[k + 5] == 0.0)
      throw InputError(format("'{}': row {} has no direction: its '{}', '{}' and '{}' are 0", path, k / 6 + 1,
                              columns[3].name, columns[4].name, columns[5].name));
  return rows;
}

std::vector<ViewedPoint> read_points(const std::string& path) {
  const ViewColumn columns[] = {{"x_m"},
                                {"y_m"},
                                {"z_m"},
                                {"nx", 1.0, -1e12, 1e12, 0.0},
                                {"ny", 1.0, -1e12, 1e12, 0.0},
                                {"nz", 1.0, -1e12, 1e12, 1.0}};
  const std::vector<double> rows = read_places(path, columns);
  std::vector<ViewedPoint> points;
  for (std::size_t k = 0; k < rows.size(); k += 6)
    points.push_back({{rows[k], rows[k + 1], rows[k + 2]}, {rows[k + 3], rows[k + 4], rows[k + 5]}});
  return points;
}

std::vector<ViewedRay> read_rays(const std::string& path) {
  const ViewColumn columns[] = {{"x_m"}, {"y_m"}, {"z_m"}, {"dx"}, {"dy"}, {"dz"}};
  const std::vector<double> rows = read_places(path, columns);
  std::vector<ViewedRay> rays;
  for (std::size_t k = 0; k < rows.size(); k += 6)
    rays.push_back({{rows[k], rows[k + 1], rows[k + 2]}, {rows[k + 3], rows[k + 4], rows[k + 5]}});
  return rays;
}

std::shared_ptr<ViewList> list_of(ViewList::Kind kind, const char* x, const char* y, const char* z) {
  auto list = std::make_shared<ViewList>();
  list->kind = kind;
  list->columns = {{"x_m", "m"}, {"y_m", "m"}, {"z_m", "m"}, {x, "1"}, {y, "1"}, {z, "1"}};
  return list;
}

void add(ViewList& list, math::Point3 position, math::Vec3 direction) {
  list.values.insert(list.values.end(),
                     {position.x, position.y, position.z, direction.x, direction.y, direction.z});
}

}  // namespace

std::unique_ptr<sensor::Camera> PointsSensor::build(const CameraSite& site) const {
  auto list = list_of(ViewList::Kind::points, "nx", "ny", "nz");
  std::vector<std::unique_ptr<const sensor::SingleView>> views;
  for (const ViewedPoint& point : file ? read_points(file->path) : points) {
    const math::Vec3 normal = math::normalized(point.normal);
    add(*list, point.position_m, normal);
    views.push_back(std::make_unique<sensor::HemisphereView>(point.position_m - site.offset_m, normal));
  }
  return std::make_unique<sensor::ViewListCamera>(std::move(list), std::move(views));
}

std::string PointsSensor::what() const {
  return file ? format("irradiance at the points of '{}'", file->path)
              : format("irradiance at {} points", points.size());
}

std::unique_ptr<sensor::Camera> RaysSensor::build(const CameraSite& site) const {
  auto list = list_of(ViewList::Kind::rays, "dx", "dy", "dz");
  std::vector<std::unique_ptr<const sensor::SingleView>> views;
  for (const ViewedRay& ray : file ? read_rays(file->path) : rays) {
    const math::Vec3 direction = math::normalized(ray.direction);
    add(*list, ray.from_m, direction);
    views.push_back(std::make_unique<sensor::RayView>(ray.from_m - site.offset_m, direction));
  }
  return std::make_unique<sensor::ViewListCamera>(std::move(list), std::move(views));
}

std::string RaysSensor::what() const {
  return file ? format("radiance along the rays of '{}'", file->path)
              : format("radiance along {} rays", rays.size());
}

std::shared_ptr<const CameraSettings> ViewSettings::shrunk(int) const {
  throw InputError(
      "a preview is of a picture, and single views make none: render them, at a coarse accuracy first");
}

std::shared_ptr<const CameraSettings> ViewSettings::seen_from(double, double) const {
  throw InputError("single views look where they are told to: they cannot be asked to look from elsewhere");
}

}  // namespace ifov::io
