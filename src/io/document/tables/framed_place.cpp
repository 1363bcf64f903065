#include "io/document/tables/framed_place.h"

#include "core/format.h"

namespace ifov::io {

FramedPoint point_of(const PlaceEntry& entry) {
  if (entry.frame == PathFrame::geodetic)
    return {entry.frame, {*entry.longitude_rad, *entry.latitude_rad, entry.height_m}};
  return {entry.frame, {entry.position_m->x, entry.position_m->y, entry.position_m->z}};
}

PlaceEntry entry_of_point(const FramedPoint& point) {
  const auto [x, y, z] = point.place;
  if (point.frame == PathFrame::geodetic) return {point.frame, {}, x, y, z};
  return {point.frame, math::Point3{x, y, z}, {}, {}, 0.0};
}

void check_place(const PlaceEntry& entry, const DocumentNode& node, const char* key) {
  const bool geodetic = entry.frame == PathFrame::geodetic;
  if (geodetic && (!entry.longitude_rad || !entry.latitude_rad || entry.position_m))
    node.given("frame").fail("a geodetic point is told by 'longitude', 'latitude' and 'height'");
  if (!geodetic && (!entry.position_m || entry.longitude_rad || entry.latitude_rad))
    node.given("frame").fail(format("a point in this frame is told by its '{}' alone", key));
}

SchemaType<PathFrame> place_frame() {
  return choice<PathFrame>(
      {{"scene", PathFrame::scene}, {"geodetic", PathFrame::geodetic}, {"ecef", PathFrame::ecef}});
}

}  // namespace ifov::io
