#pragma once

#include <vector>

#include "materials/map_grid.h"

namespace ifov::materials {

/// Where a surface is there and where it has holes: a place is as the cell that holds it.
class OpacityMap {
 public:
  /// `open` row by row from the north-west corner: whether the cell is a hole. Throws InputError unless there are width x height of
  /// them and the cells have a size.
  OpacityMap(MapGrid grid, std::vector<bool> open);
  bool is_open(const MapPosition& position) const { return open_[grid_.cell_at(position)]; }
  const MapGrid& grid() const { return grid_; }
  double open_share() const;  ///< of the cells

 private:
  MapGrid grid_;
  std::vector<bool> open_;
};

}  // namespace ifov::materials
