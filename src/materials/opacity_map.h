#pragma once

#include <vector>

#include "materials/numbered_map.h"

namespace ifov::materials {

/// Where a surface is there and where it has holes: a place is as the cell that holds it.
class OpacityMap final : public NumberedMap {
 public:
  /// `open` row by row from the north-west corner: whether the cell is a hole. Throws InputError unless there are width x height of
  /// them and the cells have a size.
  OpacityMap(MapGrid grid, std::vector<bool> open);
  bool is_open(const MapPosition& position) const { return open_[grid_.cell_at(position)]; }
  float number(std::size_t cell) const override { return open_[cell] ? 0.0f : 1.0f; }
  double open_share() const;  ///< of the cells

 private:
  std::vector<bool> open_;
};

}  // namespace ifov::materials
