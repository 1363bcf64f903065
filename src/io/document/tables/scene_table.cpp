#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostPrototypes = 10000;

Kind<std::pair<std::string, SourcePosition>> located_text() {
  const Kind<std::string> text = label();
  return {text.description, [read = text.read](const DocumentNode& node) {
            return std::pair<std::string, SourcePosition>(read(node), node.position());
          }};
}

Kind<OriginDocument> origin_kind() {
  const auto geographic = [](OriginDocument& o) -> OriginDocument::Geographic& {
    return o.geographic ? *o.geographic : o.geographic.emplace();
  };
  Record<OriginDocument> record(
      "origin",
      "Where the scene stands. With easting and northing, coordinates in the document and "
      "in its files are map coordinates, and those of the origin are subtracted from them.");
  record
      .optional(
          "latitude", [geographic](OriginDocument& o, double v) { geographic(o).latitude_rad = v; },
          quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "geodetic (WGS 84), north positive")
      .optional(
          "longitude", [geographic](OriginDocument& o, double v) { geographic(o).longitude_rad = v; },
          quantity(kAngle, Range::between(-180.0, 360.0, "deg")), "east positive")
      .optional(
          "easting",
          [](OriginDocument& o, double v) {
            o.has_map_offset = true;
            o.offset_m.x = v;
          },
          quantity(kLength), "map coordinate of the origin")
      .optional(
          "northing", [](OriginDocument& o, double v) { o.offset_m.y = v; }, quantity(kLength),
          "map coordinate of the origin")
      .optional(
          "crs",
          [](OriginDocument& o, std::pair<std::string, SourcePosition> crs) {
            o.crs = std::move(crs.first);
            o.crs_position = std::move(crs.second);
          },
          located_text(),
          "coordinate reference system of the map coordinates, as PROJ knows it: \"EPSG:25832\"; rasters in others "
          "are taken over into it, and without easting and northing it gives those of latitude and longitude")
      .with_default("height", &OriginDocument::height_m, quantity(kLength), "\"0 m\"",
                    "of the origin above the ellipsoid; with map coordinates, also subtracted from z")
      .needs("latitude", "longitude")
      .needs("longitude", "latitude")
      .needs("easting", "northing")
      .needs("northing", "easting")
      .check([](const OriginDocument& origin, const DocumentNode& node) {
        if (!origin.crs.empty() && !origin.has_map_offset && !origin.geographic)
          node.given("crs").fail_at_key(
              "with 'crs', give 'easting' and 'northing', or 'latitude' and 'longitude'");
      });
  return converted<OriginDocument>(record.kind(), [](OriginDocument origin) {
    if (origin.has_map_offset) origin.offset_m.z = origin.height_m;
    return origin;
  });
}

Kind<PeriodicDocument> periodic_kind() {
  Record<PeriodicDocument> record("periodic scene", "The cell that repeats without end to all sides.");
  record
      .required(
          "size",
          [](PeriodicDocument& p, std::array<double, 2> size) {
            p.width_m = size[0];
            p.height_m = size[1];
          },
          tuple<double, 2>(quantity(kLength, Range::above(0.0, "m"))),
          "after how much x and y everything repeats; objects may stand across the border of the cell")
      .optional(
          "low_left", &PeriodicDocument::low_left_m, tuple<double, 2>(quantity(kLength)),
          "lower left corner of the cell, as it is drawn; without it the cell is centred on the origin");
  const Kind<PeriodicDocument> kind = record.kind();
  return {kind.description, [read = kind.read](const DocumentNode& node) {
            PeriodicDocument periodic = read(node);
            periodic.position = node.position();
            return periodic;
          }};
}

template <class T>
std::vector<T> with_names(std::vector<std::pair<std::string, T>> named) {
  std::vector<T> values;
  for (auto& [name, value] : named) {
    value.name = std::move(name);
    values.push_back(std::move(value));
  }
  return values;
}

Kind<std::vector<std::pair<std::string, PrototypeDocument>>> prototypes_kind() {
  const auto objects = objects_kind();
  const Kind<PrototypeDocument> prototype{objects.description,
                                          [read = objects.read](const DocumentNode& node) {
                                            return PrototypeDocument{{}, read(node), node.key_position()};
                                          }};
  return map_of(prototype, "prototypes", kMostPrototypes);
}

}  // namespace

Kind<SceneDocument> scene_kind() {
  Record<SceneDocument> record("scene", "Coordinates are metres east, north and up.");
  record.optional("origin", &SceneDocument::origin, origin_kind(), "where the scene stands")
      .optional("periodic", &SceneDocument::periodic, periodic_kind(),
                "makes the scene a cell that repeats without end")
      .required(
          "materials",
          [](SceneDocument& s, std::vector<std::pair<std::string, MaterialDocument>> m) {
            s.materials = with_names(std::move(m));
          },
          materials_kind(), "what surfaces are made of")
      .optional(
          "prototypes",
          [](SceneDocument& s, std::vector<std::pair<std::string, PrototypeDocument>> p) {
            s.prototypes = with_names(std::move(p));
          },
          prototypes_kind(), "objects that are copied, in coordinates of their own")
      .required("objects", &SceneDocument::objects, objects_kind(), "what stands in the scene");
  return record.kind();
}

}  // namespace ifov::io
