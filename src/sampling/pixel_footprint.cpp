#include "sampling/pixel_footprint.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ifov::sampling {

PixelFootprint PixelFootprint::box(double side_px) {
  if (!(side_px > 0.0) || !std::isfinite(side_px))
    throw std::invalid_argument("a footprint's side must be positive");
  PixelFootprint footprint;
  footprint.half_width_ = 0.5 * side_px;
  return footprint;
}

PixelFootprint PixelFootprint::tabulated(double half_width_px, int cells_per_side,
                                         std::vector<double> values) {
  if (!(half_width_px > 0.0) || !std::isfinite(half_width_px) || cells_per_side < 1)
    throw std::invalid_argument("a footprint needs a positive half width and at least one cell");
  const std::size_t n = static_cast<std::size_t>(cells_per_side);
  if (values.size() != n * n) throw std::invalid_argument("a footprint needs cells_per_side^2 values");
  double sum = 0.0;
  for (double v : values) {
    if (!(v >= 0.0) || !std::isfinite(v))
      throw std::invalid_argument("a footprint's values must be finite and not negative");
    sum += v;
  }
  if (sum == 0.0) throw std::invalid_argument("a footprint's values must not all be zero");

  PixelFootprint footprint;
  footprint.half_width_ = half_width_px;
  footprint.cells_ = cells_per_side;
  const double cell_side = 2.0 * half_width_px / cells_per_side;
  for (double& v : values) v /= sum * cell_side * cell_side;
  footprint.density_ = std::move(values);
  footprint.summed_.assign((n + 1) * (n + 1), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    double row = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      row += footprint.density_[j * n + i] * cell_side * cell_side;
      footprint.summed_[(j + 1) * (n + 1) + i + 1] = footprint.summed_[j * (n + 1) + i + 1] + row;
    }
  }
  return footprint;
}

PixelFootprint PixelFootprint::striped(double side_px, std::vector<Piece> pieces) {
  if (!(side_px > 0.0) || !std::isfinite(side_px) || pieces.empty())
    throw std::invalid_argument("a striped footprint needs a positive side and a piece at least");
  PixelFootprint footprint;
  footprint.half_width_x_ = 0.5 * side_px;
  footprint.half_width_ = footprint.half_width_x_;
  double sum = 0.0, before = -INFINITY;
  for (const Piece& piece : pieces) {
    if (!(piece.y1 > piece.y0) || !(piece.y0 >= before) || !(piece.from >= 0.0) || !(piece.to >= 0.0) ||
        !std::isfinite(piece.y0) || !std::isfinite(piece.y1) || !std::isfinite(piece.from + piece.to))
      throw std::invalid_argument("a striped footprint's pieces must be finite, in order and not negative");
    sum += 0.5 * (piece.from + piece.to) * (piece.y1 - piece.y0);
    before = piece.y1;
    footprint.half_width_ = std::max({footprint.half_width_, std::abs(piece.y0), std::abs(piece.y1)});
  }
  if (sum == 0.0) throw std::invalid_argument("a footprint's values must not all be zero");
  for (Piece& piece : pieces) piece.from /= sum, piece.to /= sum;
  footprint.pieces_ = std::move(pieces);
  return footprint;
}

double PixelFootprint::striped_below(double y_px) const {
  double sum = 0.0;
  for (const Piece& piece : pieces_) {
    if (!(y_px > piece.y0)) break;
    const double end = std::min(y_px, piece.y1);
    sum += 0.5 * (piece.from + piece.at(end)) * (end - piece.y0);
  }
  return sum;
}

double PixelFootprint::density(double dx_px, double dy_px) const {
  if (std::abs(dx_px) > half_width_ || std::abs(dy_px) > half_width_) return 0.0;
  if (!pieces_.empty()) {
    if (std::abs(dx_px) > half_width_x_) return 0.0;
    for (const Piece& piece : pieces_)
      if (dy_px >= piece.y0 && dy_px <= piece.y1) return 0.5 * piece.at(dy_px) / half_width_x_;
    return 0.0;
  }
  if (uniform()) return 0.25 / (half_width_ * half_width_);
  const double cells_per_px = cells_ / (2.0 * half_width_);
  // Beyond the outermost centres the outermost values hold, which keeps the integral at 1.
  const auto locate = [&](double d, int& low, double& share) {
    const double at = std::clamp((d + half_width_) * cells_per_px - 0.5, 0.0, cells_ - 1.0);
    low = std::min(static_cast<int>(at), std::max(0, cells_ - 2));
    share = at - low;
  };
  int i = 0, j = 0;
  double s = 0.0, t = 0.0;
  locate(dx_px, i, s);
  locate(dy_px, j, t);
  const int i1 = std::min(i + 1, cells_ - 1), j1 = std::min(j + 1, cells_ - 1);
  const auto at = [&](int column, int row) {
    return density_[static_cast<std::size_t>(row * cells_ + column)];
  };
  return (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i1, j)) + t * ((1.0 - s) * at(i, j1) + s * at(i1, j1));
}

