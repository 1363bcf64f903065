#include "sampling/accuracy/clutter_round.h"

#include <algorithm>

namespace ifov::sampling {

ClutterRound::ClutterRound(int side, std::size_t stride, bool keep)
    : side_(side), stride_(stride), keep_(keep), sums_(stride) {}

void ClutterRound::request(int px, int py, std::uint64_t key, std::uint32_t block,
                           std::vector<PathRequest>& requests) const {
  const double cell = 1.0 / side_;
  const int across = side_ / 2, column = static_cast<int>(block) % across, row = static_cast<int>(block) / across;
  for (std::uint32_t quarter = 0; quarter < kBlock; ++quarter) {
    const int i = 2 * column + static_cast<int>(quarter % 2), j = 2 * row + static_cast<int>(quarter / 2);
    const std::uint64_t jitter = hash(key, i, j);
    // All paths of the round are stratified among themselves. Those of a block are far apart in the sequence: paths made
    // unlike within a block would show as variance what they take away.
    requests.push_back({{px + (i + unit_double(jitter)) * cell, py + (j + unit_double(mix(jitter))) * cell},
                        key,
                        quarter * blocks() + block});
  }
}

void ClutterRound::add_block(const float* values, std::span<const std::uint32_t, kBlock> materials,
                             std::span<const PathRequest, kBlock> requests) {
  const float* const rows[kBlock] = {values, values + stride_, values + 2 * stride_, values + 3 * stride_};
  sums_.add_block(rows);
  for (const std::uint32_t material : materials) {
    const auto at = std::find_if(materials_.begin(), materials_.end(), [&](const auto& m) { return m.first == material; });
    if (at == materials_.end())
      materials_.push_back({material, 1});
    else
      ++at->second;
  }
  if (!keep_) return;
  values_.insert(values_.end(), values, values + kBlock * stride_);
  for (const PathRequest& request : requests) points_.push_back({request.point.x_px, request.point.y_px});
}

ClutterRound::Moment ClutterRound::moment(int column) const {
  const double n = static_cast<double>(count());
  return {sums_.mean(column), kBlock * sums_.squares(column) / (n * n), sums_.freedom(column)};
}

void ClutterRound::weigh(const PixelFootprint& footprint, Point2 centre, std::vector<double>& weights) const {
  weights.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    weights[i] = footprint.density(points_[i].x - centre.x, points_[i].y - centre.y);
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
  const double blocks = static_cast<double>(weights.size()) / kBlock;
  const double freedom = fourths > 0.0 ? std::min(blocks, 3.0 * squares * squares / fourths) : blocks;
  return {sum / weight, squares / (weight * weight), freedom};
}

}  // namespace ifov::sampling
