#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/cameras/view_table.h"
#include "io/document/schema/record.h"
#include "sensor/view_list.h"

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

SchemaType<PointsSensor> points_type() {
  Record<ViewedPoint> point_record("point", "A plane at a point.");
  point_record.required("position", &ViewedPoint::position_m, point(), "where it is; it may lie on a surface")
      .with_default("normal", &ViewedPoint::normal, direction(), "[0, 0, 1]",
                    "of the plane, towards the side that is lit");
  Record<PointsSensor> record(
      "points",
      "No picture: the irradiance on planes at points, by the Sun, the sky and all that stands around, and the share of the sky that "
      "they see.");
  record.exactly_one()
      .one("at", &PointsSensor::points, list(point_record.type(), 1, kMostViews), "the points")
      .one(
          "file", &PointsSensor::file, file(),
          "instead: a table with the columns `x_m`, `y_m`, `z_m` and, where normals are not all up, `nx`, `ny`, `nz`");
  return record.type();
}

SchemaType<RaysSensor> rays_type() {
  Record<ViewedRay> ray("ray", "A line of sight.");
  ray.required("from", &ViewedRay::from_m, point(), "where it begins")
      .required("direction", &ViewedRay::direction, direction(), "where it goes, against the light");
  Record<RaysSensor> record("rays", "No picture: the radiance that comes along each of a list of rays.");
  record.exactly_one()
      .one("along", &RaysSensor::rays, list(ray.type(), 1, kMostViews), "the rays")
      .one("file", &RaysSensor::file, file(),
           "instead: a table with the columns `x_m`, `y_m`, `z_m`, `dx`, `dy`, `dz`");
  return record.type();
}

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
