#include "sampling/accuracy/weights/clutter_round.h"

#include <algorithm>

#include "sampling/field.h"
#include "sampling/hash.h"
#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

ClutterRound::ClutterRound(GridSides sides, std::size_t stride, bool keep)
    : sides_(sides), stride_(stride), keep_(keep), sums_(stride) {}

// kPerPair: a value in a cell with the share p beyond a border has the variance p (1 - p) of the step. Over straight borders
// anywhere, that sums up to an eighth for each pair of unlike neighbours. (Noise alone sums up to half its variance.)

void ClutterRound::request(int px, int py, std::uint64_t key, const Paths& paths, std::uint32_t block,
                           std::vector<PathRequest>& requests) const {
  const double width = 1.0 / sides_.columns, height = 1.0 / sides_.rows;
  const int across = sides_.columns / 2, column = static_cast<int>(block) % across,
            row = static_cast<int>(block) / across;
  for (std::uint32_t quarter = 0; quarter < kBlock; ++quarter) {
    const int i = 2 * column + static_cast<int>(quarter % 2), j = 2 * row + static_cast<int>(quarter / 2);
    const std::uint64_t jitter = hash(key, i, j);
    // All paths of the round are stratified among themselves. Those of a block are far apart in the sequence: paths made
    // unlike within a block would show as variance what they take away.
    requests.push_back(
        {{px + (i + unit_double(jitter)) * width, py + (j + unit_double(mix(jitter))) * height},
         paths.sequence,
         paths.first + quarter * blocks() + block});
  }
}

void ClutterRound::add_block(const float* values, std::span<const std::uint32_t, kBlock> materials,
                             std::span<const PathRequest, kBlock> requests) {
  const float* const rows[kBlock] = {values, values + stride_, values + 2 * stride_, values + 3 * stride_};
  sums_.add_block(rows);
  add_neighbours(blocks_in_++, rows);
  for (const std::uint32_t material : materials) {
    auto at = std::find_if(materials_.begin(), materials_.end(),
                           [&](const auto& m) { return m.first == material; });
    if (at == materials_.end()) at = materials_.insert(at, {material, 0});
    ++at->second;
  }
  if (!keep_) return;
  values_.insert(values_.end(), values, values + kBlock * stride_);
  for (const PathRequest& request : requests) points_.push_back({request.point.x_px, request.point.y_px});
}

/// Blocks come row after row: the values on their rims wait in above_.
void ClutterRound::add_neighbours(std::size_t block, const float* const (&rows)[kBlock]) {
  steps_.resize(stride_, 0.0);
  const auto columns = static_cast<std::size_t>(sides_.columns);
  above_.resize((columns + 2) * stride_);
  const std::size_t across = columns / 2, column = block % across;
  float *top = &above_[2 * column * stride_], *left = &above_[columns * stride_];
  const auto compare = [&](const float* a, const float* b) {
    for (std::size_t c = 0; c < stride_; ++c) {
      const double step = static_cast<double>(a[c]) - b[c];
      steps_[c] += step * step;
    }
  };
  for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {0, 2}, {1, 3}}) compare(rows[a], rows[b]);
  for (std::size_t k = 0; k < 2; ++k) {
    if (block >= across) compare(rows[k], top + k * stride_);
    if (column > 0) compare(rows[2 * k], left + k * stride_);
    std::copy_n(rows[2 + k], stride_, top + k * stride_);
    std::copy_n(rows[2 * k + 1], stride_, left + k * stride_);
  }
}

ClutterRound::Moment ClutterRound::moment(int column) const {
  const double n = static_cast<double>(count());
  const double steps = steps_.empty() ? 0.0 : kPerPair * steps_[static_cast<std::size_t>(column)] / (n * n);
  return {sums_.mean(column), std::max(kBlock * sums_.squares(column) / (n * n), steps),
          sums_.freedom(column)};
}

std::vector<double> ClutterRound::weigh(const PixelFootprint& footprint, Point2 centre) const {
  std::vector<double> weights;
  for (const Point2& at : points_) weights.push_back(footprint.density(at.x - centre.x, at.y - centre.y));
  return weights;
}

ClutterRound::Moment ClutterRound::moment(int column, std::span<const double> weights) const {
  double weight = 0.0, sum = 0.0, squares = 0.0, fourths = 0.0;
  for (std::size_t b = 0; b < weights.size(); b += kBlock) {
    double v[kBlock], weight_squares = 0.0;
    for (std::size_t q = 0; q < kBlock; ++q) {
      v[q] = values_[(b + q) * stride_ + column];
      weight += weights[b + q];
      weight_squares += weights[b + q] * weights[b + q];
      sum += weights[b + q] * v[q];
    }
    const double twist = (v[0] - v[1]) - (v[2] - v[3]), square = 0.25 * twist * twist * weight_squares;
    squares += square;
    fourths += square * square;
  }
  if (weight == 0.0) return moment(column);
  double steps = 0.0;
  const auto compare = [&](int i, int j, int k, int l) {
    const std::size_t p = place(i, j), q = place(k, l);
    const double step = static_cast<double>(values_[p * stride_ + column]) - values_[q * stride_ + column];
    steps += kPerPair * weights[p] * weights[q] * step * step;
  };
  for (int j = 0; j < sides_.rows; ++j)
    for (int i = 0; i < sides_.columns; ++i) {
      if (i + 1 < sides_.columns) compare(i, j, i + 1, j);
      if (j + 1 < sides_.rows) compare(i, j, i, j + 1);
    }
  const double blocks = static_cast<double>(weights.size()) / kBlock;
  const double freedom = fourths > 0.0 ? std::min(blocks, 3.0 * squares * squares / fourths) : blocks;
  return {sum / weight, std::max(squares, steps) / (weight * weight), freedom};
}

}  // namespace ifov::sampling
