#include <gtest/gtest.h>

#include <vector>

#include "sampling/accuracy/borders/edge_cells.h"

namespace ifov::sampling::test_edge_cells {
namespace {

std::vector<std::uint32_t> cells_of(EdgeCells& cells, std::uint32_t pixel) {
  std::vector<std::uint32_t> found;
  cells.filter(pixel, [&](std::uint32_t cell) {
    found.push_back(cell);
    return true;
  });
  return found;
}

TEST(EdgeCells, KeepTheirOrderPixelByPixel) {
  EdgeCells cells(3);
  EXPECT_FALSE(cells.crossed(0));
  cells.add(0, 7);
  cells.add(2, 8);
  cells.add(0, 5);
  EXPECT_TRUE(cells.crossed(0));
  EXPECT_FALSE(cells.crossed(1));
  EXPECT_EQ(cells_of(cells, 0), (std::vector<std::uint32_t>{7, 5}));
  EXPECT_EQ(cells_of(cells, 2), (std::vector<std::uint32_t>{8}));
}

// Whichever of them leave, what is added later stands behind those that are left.
TEST(EdgeCells, ThoseThatAreNotKeptLeave) {
  for (std::uint32_t leaves = 0; leaves < 3; ++leaves) {
    EdgeCells cells(1);
    for (std::uint32_t cell = 0; cell < 3; ++cell) cells.add(0, cell);
    cells.filter(0, [&](std::uint32_t cell) { return cell != leaves; });
    cells.add(0, 3);
    std::vector<std::uint32_t> left{0, 1, 2, 3};
    left.erase(left.begin() + leaves);
    EXPECT_EQ(cells_of(cells, 0), left) << leaves;
  }
  EdgeCells one(1);
  one.add(0, 4);
  one.filter(0, [](std::uint32_t) { return false; });
  EXPECT_FALSE(one.crossed(0));
  one.add(0, 6);
  EXPECT_EQ(cells_of(one, 0), (std::vector<std::uint32_t>{6}));
}

}  // namespace
}  // namespace ifov::sampling::test_edge_cells
