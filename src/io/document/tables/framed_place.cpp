#include "io/document/tables/framed_place.h"

#include "core/format.h"

namespace ifov::io {

FramedPoint point_of(const PlaceEntry& entry) {
  if (entry.frame == PathFrame::geodetic)
    return {entry.frame, {*entry.longitude_rad, *entry.latitude_rad, entry.height_m}};
  return {entry.frame, {entry.position_m->x, entry.position_m->y, entry.position_m->z}, entry.crs};
}

PlaceEntry entry_of_point(const FramedPoint& point) {
  const auto [x, y, z] = point.place;
  if (point.frame == PathFrame::geodetic) return {point.frame, {}, {}, x, y, z};
  return {point.frame, point.crs, math::Point3{x, y, z}, {}, {}, 0.0};
}

void check_place(const PlaceEntry& entry, const DocumentNode& told, const char* key) {
  const bool geodetic = entry.frame == PathFrame::geodetic;
  if (geodetic && (!entry.longitude_rad || !entry.latitude_rad || entry.position_m))
    told.fail("a geodetic point is told by 'longitude', 'latitude' and 'height'");
  if (!geodetic && (!entry.position_m || entry.longitude_rad || entry.latitude_rad))
    told.fail(format("a point in this frame is told by its '{}' alone", key));
}

void check_crs(PathFrame frame, const DocumentNode& node) {
  if (frame != PathFrame::map && node.find("crs") != nullptr)
    node.given("crs").fail_at_key(
        "'crs' names a map, and 'frame' is none; expected 'frame' \"map\", or no 'crs'");
}

SchemaType<PathFrame> earth_frame() {
  return choice<PathFrame>({{"scene", PathFrame::scene},
                            {"geodetic", PathFrame::geodetic},
                            {"map", PathFrame::map},
                            {"ecef", PathFrame::ecef}});
}

SchemaType<PathFrame> any_frame() {
  return choice<PathFrame>({{"scene", PathFrame::scene},
                            {"geodetic", PathFrame::geodetic},
                            {"map", PathFrame::map},
                            {"ecef", PathFrame::ecef},
                            {"teme", PathFrame::teme},
                            {"gcrs", PathFrame::gcrs}});
}

SchemaType<DocumentName> map_name() {
  return located<DocumentName>(
      label(),
      [](std::string name, const DocumentNode& node) {
        return DocumentName{std::move(name), node.position()};
      },
      [](const DocumentName& name) { return name.name; });
}

}  // namespace ifov::io
