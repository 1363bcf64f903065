#include "materials/numbered_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace ifov::materials {

namespace {

constexpr int kSide = 16;            // cells of a block
constexpr double kMostCopies = 8.0;  // of a map that repeats, to the east and to the south

int blocks_of(int cells) { return (cells + kSide - 1) / kSide; }

bool reversed(double copy, Tiling tiling) {
  return tiling == Tiling::mirror && std::fmod(std::abs(copy), 2.0) == 1.0;
}

}  // namespace

/// Of one copy of the map, whose columns and rows run the other way where it is reversed.
struct NumberedMap::Search {
  const Inside& inside;
  Extremes& found;
  double first_column = 0.0, first_row = 0.0;  // of the copy, in the plane
  bool east_to_west = false, south_to_north = false;
  int west = 0, north = 0, east = 0, south = 0;  // cells of the map that are searched
};

void NumberedMap::find_blocks() {
  blocks_across_ = blocks_of(grid_.width);
  blocks_.assign(static_cast<std::size_t>(blocks_across_) * static_cast<std::size_t>(blocks_of(grid_.height)),
                 {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()});
  std::size_t cell = 0;
  for (int row = 0; row < grid_.height; ++row) {
    Block* const blocks =
        &blocks_[static_cast<std::size_t>(row / kSide) * static_cast<std::size_t>(blocks_across_)];
    for (int column = 0; column < grid_.width; ++column, ++cell) {
      const float value = number(cell);
      Block& block = blocks[column / kSide];
      block.lowest = std::min(block.lowest, value);
      block.highest = std::max(block.highest, value);
    }
  }
}

/// Looks into a block where it may hold a number beyond those found.
void NumberedMap::search(Search& search, int block_column, int block_row) const {
  const Block& block =
      blocks_[static_cast<std::size_t>(block_row) * static_cast<std::size_t>(blocks_across_) +
              static_cast<std::size_t>(block_column)];
  Extremes& found = search.found;
  const auto beyond = [&found](float lowest, float highest) {
    return !found.any || lowest < found.lowest.number || highest > found.highest.number;
  };
  const int west = std::max(search.west, block_column * kSide),
            east = std::min(search.east, (block_column + 1) * kSide),
            north = std::max(search.north, block_row * kSide),
            south = std::min(search.south, (block_row + 1) * kSide);
  for (int row = north; row < south; ++row)
    for (int column = west; column < east; ++column) {
      if (!beyond(block.lowest, block.highest)) return;
      const float value = number(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.width) +
                                 static_cast<std::size_t>(column));
      if (!beyond(value, value)) continue;
      const Place place{search.first_column + (search.east_to_west ? grid_.width - 1 - column : column) + 0.5,
                        search.first_row + (search.south_to_north ? grid_.height - 1 - row : row) + 0.5,
                        value};
      if (!search.inside(place.column, place.row)) continue;
      if (!found.any || value < found.lowest.number) found.lowest = place;
      if (!found.any || value > found.highest.number) found.highest = place;
      found.any = true;
    }
}

NumberedMap::Extremes NumberedMap::extremes(double west, double north, double east, double south,
                                            const Inside& inside) const {
  Extremes found;
  const Tiling across = grid_.tiling, down = grid_.tiling_down.value_or(grid_.tiling);
  const double width = grid_.width, height = grid_.height;
  // Beyond an edge that goes on there is what the cells at the edge are.
  const auto copies = [](double low, double high, double size, Tiling tiling) {
    if (tiling == Tiling::edge) return std::pair{0.0, 1.0};
    const double first = std::floor(low / size), last = std::ceil(high / size);
    if (last - first <= kMostCopies) return std::pair{first, last};
    const double middle = std::floor(0.5 * (first + last));
    return std::pair{middle - 0.5 * kMostCopies, middle + 0.5 * kMostCopies};
  };
  const auto [copy_west, copy_east] = copies(west, east, width, across);
  const auto [copy_north, copy_south] = copies(north, south, height, down);
  for (double copy_row = copy_north; copy_row < copy_south; copy_row += 1.0)
    for (double copy_column = copy_west; copy_column < copy_east; copy_column += 1.0) {
      Search one{inside, found};
      one.first_column = copy_column * width, one.first_row = copy_row * height;
      one.east_to_west = reversed(copy_column, across), one.south_to_north = reversed(copy_row, down);
      const auto cells = [](double low, double high, double first, int size, bool turned) {
        const double a = std::clamp(std::floor(low - first), 0.0, static_cast<double>(size)),
                     b = std::clamp(std::ceil(high - first), 0.0, static_cast<double>(size));
        const int from = static_cast<int>(a), to = static_cast<int>(b);
        return turned ? std::pair{size - to, size - from} : std::pair{from, to};
      };
      std::tie(one.west, one.east) = cells(west, east, one.first_column, grid_.width, one.east_to_west);
      std::tie(one.north, one.south) = cells(north, south, one.first_row, grid_.height, one.south_to_north);
      if (one.west >= one.east || one.north >= one.south) continue;
      for (int row = one.north / kSide; row <= (one.south - 1) / kSide; ++row)
        for (int column = one.west / kSide; column <= (one.east - 1) / kSide; ++column)
          search(one, column, row);
    }
  return found;
}

}  // namespace ifov::materials
