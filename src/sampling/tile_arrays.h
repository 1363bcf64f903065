#pragma once

#include <string_view>

#include "sampling/tile.h"

namespace ifov::sampling {

/// An array of a tile, for whoever treats all of them alike.
struct TileArray {
  /// How many elements it has: of cells (pixels times columns), of pixels, as many as there are; or as said, or none.
  enum class Extent { cells, cells_or_none, pixels, pixels_or_none, any };
  std::string_view name;
  Extent extent = Extent::any;
  bool in_cubes = false;  ///< its values are those of a cube that every run writes, or can write
};

template <class Tile, class Visit>
void TileResult::visit_arrays(Tile& tile, const Visit& visit) {
  using Extent = TileArray::Extent;
  visit(TileArray{"mean", Extent::cells, true}, tile.mean);
  visit(TileArray{"half_width", Extent::cells_or_none, true}, tile.half_width);
  visit(TileArray{"variance_geometry", Extent::cells_or_none}, tile.variance_geometry);
  visit(TileArray{"variance_path", Extent::cells_or_none}, tile.variance_path);
  visit(TileArray{"border_share", Extent::pixels_or_none}, tile.border_share);
  visit(TileArray{"samples", Extent::pixels}, tile.samples);
  visit(TileArray{"label_rays", Extent::pixels}, tile.label_rays);
  visit(TileArray{"radiance_evaluations", Extent::pixels}, tile.radiance_evaluations);
  visit(TileArray{"worst_ratio", Extent::pixels}, tile.worst_ratio);
  visit(TileArray{"missable_fraction", Extent::pixels}, tile.missable_fraction);
  visit(TileArray{"reasons", Extent::pixels}, tile.reasons);
  visit(TileArray{"abundances"}, tile.abundances);
  visit(TileArray{"column_errors"}, tile.column_errors);
  visit(TileArray{"memory"}, tile.memory);
}

}  // namespace ifov::sampling
