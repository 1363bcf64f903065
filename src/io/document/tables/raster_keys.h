#pragma once

#include "io/document/map_document.h"
#include "io/document/schema/record.h"

namespace ifov::io {

/// Adds `low_left` and `size` to the table of a T; `members` lead to where they go, a std::optional of a Placement.
template <class T, class... Members>
void add_placement_keys(Record<T>& record, Members... members) {
  using Placement = RasterDocument::Placement;
  const auto pair = [members...](double Placement::*first, double Placement::*second) {
    const auto first_of = path(members..., first), second_of = path(members..., second);
    return via(
        [first_of, second_of](T& t, std::array<double, 2> values) {
          store(t, first_of, values[0]);
          store(t, second_of, values[1]);
        },
        [first_of, second_of](const T& t) -> std::optional<std::array<double, 2>> {
          const auto a = load<double>(t, first_of), b = load<double>(t, second_of);
          return a ? std::optional(std::array{*a, *b}) : std::nullopt;
        });
  };
  record
      .optional("low_left", pair(&Placement::x_m, &Placement::y_m), tuple<double, 2>(quantity(kLength)),
                "easting and northing of its lower left corner; without it the raster's georeference counts")
      .optional("size", pair(&Placement::width_m, &Placement::height_m),
                tuple<double, 2>(quantity(kLength, Range::above(0.0, "m"))),
                "its extent to the east and to the north")
      .needs("low_left", "size")
      .needs("size", "low_left");
}

/// Adds the keys of a raster that lies on surfaces to the table of a T with a member `raster`.
template <class T>
void add_raster_keys(Record<T>& record) {
  record.required("file", path(&T::raster, &RasterDocument::file), file(), "a raster that GDAL reads");
  add_placement_keys(record, &T::raster, &RasterDocument::placement);
  record
      .with_default(
          "by", path(&T::raster, &RasterDocument::by_texture),
          choice<bool>({{"place", false}, {"texture coordinates", true}}), "\"place\"",
          "draped from above, or by the texture coordinates of the surface, of which 0 to 1 hold the raster once "
          "(v rises from its last row to its first)")
      .with_default("copies",
                    via([](T& t, std::array<double, 2> copies) { t.raster.copies = copies; },
                        [](const T& t) { return t.raster.by_texture ? &t.raster.copies : nullptr; }),
                    tuple<double, 2>(number(Range::above(0.0))), "[1, 1]",
                    "by texture coordinates: how many copies of the raster lie in one unit of u and of v")
      .with_default(
          "tiling", path(&T::raster, &RasterDocument::tiling),
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
