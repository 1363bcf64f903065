#include "render/wings/cut_room.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sampling/random.h"
#include "sampling/tile.h"
#include "sampling/value_batch.h"

namespace ifov::render {

namespace {

constexpr std::uint64_t kPaths = 0x637574ull;  // purpose of random numbers

}  // namespace

CutRoom::CutRoom(const AccuracyTolerance& tolerance, std::vector<double> left_out,
                 const sampling::TileProblem& problem, sampling::Field& field)
    : tolerance_(tolerance), left_out_(std::move(left_out)) {
  const std::size_t columns = left_out_.size();
  darkest_.assign(columns, std::numeric_limits<double>::infinity());
  brightest_.assign(columns, -std::numeric_limits<double>::infinity());
  const sampling::PixelRect& tile = problem.tile;
  const int across = (tile.width() + kSide - 1) / kSide, down = (tile.height() + kSide - 1) / kSide;
  paths_ = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
  const auto key = [&](std::size_t k) {
    return sampling::hash(problem.seed, kPaths, tile.x0 + kSide * (static_cast<int>(k) % across),
                          tile.y0 + kSide * (static_cast<int>(k) / across));
  };
  sampling::for_each_value(
      field, problem.cancel, paths_,
      [&](std::size_t k) {
        const int x = tile.x0 + kSide * (static_cast<int>(k) % across),
                  y = tile.y0 + kSide * (static_cast<int>(k) / across);
        const sampling::FocalPoint point{
            x + std::min(kSide, tile.x1 - x) * sampling::unit_double(sampling::mix(key(k))),
            y + std::min(kSide, tile.y1 - y) * sampling::unit_double(sampling::mix(key(k) + 1))};
        return sampling::PathRequest{point, key(k), 0};
      },
      [&](std::size_t, sampling::Label, const float* values) {
        for (std::size_t c = 0; c < columns; ++c) {
          darkest_[c] = std::min<double>(darkest_[c], values[c]);
          brightest_[c] = std::max<double>(brightest_[c], values[c]);
        }
      });
}

void CutRoom::limits(std::span<const double> mean, std::span<double> limit) const {
  bounds_.assign(mean.size(), 0.0);
  for (std::size_t c = 0; c < std::min(mean.size(), left_out_.size()); ++c)
    bounds_[c] = left_out_[c] * std::max({brightest_[c] - mean[c], mean[c] - darkest_[c], 0.0});
  tolerance_.limits_beside(bounds_, mean, limit);
}

}  // namespace ifov::render
