#include "io/document/scene_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostPrototypes = 10000;

SchemaType<std::pair<std::string, SourcePosition>> located_text() {
  using Text = std::pair<std::string, SourcePosition>;
  return located<Text>(
      label(),
      [](std::string text, const DocumentNode& node) { return Text(std::move(text), node.position()); },
      [](const Text& text) { return text.first; });
}

SchemaType<OriginDocument> origin_type() {
  using Geographic = OriginDocument::Geographic;
  // Northing is given beside easting.
  const auto map_offset = [](double math::Vec3::*part) {
    return via(
        [part](OriginDocument& o, double v) {
          o.has_map_offset = true;
          o.offset_m.*part = v;
        },
        [part](const OriginDocument& o) { return o.has_map_offset ? &(o.offset_m.*part) : nullptr; });
  };
  Record<OriginDocument> record(
      "origin",
      "Where the scene stands. With easting and northing, coordinates in the document and "
      "in its files are map coordinates, and those of the origin are subtracted from them.");
  record
      .optional("latitude", path(&OriginDocument::geographic, &Geographic::latitude_rad),
                quantity(kAngle, Range::between(-90.0, 90.0, "deg")), "geodetic (WGS 84), north positive")
      .optional("longitude", path(&OriginDocument::geographic, &Geographic::longitude_rad),
                quantity(kAngle, Range::between(-180.0, 360.0, "deg")), "east positive")
      .optional("easting", map_offset(&math::Vec3::x), quantity(kLength), "map coordinate of the origin")
      .optional("northing", map_offset(&math::Vec3::y), quantity(kLength), "map coordinate of the origin")
      .optional(
          "crs",
          via(
              [](OriginDocument& o, std::pair<std::string, SourcePosition> crs) {
                o.crs = std::move(crs.first);
                o.crs_position = std::move(crs.second);
              },
              [](const OriginDocument& o) {
                return o.crs.empty() ? std::nullopt : std::optional(std::pair(o.crs, o.crs_position));
              }),
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
  return converted<OriginDocument>(
      record.type(),
      [](OriginDocument origin) {
        if (origin.has_map_offset) origin.offset_m.z = origin.height_m;
        return origin;
      },
      [](const OriginDocument& origin) { return origin; });
}

SchemaType<PeriodicDocument> periodic_type() {
  Record<PeriodicDocument> record("periodic scene", "The cell that repeats without end to all sides.");
  record
      .required("size",
                via(
                    [](PeriodicDocument& p, std::array<double, 2> size) {
                      p.width_m = size[0];
                      p.height_m = size[1];
                    },
                    [](const PeriodicDocument& p) {
                      return std::array{p.width_m, p.height_m};
                    }),
                tuple<double, 2>(quantity(kLength, Range::above(0.0, "m"))),
                "after how much x and y everything repeats; objects may stand across the border of the cell")
      .optional(
          "low_left", &PeriodicDocument::low_left_m, tuple<double, 2>(quantity(kLength)),
          "lower left corner of the cell, as it is drawn; without it the cell is centred on the origin");
  const SchemaType<PeriodicDocument> type = record.type();
  return {type.description,
          [read = type.read](const DocumentNode& node) {
            PeriodicDocument periodic = read(node);
            periodic.position = node.position();
            return periodic;
          },
          type.write};
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

/// Where things with names go, and come from again.
template <class T>
auto by_name(std::vector<T> SceneDocument::*member) {
  using Named = std::vector<std::pair<std::string, T>>;
  return via([member](SceneDocument& scene, Named named) { scene.*member = with_names(std::move(named)); },
             [member](const SceneDocument& scene) {
               Named named;
               for (const T& value : scene.*member) named.emplace_back(value.name, value);
               return named;
             });
}

SchemaType<std::vector<std::pair<std::string, PrototypeDocument>>> prototypes_type() {
  const auto objects = objects_type();
  const auto prototype = located<PrototypeDocument>(
      objects,
      [](std::vector<ObjectDocument> all, const DocumentNode& node) {
        return PrototypeDocument{{}, std::move(all), node.key_position()};
      },
      [](const PrototypeDocument& one) { return one.objects; });
  return map_of(prototype, "prototypes", kMostPrototypes);
}

}  // namespace

SchemaType<SceneDocument> scene_type() {
  Record<SceneDocument> record("scene", "Coordinates are metres east, north and up.");
  record.optional("origin", &SceneDocument::origin, origin_type(), "where the scene stands")
      .optional("periodic", &SceneDocument::periodic, periodic_type(),
                "makes the scene a cell that repeats without end")
      .required("materials", by_name(&SceneDocument::materials), materials_type(),
                "what surfaces are made of")
      .optional("prototypes", by_name(&SceneDocument::prototypes), prototypes_type(),
                "objects that are copied, in coordinates of their own")
      .required("objects", &SceneDocument::objects, objects_type(), "what stands in the scene");
  return record.type();
}

}  // namespace ifov::io
