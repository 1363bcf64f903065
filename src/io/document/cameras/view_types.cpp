#include "io/document/cameras/view_settings.h"
#include "io/document/cameras/view_table.h"
#include "io/document/schema/record.h"

namespace ifov::io {
namespace {

constexpr int kMostCells = 100;

/// The keys of an area, in a record of what looks at it.
template <class T>
Record<T>& add_area(Record<T>& record) {
  return record
      .optional("center", path(&T::area, &ViewedArea::centre_m), tuple<double, 2>(quantity(kLength)),
                "middle of the area; the scene's origin if not given")
      .optional(
          "size", path(&T::area, &ViewedArea::size_m),
          tuple<double, 2>(quantity(kLength, Range::above(0.0, "m"))),
          "of the area, from west to east and from south to north; if not given that of a `periodic` scene, all of "
          "which it then is")
      .with_default("height", path(&T::area, &ViewedArea::height_m), quantity(kLength), "\"0 m\"",
                    "of the horizontal plane that the area lies in");
}

}  // namespace

SchemaType<DistantSensor> distant_type() {
  Record<ViewedDirection> direction("direction", "From the area towards the sensor.");
  direction
      .required("zenith", &ViewedDirection::zenith_rad,
                quantity(kAngle, Range::between(-kMostZenith_deg, kMostZenith_deg, "deg")),
                "its angle to the vertical; a negative one lies on the other side of that")
      .with_default("azimuth", &ViewedDirection::azimuth_rad, quantity(kAngle), "\"0 deg\"",
                    "clockwise from north");
  Record<DistantSensor> record(
      "distant sensor",
      "No picture: what leaves an area towards each of a list of directions, as radiance and as reflectance factor.");
  record.exactly_one()
      .one("directions", &DistantSensor::directions, list(direction.type(), 1, kMostViews),
           "towards each of which the area's radiance is told")
      .one("file", &DistantSensor::file, file(),
           "instead: a table with the columns `view_zenith_deg` and `view_azimuth_deg`");
  return add_area(record).type();
}

SchemaType<HemisphereSensor> hemisphere_type() {
  Record<HemisphereSensor> record(
      "hemisphere sensor",
      "No picture: what leaves an area towards directions by chance all over the hemisphere, and its albedo from them.");
  record.with_default(
      "cells", &HemisphereSensor::cells, integer(1, kMostCells), "6",
      "along a side of the square that the hemisphere is turned into, as it is seen from far above; two directions are drawn in each "
      "of the cells, which have the same projected solid angle");
  return add_area(record).type();
}

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

}  // namespace ifov::io
