#include "render/wings/cut_room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sampling/random.h"
#include "sampling/tile.h"
#include "sampling/value_batch.h"

namespace ifov::render {

namespace {

constexpr std::uint64_t kPaths = 0x637574ull;  // purpose of random numbers
constexpr int kSide_px = 4;                    // of a square that one path stands for

/// The first pixel of the square that holds one.
int square_of(double x_px) { return kSide_px * static_cast<int>(std::floor(x_px / kSide_px)); }

}  // namespace

CutRange cut_range(const sampling::TileProblem& problem, double reach_px, sampling::Field& field) {
  const auto columns = static_cast<std::size_t>(field.columns());
  const sampling::PixelRect& tile = problem.tile;
  const int x0 = square_of(tile.x0 - reach_px), y0 = square_of(tile.y0 - reach_px);
  const auto across = static_cast<std::size_t>((square_of(tile.x1 - 1 + reach_px) - x0) / kSide_px + 1),
             down = static_cast<std::size_t>((square_of(tile.y1 - 1 + reach_px) - y0) / kSide_px + 1);
  CutRange range{std::vector<double>(columns, std::numeric_limits<double>::infinity()),
                 std::vector<double>(columns, -std::numeric_limits<double>::infinity()), across * down};
  sampling::for_each_value(
      field, problem.cancel, range.paths,
      [&](std::size_t k) {
        const int x = x0 + kSide_px * static_cast<int>(k % across),
                  y = y0 + kSide_px * static_cast<int>(k / across);
        const std::uint64_t key = sampling::hash(problem.seed, kPaths, x, y);
        const sampling::FocalPoint point{x + kSide_px * sampling::unit_double(sampling::mix(key)),
                                         y + kSide_px * sampling::unit_double(sampling::mix(key) + 1)};
        return sampling::PathRequest{point, key, 0};
      },
      [&](std::size_t, sampling::Label, const float* values) {
        for (std::size_t c = 0; c < columns; ++c) {
          range.darkest[c] = std::min<double>(range.darkest[c], values[c]);
          range.brightest[c] = std::max<double>(range.brightest[c], values[c]);
        }
      });
  return range;
}

CutRoom::CutRoom(const AccuracyTolerance& tolerance, std::vector<double> left_out, const CutRange& range)
    : tolerance_(tolerance), left_out_(std::move(left_out)), range_(range) {}

void CutRoom::limits(std::span<const double> mean, std::span<double> limit) const {
  bounds_.assign(mean.size(), 0.0);
  for (std::size_t c = 0; c < std::min(mean.size(), left_out_.size()); ++c)
    bounds_[c] = left_out_[c] * std::max({range_.brightest[c] - mean[c], mean[c] - range_.darkest[c], 0.0});
  tolerance_.limits_beside(bounds_, mean, limit);
}

}  // namespace ifov::render
