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
  std::optional<math::Point3> position_m;
  std::optional<double> longitude_rad, latitude_rad;
  double height_m = 0.0;
};

FramedPoint point_of(const PlaceEntry& entry);
PlaceEntry entry_of_point(const FramedPoint& point);

/// Fails unless a place is told as its frame tells it; `key` is that of coordinates in metres.
void check_place(const PlaceEntry& entry, const DocumentNode& node, const char* key);

SchemaType<PathFrame> place_frame();

/// `frame`, and the keys of a place in it: `key` with three coordinates, or longitude, latitude and height.
template <class T>
void add_place(Record<T>& record, PlaceEntry T::*place, const char* key, const std::string& what) {
  const auto of = [place](auto member) { return path(place, member); };
  record
      .required("frame", of(&PlaceEntry::frame), place_frame(),
                "of " + what + "; others than the scene's need `latitude` and `longitude` of the `origin`")
      .optional(key, of(&PlaceEntry::position_m), point(),
                what + ": of the scene east, north, up about its origin; of ECEF Earth-centred, Earth-fixed")
      .optional("longitude", of(&PlaceEntry::longitude_rad),
                quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
                std::string("geodetic, in place of `") + key + "`")
      .optional("latitude", of(&PlaceEntry::latitude_rad),
                quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "geodetic")
      .with_default("height", of(&PlaceEntry::height_m), quantity(kLength), "\"0 m\"",
                    "geodetic: above the ellipsoid WGS 84")
      .needs("height", "latitude")
      .check(
          [place, key](const T& entry, const DocumentNode& node) { check_place(entry.*place, node, key); });
}

}  // namespace ifov::io
