#pragma once

#include "io/document/record.h"
#include "io/document/scene_document.h"

namespace ifov::io {

/// Adds the keys of a raster draped from above to the table of a T with a member `raster`.
template <class T>
void add_raster_keys(Record<T>& record) {
  const auto placement = [](T& t) -> RasterDocument::Placement& {
    return t.raster.placement ? *t.raster.placement : t.raster.placement.emplace();
  };
  record
      .required(
          "file", [](T& t, DocumentFile f) { t.raster.file = std::move(f); }, file(),
          "a raster that GDAL reads")
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

}  // namespace ifov::io
