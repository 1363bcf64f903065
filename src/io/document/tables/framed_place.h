#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/document/framed_point.h"
#include "io/document/schema/record.h"

namespace ifov::io {

/// A place as its keys tell it.
struct PlaceEntry {
  PathFrame frame = PathFrame::scene;
  DocumentName crs;
  std::optional<math::Point3> position_m;
  std::optional<double> longitude_rad, latitude_rad;
  double height_m = 0.0;
};

FramedPoint point_of(const PlaceEntry& entry);
PlaceEntry entry_of_point(const FramedPoint& point);

/// Fails at `told` unless a place is told as its frame tells it; `key` is that of coordinates in metres.
void check_place(const PlaceEntry& entry, const DocumentNode& told, const char* key);

/// Fails where a map is named, and the frame is none.
void check_crs(PathFrame frame, const DocumentNode& node);

/// Of places that do not turn among the stars; of all.
SchemaType<PathFrame> earth_frame();
SchemaType<PathFrame> any_frame();

/// The name of a map, of a member that holds it.
SchemaType<DocumentName> map_name();
inline constexpr const char* kMapDoc =
    "of the frame `map`: its coordinate reference system, as PROJ knows it: \"EPSG:25832\"; if not given that of the `origin`";

/// The target of a map's name, which is empty where none is given: `of` takes the record to it.
template <class T, class Of>
auto map_of(Of of) {
  return via([of](T& record, DocumentName name) { of(record) = std::move(name); },
             [of](const T& record) {
               const DocumentName& name = of(record);
               return name.name.empty() ? nullptr : &name;
             });
}

/// The keys of a place beside its frame.
template <class T>
void add_coordinates(Record<T>& record, PlaceEntry T::*place, const char* key, const std::string& what) {
  const auto of = [place](auto member) { return path(place, member); };
  record
      .optional(
          key, of(&PlaceEntry::position_m), point(),
          what +
              ": of the scene east, north, up about its origin; of a map easting, northing, height above the ellipsoid; of "
              "ECEF Earth-centred, Earth-fixed")
      .optional("longitude", of(&PlaceEntry::longitude_rad),
                quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
                std::string("geodetic, in place of `") + key + "`")
      .optional("latitude", of(&PlaceEntry::latitude_rad),
                quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "geodetic")
      .with_default("height", of(&PlaceEntry::height_m), quantity(kLength), "\"0 m\"",
                    "geodetic: above the ellipsoid WGS 84")
      .needs("height", "latitude");
}

/// `frame`, and the keys of a place in it: `key` with three coordinates, or longitude, latitude and height.
template <class T>
void add_place(Record<T>& record, PlaceEntry T::*place, const char* key, const std::string& what) {
  record
      .required("frame", path(place, &PlaceEntry::frame), earth_frame(),
                "of " + what +
                    "; others than the scene's need `latitude` and `longitude` of the `origin`, or a `crs`")
      .optional("crs", map_of<T>([place](auto& entry) -> auto& { return (entry.*place).crs; }), map_name(),
                kMapDoc);
  add_coordinates(record, place, key, what);
  record.check([place, key](const T& entry, const DocumentNode& node) {
    check_crs((entry.*place).frame, node);
    check_place(entry.*place, node.given("frame"), key);
  });
}

}  // namespace ifov::io
