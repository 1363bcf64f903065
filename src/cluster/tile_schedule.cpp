#include "cluster/tile_schedule.h"

#include <algorithm>
#include <cmath>

namespace ifov::cluster {
namespace {

constexpr int kSpacing = 4;            ///< of the tiles that come first
constexpr std::size_t kSorts = 32;     ///< the rest is put in order this often
constexpr int kReach[] = {1, 2, 4};    ///< around a tile, to guess its cost
constexpr double kGroup_s = 0.1;
constexpr std::size_t kLargestGroup = 512;

}  // namespace

TileSchedule::TileSchedule(const std::vector<int>& tiles, int columns, int threads)
    : columns_(columns), threads_(std::max(threads, 1)) {
  for (const int tile : tiles) {
    order_.push_back({tile, tile % columns, tile / columns, 0.0});
    rows_ = std::max(rows_, order_.back().y + 1);
  }
  const auto comes_first = [](const Place& place) {
    return place.x % kSpacing == kSpacing / 2 && place.y % kSpacing == kSpacing / 2;
  };
  first_ones_ = static_cast<std::size_t>(std::stable_partition(order_.begin(), order_.end(), comes_first) - order_.begin());
  took_s_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), -1.0f);
}

void TileSchedule::finished(const TileCost& cost) {
  const auto place = static_cast<std::size_t>(cost.tile);
  if (place >= took_s_.size() || took_s_[place] >= 0.0f) return;
  took_s_[place] = static_cast<float>(cost.seconds);
  sum_s_ += cost.seconds;
  ++known_;
}

double TileSchedule::guess_s(const Place& place) const {
  for (const int reach : kReach) {
    double sum = 0.0, weights = 0.0;
    for (int y = std::max(0, place.y - reach); y <= std::min(rows_ - 1, place.y + reach); ++y)
      for (int x = std::max(0, place.x - reach); x <= std::min(columns_ - 1, place.x + reach); ++x) {
        const float took_s = took_s_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                     static_cast<std::size_t>(x)];
        if (took_s < 0.0f) continue;
        const double weight = 1.0 / std::max(1, (x - place.x) * (x - place.x) + (y - place.y) * (y - place.y));
        sum += weight * static_cast<double>(took_s);
        weights += weight;
      }
    if (weights > 0.0) return sum / weights;
  }
  return sum_s_ / static_cast<double>(known_);
}

void TileSchedule::sort_rest() {
  if (known_ < sort_at_ || known_ == 0) return;
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(std::max(next_, first_ones_));
  for (auto place = begin; place != order_.end(); ++place) place->guess_s = guess_s(*place);
  std::stable_sort(begin, order_.end(), [](const Place& a, const Place& b) { return a.guess_s > b.guess_s; });
  sort_at_ = known_ + order_.size() / kSorts + 1;
}

std::vector<int> TileSchedule::take(int idle, int threads) {
  std::vector<int> group;
  const auto all = static_cast<std::size_t>(threads_);
  if (idle == 0 && left() <= 2 * all) return group;
  if (next_ >= first_ones_) sort_rest();
  const auto waiting = static_cast<std::size_t>(std::max(idle, 1));
  // A share of what is left, as in guided self-scheduling (Polychronopoulos and Kuck 1987).
  const std::size_t most = std::min(kLargestGroup, left() * static_cast<std::size_t>(std::max(threads, 1)) / (4 * all));
  const double mean_s = known_ > 0 ? sum_s_ / static_cast<double>(known_) : kGroup_s;
  double cost_s = 0.0;
  while (left() > 0 && (group.size() < waiting || (group.size() < most && cost_s < kGroup_s * threads))) {
    const Place& place = order_[next_++];
    group.push_back(place.tile);
    cost_s += place.guess_s > 0.0 ? place.guess_s : mean_s;
  }
  return group;
}

std::optional<int> TileSchedule::take_one() {
  if (left() == 0) return std::nullopt;
  if (next_ >= first_ones_) sort_rest();
  return order_[next_++].tile;
}

}  // namespace ifov::cluster
