#pragma once

#include "io/document/map_document.h"
#include "io/document/schema/record.h"

namespace ifov::io {

/// Adds `low_left` and `size` to the table of a T; `placement_of(t)` is where they go, a std::optional of a Placement.
template <class T, class PlacementOf>
void add_placement_keys(Record<T>& record, PlacementOf placement_of) {
  const auto placement = [placement_of](T& t) -> RasterDocument::Placement& {
    std::optional<RasterDocument::Placement>& place = placement_of(t);
    return place ? *place : place.emplace();
  };
  record
      .optional(
          "low_left",
          [placement](T& t, std::array<double, 2> corner) {
            placement(t).x_m = corner[0];
            placement(t).y_m = corner[1];
          },
          tuple<double, 2>(quantity(kLength)),
          "easting and northing of its lower left corner; without it the raster's georeference counts")
      .optional(
          "size",
          [placement](T& t, std::array<double, 2> size) {
            placement(t).width_m = size[0];
            placement(t).height_m = size[1];
          },
          tuple<double, 2>(quantity(kLength, Range::above(0.0, "m"))),
          "its extent to the east and to the north")
      .needs("low_left", "size")
      .needs("size", "low_left");
}

/// Adds the keys of a raster that lies on surfaces to the table of a T with a member `raster`.
template <class T>
void add_raster_keys(Record<T>& record) {
  record.required(
      "file", [](T& t, DocumentFile f) { t.raster.file = std::move(f); }, file(), "a raster that GDAL reads");
  add_placement_keys(record,
                     [](T& t) -> std::optional<RasterDocument::Placement>& { return t.raster.placement; });
  record
      .with_default(
          "by", [](T& t, bool texture) { t.raster.by_texture = texture; },
          choice<bool>({{"place", false}, {"texture coordinates", true}}), "\"place\"",
          "draped from above, or by the texture coordinates of the surface, of which 0 to 1 hold the raster once "
          "(v rises from its last row to its first)")
      .with_default(
          "copies", [](T& t, std::array<double, 2> copies) { t.raster.copies = copies; },
          tuple<double, 2>(number(Range::above(0.0))), "[1, 1]",
          "by texture coordinates: how many copies of the raster lie in one unit of u and of v")
      .with_default(
          "tiling", [](T& t, Tiling tiling) { t.raster.tiling = tiling; },
          choice<Tiling>({{"edge", Tiling::edge}, {"repeat", Tiling::repeat}, {"mirror", Tiling::mirror}}),
          "\"edge\"", "beyond the raster: its outermost cells go on, or it repeats, or it repeats mirrored")
      .check([](const T& t, const DocumentNode& node) {
        if (t.raster.by_texture && t.raster.placement)
          node.find("low_left")
              ->fail_at_key(
                  "a raster by texture coordinates has no place on the map; its size on a "
                  "surface is set by 'copies'");
        if (!t.raster.by_texture && node.find("copies") != nullptr)
          node.find("copies")->fail_at_key(
              "'copies' is for rasters by texture coordinates; by place, 'size' sets how "
              "large one copy is");
      });
}

}  // namespace ifov::io