double PixelFootprint::integral(double x0_px, double y0_px, double x1_px, double y1_px) const {
  const auto inside = [&](double d) { return std::clamp(d, -half_width_, half_width_); };
  const double x0 = inside(x0_px), x1 = inside(x1_px), y0 = inside(y0_px), y1 = inside(y1_px);
  if (x1 <= x0 || y1 <= y0) return 0.0;
  if (!pieces_.empty()) {
    const double across = std::min(x1, half_width_x_) - std::max(x0, -half_width_x_);
    return across > 0.0 ? 0.5 * across / half_width_x_ * (striped_below(y1) - striped_below(y0)) : 0.0;
  }
  if (uniform()) return (x1 - x0) * (y1 - y0) * 0.25 / (half_width_ * half_width_);
  // Of the bilinear density: up to a place, all cells before the last centre count whole, that one and the next in part.
  const double cells_per_px = cells_ / (2.0 * half_width_);
  struct Share {
    int cell;
    double own, next;
  };
  const auto share_of = [&](double d) -> Share {
    const double u = (d + half_width_) * cells_per_px;
    const int cell = std::clamp(static_cast<int>(std::floor(u - 0.5)), 0, cells_ - 1);
    const double past = u - 0.5 - cell;  // the centre
    if (past < 0.0 || cell == cells_ - 1) return {cell, u - cell, 0.0};
    return {cell, 0.5 + past - 0.5 * past * past, 0.5 * past * past};
  };
  const auto summed = [&](double x, double y) {
    const Share across = share_of(x), down = share_of(y);
    const auto row = [&](int j) {
      const double* sums = &summed_[static_cast<std::size_t>(j * (cells_ + 1) + across.cell)];
      double sum = sums[0] + across.own * (sums[1] - sums[0]);
      if (across.next > 0.0) sum += across.next * (sums[2] - sums[1]);
      return sum;
    };
    const double above = row(down.cell), own = row(down.cell + 1);
    double sum = above + down.own * (own - above);
    if (down.next > 0.0) sum += down.next * (row(down.cell + 2) - own);
    return sum;
  };
  return summed(x1, y1) - summed(x0, y1) - summed(x1, y0) + summed(x0, y0);
}

FootprintGroups::FootprintGroups(std::vector<FootprintGroup> groups, std::vector<int> group_of_channel)
    : groups_(std::move(groups)), of_channel_(std::move(group_of_channel)) {
  if (groups_.empty()) throw std::invalid_argument("no footprint");
  for (const int group : of_channel_)
    if (group < 0 || group >= static_cast<int>(groups_.size()))
      throw std::invalid_argument("a channel of a group of footprints that there is not");
  double finest = 1.0 / 16.0;
  for (const FootprintGroup& group : groups_) {
    const double half = group.footprint.half_width_px();
    half_width_px_ =
        std::max({half_width_px_, half + std::abs(group.shift_px.x), half + std::abs(group.shift_px.y)});
    finest = std::min(finest, half / 16.0);
  }
  constexpr double kMostCells = 1024.0;
  const int cells = static_cast<int>(std::min(kMostCells, std::ceil(2.0 * half_width_px_ / finest)));
  const double side = 2.0 * half_width_px_ / cells;
  std::vector<double> mean(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0.0);
  for (const FootprintGroup& group : groups_) {
    std::vector<double> own;
    own.reserve(mean.size());
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const double x = i * side - half_width_px_ - group.shift_px.x,
                     y = j * side - half_width_px_ - group.shift_px.y;
        own.push_back(std::max(0.0, group.footprint.integral(x, y, x + side, y + side)));
      }
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += own[k];
    tables_.push_back(PixelFootprint::tabulated(half_width_px_, cells, std::move(own)));
  }
  tables_.push_back(PixelFootprint::tabulated(half_width_px_, cells, std::move(mean)));
}

double FootprintGroups::importance(std::size_t group, double dx_px, double dy_px) const {
  const double all = mixture().density(dx_px, dy_px);
  return all > 0.0 ? tables_[group].density(dx_px, dy_px) / all : 0.0;
}

ColumnFootprints::ColumnFootprints(const PixelFootprint& of_all, const FootprintGroups* groups,
                                   std::span<const int> channels)
    : one_(&of_all), groups_(groups) {
  if (groups_ == nullptr) return;
  for (const int channel : channels)
    of_column_.push_back(static_cast<std::uint16_t>(groups_->group_of(channel)));
}

int ColumnFootprints::reach() const {
  return std::max(0, static_cast<int>(std::ceil(half_width_px() - 0.5 - 1e-12)));
}

bool ColumnFootprints::reaches(std::size_t group, int dx, int dy) const {
  const double far = footprint(group).half_width_px() + 0.5 - 1e-12;
  const Point2 s = shift_px(group);
  return std::abs(dx - s.x) < far && std::abs(dy - s.y) < far;
}

std::vector<std::vector<std::size_t>> ColumnFootprints::positions(std::span<const int> columns) const {
  std::vector<std::vector<std::size_t>> found(groups());
  for (std::size_t k = 0; k < columns.size(); ++k)
    found[group_of(static_cast<std::size_t>(columns[k]))].push_back(k);
  return found;
}

}  // namespace ifov::sampling
