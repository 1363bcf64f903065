#include "cluster/tile_schedule.h"

#include <algorithm>
#include <cstdint>

namespace ifov::cluster {
namespace {

constexpr int kSpacing = 4;           ///< of the scouts
constexpr std::size_t kSorts = 32;    ///< the rest is put in order this often
constexpr int kReach = kSpacing / 2;  ///< around a tile there is a scout within this
constexpr double kGroup_s = 0.1;
constexpr std::size_t kLargestGroup = 512, kLargestGroupOfScouts = 1;
constexpr float kUnknown = -1.0f, kAwaited_s = 1e9f;

bool is_scout(int x, int y) { return x % kSpacing == kSpacing / 2 && y % kSpacing == kSpacing / 2; }

}  // namespace

TileSchedule::TileSchedule(const std::vector<int>& tiles, int columns, int threads)
    : columns_(columns), threads_(static_cast<std::size_t>(std::max(threads, 1))) {
  for (const int tile : tiles) {
    order_.push_back({tile, tile % columns, tile / columns, 0.0f});
    rows_ = std::max(rows_, order_.back().y + 1);
  }
  scouts_ = static_cast<std::size_t>(
      std::stable_partition(order_.begin(), order_.end(), [](const Entry& p) { return is_scout(p.x, p.y); }) -
      order_.begin());
  // Neighbours are alike, and are not to end up in one hand.
  const auto spread = [](const Entry& p) { return static_cast<std::uint32_t>(p.tile) * 2654435769u; };
  std::sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(scouts_),
            [&](const Entry& a, const Entry& b) { return spread(a) < spread(b); });
  cells_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), {});
  for (std::size_t k = 0; k < scouts_; ++k)
    cells_[static_cast<std::size_t>(order_[k].tile)].is_awaited = true;
}

void TileSchedule::finished(const TileCost& cost) {
  const auto entry = static_cast<std::size_t>(cost.tile);
  if (entry >= cells_.size() || cells_[entry].took_s >= 0.0f) return;
  cells_[entry] = {static_cast<float>(cost.seconds), false};
  longest_s_ = std::max(longest_s_, cells_[entry].took_s);
  ++known_;
}

float TileSchedule::guess_s(const Entry& entry) const {
  float most = kUnknown;
  for (int y = std::max(0, entry.y - kReach); y <= std::min(rows_ - 1, entry.y + kReach); ++y)
    for (int x = std::max(0, entry.x - kReach); x <= std::min(columns_ - 1, entry.x + kReach); ++x) {
      const Cell& cell = cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                static_cast<std::size_t>(x)];
      if (cell.is_awaited) return kAwaited_s;
      most = std::max(most, cell.took_s);
    }
  return most >= 0.0f ? most : longest_s_;
}

void TileSchedule::sort_rest() {
  if (next_ < scouts_ || known_ < sort_at_ || known_ == 0) return;
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(next_);
  for (auto entry = begin; entry != order_.end(); ++entry) entry->guess_s = guess_s(*entry);
  std::stable_sort(begin, order_.end(), [](const Entry& a, const Entry& b) { return a.guess_s > b.guess_s; });
  sort_at_ = known_ + order_.size() / kSorts + 1;
}

std::vector<int> TileSchedule::take(int idle, int threads) {
  std::vector<int> group;
  if (left() == 0) return group;
  sort_rest();
  const auto expected_s = [&](std::size_t k) {
    if (k >= scouts_) return static_cast<double>(order_[k].guess_s);
    return known_ > 0 ? static_cast<double>(longest_s_) : kGroup_s;
  };
  const double enough_s = kGroup_s * std::max(threads, 1);
  if (idle == 0 && (left() <= 2 * threads_ || expected_s(next_) >= kGroup_s)) return group;
  const auto waiting = static_cast<std::size_t>(std::max(idle, 1));
  // A share of what is left, as in guided self-scheduling (Polychronopoulos and Kuck 1987).
  const std::size_t share = left() * static_cast<std::size_t>(std::max(threads, 1)) / (4 * threads_);
  const std::size_t most = std::min(next_ < scouts_ ? kLargestGroupOfScouts : kLargestGroup, share);
  double sum_s = 0.0;
  while (left() > 0 &&
         (group.size() < waiting || (group.size() < most && sum_s + expected_s(next_) <= enough_s))) {
    sum_s += expected_s(next_);
    group.push_back(order_[next_++].tile);
  }
  return group;
}

std::optional<int> TileSchedule::take_one() {
  if (left() == 0) return std::nullopt;
  sort_rest();
  return order_[next_++].tile;
}

}  // namespace ifov::cluster
