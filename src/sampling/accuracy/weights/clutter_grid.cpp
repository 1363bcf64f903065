#include "sampling/accuracy/weights/clutter_grid.h"

#include <algorithm>
#include <numeric>

#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

namespace {

constexpr std::size_t kLanes = 8;

/// Sum of f(k) for k below n, in lanes that vectors hold.
template <class Term>
double sum_of(std::size_t n, const Term& term) {
  double lanes[kLanes] = {};
  std::size_t k = 0;
  for (; k + kLanes <= n; k += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) lanes[l] += term(k + l);
  for (std::size_t l = 0; k < n; ++k, ++l) lanes[l] += term(k);
  return std::accumulate(lanes, lanes + kLanes, 0.0);
}

}  // namespace

ClutterGrid::ClutterGrid(const ClutterRound& round, std::span<const int> columns)
    : across_(static_cast<std::size_t>(round.sides().columns)),
      x_(round.count()),
      y_(round.count()),
      weight_(round.count()),
      block_squares_(round.blocks()) {
  const int across = round.sides().columns, rows = round.sides().rows;
  const auto at = [across](int i, int j) { return static_cast<std::size_t>(j) * across + i; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < across; ++i) {
      const Point2 point = round.points_[round.place(i, j)];
      x_[at(i, j)] = point.x, y_[at(i, j)] = point.y;
    }
  for (const int column : columns) {
    Column& c = columns_.emplace_back();
    c.value.resize(round.count());
    c.across.resize(round.count());
    c.down.resize(round.count() - across_);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < across; ++i)
        c.value[at(i, j)] =
            round.values_[round.place(i, j) * round.stride_ + static_cast<std::size_t>(column)];
    const auto between = [&](std::size_t p, std::size_t q) {
      const double step = c.value[p] - c.value[q];
      return ClutterRound::kPerPair * step * step;
    };
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < across; ++i) {
        if (i + 1 < across) c.across[at(i, j)] = between(at(i, j), at(i + 1, j));
        if (j + 1 < rows) c.down[at(i, j)] = between(at(i, j), at(i, j + 1));
      }
    for (int j = 0; j < rows; j += 2)
      for (int i = 0; i < across; i += 2) {
        const double twist =
            (c.value[at(i, j)] - c.value[at(i + 1, j)]) - (c.value[at(i, j + 1)] - c.value[at(i + 1, j + 1)]);
        c.twist.push_back(0.25 * twist * twist);
      }
  }
}

bool ClutterGrid::weigh(const PixelFootprint& footprint, Point2 centre) {
  footprint.densities(x_, y_, centre, weight_);
  total_ = sum_of(weight_.size(), [this](std::size_t k) { return weight_[k]; });
  if (total_ == 0.0) return false;
  double* to = block_squares_.data();
  for (std::size_t j = 0; j * across_ < weight_.size(); j += 2) {
    const double *row = &weight_[j * across_], *below = row + across_;
    for (std::size_t i = 0; i < across_; i += 2)
      *to++ = row[i] * row[i] + row[i + 1] * row[i + 1] + below[i] * below[i] + below[i + 1] * below[i + 1];
  }
  return true;
}

ClutterRound::Moment ClutterGrid::moment(std::size_t position) const {
  const Column& c = columns_[position];
  const double* w = weight_.data();
  const double sum = sum_of(weight_.size(), [&](std::size_t k) { return w[k] * c.value[k]; });
  const double steps =
      sum_of(weight_.size() - 1, [&](std::size_t k) { return w[k] * w[k + 1] * c.across[k]; }) +
      sum_of(c.down.size(), [&](std::size_t k) { return w[k] * w[k + across_] * c.down[k]; });
  const double* of_block = block_squares_.data();
  const double squares = sum_of(c.twist.size(), [&](std::size_t b) { return c.twist[b] * of_block[b]; });
  const double fourths = sum_of(c.twist.size(), [&](std::size_t b) {
    const double square = c.twist[b] * of_block[b];
    return square * square;
  });
  const double blocks = static_cast<double>(c.twist.size());
  const double freedom = fourths > 0.0 ? std::min(blocks, 3.0 * squares * squares / fourths) : blocks;
  return {sum / total_, std::max(squares, steps) / (total_ * total_), freedom};
}

}  // namespace ifov::sampling
