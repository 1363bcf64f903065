#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "materials/map_grid.h"

namespace ifov::materials {

/// A map whose cells have numbers, and which finds at once where these are lowest and highest in a part of it.
class NumberedMap {
 public:
  virtual ~NumberedMap() = default;

  const MapGrid& grid() const { return grid_; }
  /// What tells a cell from others: any number that grows with what the cell says.
  virtual float number(std::size_t cell) const = 0;

  /// A cell of the map as it goes on beyond its edges, counted from its north-west corner to the east and to the south.
  struct Place {
    double column = 0.0, row = 0.0;
    float number = 0.0f;
  };
  struct Extremes {
    bool any = false;
    Place lowest, highest;
  };
  using Inside = std::function<bool(double column, double row)>;
  /// The lowest and the highest among cells whose middles are `inside`, all of which lie in columns [west, east) and rows
  /// [north, south). Of a map that repeats more than eight times across or down there, those of the eight copies in the middle.
  Extremes extremes(double west, double north, double east, double south, const Inside& inside) const;

 protected:
  explicit NumberedMap(MapGrid grid) : grid_(grid) {}
  NumberedMap(const NumberedMap&) = default;
  NumberedMap(NumberedMap&&) = default;
  NumberedMap& operator=(const NumberedMap&) = default;
  NumberedMap& operator=(NumberedMap&&) = default;
  /// Has to be called when there are all numbers.
  void find_blocks();

  MapGrid grid_;

 private:
  struct Search;
  void search(Search& search, int column, int row) const;

  /// Cells of a square of the map.
  struct Block {
    float lowest = 0.0f, highest = 0.0f;
  };
  int blocks_across_ = 0;
  std::vector<Block> blocks_;  // row by row
};

}  // namespace ifov::materials
