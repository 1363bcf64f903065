#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "cluster/tile_schedule.h"

namespace ifov::cluster::test_tile_schedule {
namespace {

constexpr int kColumns = 32, kRows = 24, kThreads = 6;

std::vector<int> all_tiles() {
  std::vector<int> tiles(kColumns * kRows);
  std::iota(tiles.begin(), tiles.end(), 0);
  return tiles;
}

/// Expensive in the lower right corner, which comes last row by row.
double cost_s(int tile) {
  const int x = tile % kColumns, y = tile / kColumns;
  return x > kColumns / 2 && y > 2 * kRows / 3 ? 1.0 : 0.02;
}

TEST(TileSchedule, HandsOutEachTileOnce) {
  TileSchedule schedule(all_tiles(), kColumns, kThreads);
  std::vector<int> handed_out;
  for (int ask = 0; schedule.left() > 1; ++ask) {
    const int idle = ask % 3;
    if (ask % 7 == 0) handed_out.push_back(*schedule.take_one());
    for (const int tile : schedule.take(idle, 2)) {
      handed_out.push_back(tile);
      if (ask % 5 != 0) schedule.finished({tile, cost_s(tile)});
    }
  }
  while (const std::optional<int> tile = schedule.take_one()) handed_out.push_back(*tile);
  std::sort(handed_out.begin(), handed_out.end());
  EXPECT_EQ(handed_out, all_tiles());
  EXPECT_TRUE(schedule.take(4, 4).empty());
  EXPECT_FALSE(schedule.take_one());
}

TEST(TileSchedule, SpreadsTheFirstTilesAndThenTakesTheDearest) {
  TileSchedule schedule(all_tiles(), kColumns, kThreads);
  std::vector<int> order;
  while (schedule.left() > 0)
    for (const int tile : schedule.take(1, 1)) {
      order.push_back(tile);
      schedule.finished({tile, cost_s(tile)});
    }
  const auto is_expensive = [](int tile) { return cost_s(tile) > 0.5; };
  const auto expensive = std::count_if(order.begin(), order.end(), is_expensive);
  const std::size_t first = kColumns / 4 * kRows / 4;
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(first) + expensive + expensive / 4;
  EXPECT_GT(std::count_if(order.begin(), end, is_expensive), 95 * expensive / 100);
  // What row by row would do, which is what must not be.
  const std::vector<int> rows = all_tiles();
  EXPECT_EQ(std::count_if(rows.begin(), rows.begin() + (end - order.begin()), is_expensive), 0);
}

TEST(TileSchedule, GroupsOfCheapTilesShrinkTowardsTheEnd) {
  TileSchedule schedule(all_tiles(), kColumns, kThreads);
  std::size_t largest = 0, last = 0;
  while (schedule.left() > 0) {
    const std::vector<int> group = schedule.take(1, 1);
    for (const int tile : group) schedule.finished({tile, 1e-4});
    largest = std::max(largest, group.size());
    last = group.size();
  }
  EXPECT_GT(largest, 20u);
  EXPECT_LE(largest, all_tiles().size() / (4 * kThreads));
  EXPECT_EQ(last, 1u);
}

TEST(TileSchedule, KeepsTheLastTilesForThreadsThatWait) {
  const std::vector<int> few{3, 5, 7, 9};
  TileSchedule schedule(few, kColumns, kThreads);
  EXPECT_TRUE(schedule.take(0, 2).empty());
  EXPECT_EQ(schedule.take(3, 4), (std::vector<int>{3, 5, 7}));
  EXPECT_EQ(schedule.take(2, 2), std::vector<int>{9});
}

TEST(TileSchedule, IgnoresWhatIsNotOfItsTiles) {
  TileSchedule schedule({0, 1}, 2, 1);
  schedule.finished({-1, 1.0});
  schedule.finished({99, 1.0});
  EXPECT_EQ(schedule.take(2, 2).size(), 2u);
}

}  // namespace
}  // namespace ifov::cluster::test_tile_schedule
