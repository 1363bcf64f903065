#include "sampling/accuracy/clutter_round.h"

#include <algorithm>

namespace ifov::sampling {

ClutterRound::ClutterRound(int side, std::size_t stride, bool keep)
    : side_(side), stride_(stride), keep_(keep), sums_(stride) {}

void ClutterRound::request(int px, int py, std::uint64_t key, const Paths& paths, std::uint32_t block,
                           std::vector<PathRequest>& requests) const {
  const double cell = 1.0 / side_;
  const int across = side_ / 2, column = static_cast<int>(block) % across, row = static_cast<int>(block) / across;
  for (std::uint32_t quarter = 0; quarter < kBlock; ++quarter) {
    const int i = 2 * column + static_cast<int>(quarter % 2), j = 2 * row + static_cast<int>(quarter / 2);
    const std::uint64_t jitter = hash(key, i, j);
    // All paths of the round are stratified among themselves. Those of a block are far apart in the sequence: paths made
    // unlike within a block would show as variance what they take away.
    requests.push_back({{px + (i + unit_double(jitter)) * cell, py + (j + unit_double(mix(jitter))) * cell},
                        paths.sequence,
                        paths.first + quarter * blocks() + block});
  }
}

void ClutterRound::add_block(const float* values, std::span<const std::uint32_t, kBlock> materials,
                             std::span<const PathRequest, kBlock> requests) {
  const float* const rows[kBlock] = {values, values + stride_, values + 2 * stride_, values + 3 * stride_};
  sums_.add_block(rows);
  for (std::size_t q = 0; q < kBlock; ++q) {
    auto at = std::find_if(materials_.begin(), materials_.end(), [&](const auto& m) { return m.first == materials[q]; });
    if (at == materials_.end()) {
      at = materials_.insert(at, {materials[q], 0});
      of_material_.resize(materials_.size() * stride_, 0.0);
    }
    ++at->second;
    cells_.push_back(static_cast<std::uint32_t>(at - materials_.begin()));
    double* sum = &of_material_[cells_.back() * stride_];
    for (std::size_t c = 0; c < stride_; ++c) sum[c] += rows[q][c];
  }
  if (cells_.size() == count()) find_borders({}, borders_);
  if (!keep_) return;
  values_.insert(values_.end(), values, values + kBlock * stride_);
  for (const PathRequest& request : requests) points_.push_back({request.point.x_px, request.point.y_px});
}

ClutterRound::Moment ClutterRound::moment(int column) const {
  const double n = static_cast<double>(count());
  return {sums_.mean(column), std::max(kBlock * sums_.squares(column) / (n * n), border_variance(column, borders_)),
          sums_.freedom(column)};
}

void ClutterRound::find_borders(std::span<const double> weights, std::vector<Border>& borders) const {
  borders.clear();
  if (materials_.size() < 2) return;
  double all = weights.empty() ? static_cast<double>(count()) : 0.0;
  for (const double w : weights) all += w;
  if (all == 0.0) return;
  const auto place = [this](int i, int j) {
    return static_cast<std::size_t>(((j / 2) * (side_ / 2) + i / 2) * static_cast<int>(kBlock) + j % 2 * 2 + i % 2);
  };
  const auto look = [&](std::size_t p, std::size_t q) {
    if (cells_[p] == cells_[q]) return;
    const auto [a, b] = std::minmax(cells_[p], cells_[q]);
    const double weight = (weights.empty() ? 1.0 : weights[p] * weights[q]) / (all * all);
    const auto at = std::find_if(borders.begin(), borders.end(), [&](const Border& e) { return e.a == a && e.b == b; });
    if (at == borders.end())
      borders.push_back({a, b, weight});
    else
      at->weight += weight;
  };
  for (int j = 0; j < side_; ++j)
    for (int i = 0; i < side_; ++i) {
      if (i + 1 < side_) look(place(i, j), place(i + 1, j));
      if (j + 1 < side_) look(place(i, j), place(i, j + 1));
    }
}

double ClutterRound::border_variance(int column, std::span<const Border> borders) const {
  // A value in a cell with the share p beyond a border has the variance p (1 - p) of the step. Over straight borders
  // anywhere, that sums up to an eighth for each pair of unlike neighbours.
  constexpr double kPerPair = 1.0 / 8.0;
  double variance = 0.0;
  for (const Border& border : borders) {
    const double step = of_material_[border.a * stride_ + column] / materials_[border.a].second -
                        of_material_[border.b * stride_ + column] / materials_[border.b].second;
    variance += kPerPair * border.weight * step * step;
  }
  return variance;
}

void ClutterRound::weigh(const PixelFootprint& footprint, Point2 centre, Weights& weights) const {
  weights.values.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    weights.values[i] = footprint.density(points_[i].x - centre.x, points_[i].y - centre.y);
  find_borders(weights.values, weights.borders);
}

ClutterRound::Moment ClutterRound::moment(int column, const Weights& weighing) const {
  const std::span<const double> weights = weighing.values;
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
  return {sum / weight, std::max(squares / (weight * weight), border_variance(column, weighing.borders)), freedom};
}

}  // namespace ifov::sampling
