#include "sampling/pixel_footprint.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sampling/random.h"

namespace ifov::sampling {

struct PixelFootprint::Values {
  virtual ~Values() = default;
  virtual double at(double dx, double dy) const = 0;
  virtual void at(std::span<const double> x, std::span<const double> y, Point2 at,
                  std::span<double> to) const = 0;
  /// Of a rectangle within the half width.
  virtual double integral(double x0, double y0, double x1, double y1) const = 0;
};

namespace {

/// Of equal cells over the half width, bilinear between their centres.
struct Table final : PixelFootprint::Values {
  Table(double half_width_px, int cells_per_side, std::vector<double> density_px2,
        std::vector<double> summed_areas)
      : half_width(half_width_px),
        cells(cells_per_side),
        density(std::move(density_px2)),
        summed(std::move(summed_areas)) {}
  double half_width;
  int cells;                    // per side
  std::vector<double> density;  // h at cell centres
  std::vector<double> summed;   // summed-area table, (cells + 1)^2
  double at(double dx, double dy) const override;
  void at(std::span<const double> x, std::span<const double> y, Point2 at,
          std::span<double> to) const override;
  double integral(double x0, double y0, double x1, double y1) const override;
};

/// A density along an axis, straight between the centres of equal cells.
struct Profile {
  Profile(double half_width_px, std::vector<double> values);
  double at(double d) const;
  double integral_to(double d) const;

  double half_width, cells_per_px;
  std::vector<double> density, below;  // at centres; integrals up to there, and over all
};

Profile::Profile(double half_width_px, std::vector<double> values)
    : half_width(half_width_px),
      cells_per_px(static_cast<double>(values.size()) / (2.0 * half_width_px)),
      density(std::move(values)) {
  double sum = 0.0;
  for (double v : density) {
    if (!(v >= 0.0) || !std::isfinite(v))
      throw std::invalid_argument("a footprint's values must be finite and not negative");
    sum += v;
  }
  if (density.size() < 2 || sum == 0.0)
    throw std::invalid_argument("a footprint's profile needs values, not all zero");
  for (double& v : density) v *= cells_per_px / sum;
  // Beyond the outermost centres the outermost values hold.
  double so_far = 0.5 * density.front() / cells_per_px;
  for (std::size_t k = 0; k < density.size(); ++k) {
    if (k > 0) so_far += 0.5 * (density[k - 1] + density[k]) / cells_per_px;
    below.push_back(so_far);
  }
}

inline double Profile::at(double d) const {
  const double last = static_cast<double>(density.size()) - 1.0;
  const double place = std::min(std::max((d + half_width) * cells_per_px - 0.5, 0.0), last);
  const int low = std::min(static_cast<int>(place), static_cast<int>(density.size()) - 2);
  const double share = place - low;
  const double inside = (1.0 - share) * density[low] + share * density[low + 1];
  return std::abs(d) > half_width ? 0.0 : inside;
}

double Profile::integral_to(double d) const {
  const double place = (std::clamp(d, -half_width, half_width) + half_width) * cells_per_px - 0.5;
  if (place <= 0.0) return (place + 0.5) * density.front() / cells_per_px;
  const std::size_t low = std::min(static_cast<std::size_t>(place), density.size() - 1);
  const double share = place - static_cast<double>(low);
  if (low + 1 == density.size()) return below[low] + share * density.back() / cells_per_px;
  return below[low] + share * (density[low] + 0.5 * share * (density[low + 1] - density[low])) / cells_per_px;
}

/// Integral along the pieces up to a place.
double striped_below(std::span<const PixelFootprint::Piece> pieces, double y_px) {
  double sum = 0.0;
  for (const PixelFootprint::Piece& piece : pieces) {
    if (!(y_px > piece.y0)) break;
    const double end = std::min(y_px, piece.y1);
    sum += 0.5 * (piece.from + piece.at(end)) * (end - piece.y0);
  }
  return sum;
}

struct Product final : PixelFootprint::Values {
  Product(Profile x, Profile y) : across(std::move(x)), along(std::move(y)) {}
  Profile across, along;
  double at(double dx, double dy) const override { return across.at(dx) * along.at(dy); }
  void at(std::span<const double> x, std::span<const double> y, Point2 at,
          std::span<double> to) const override {
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = across.at(x[k] - at.x) * along.at(y[k] - at.y);
  }
  double integral(double x0, double y0, double x1, double y1) const override {
    return (across.integral_to(x1) - across.integral_to(x0)) *
           (along.integral_to(y1) - along.integral_to(y0));
  }
};

}  // namespace

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
  const double cell_side = 2.0 * half_width_px / cells_per_side;
  footprint.cell_ = cell_side;
  for (double& v : values) v /= sum * cell_side * cell_side;
  std::vector<double> summed((n + 1) * (n + 1), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    double row = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      row += values[j * n + i] * cell_side * cell_side;
      summed[(j + 1) * (n + 1) + i + 1] = summed[j * (n + 1) + i + 1] + row;
    }
  }
  footprint.values_ =
      std::make_shared<const Table>(half_width_px, cells_per_side, std::move(values), std::move(summed));
  return footprint;
}

PixelFootprint PixelFootprint::product(double half_width_px, double cell_px, std::vector<double> across,
                                       std::vector<double> along) {
  if (!(half_width_px > 0.0) || !std::isfinite(half_width_px) || !(cell_px > 0.0))
    throw std::invalid_argument("a footprint needs a positive half width and cells");
  PixelFootprint footprint;
  footprint.half_width_ = half_width_px;
  footprint.cell_ = cell_px;
  footprint.values_ = std::make_shared<const Product>(Profile(half_width_px, std::move(across)),
                                                      Profile(half_width_px, std::move(along)));
  return footprint;
}

PixelFootprint PixelFootprint::striped(double side_px, std::vector<Piece> pieces) {
  if (!(side_px > 0.0) || !std::isfinite(side_px) || pieces.empty())
    throw std::invalid_argument("a striped footprint needs a positive side and a piece at least");
  PixelFootprint footprint;
  footprint.half_width_across_ = 0.5 * side_px;
  footprint.half_width_ = footprint.half_width_across_;
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

PixelFootprint PixelFootprint::striped_along_x(double side_px, std::vector<Piece> pieces) {
  PixelFootprint footprint = striped(side_px, std::move(pieces));
  footprint.along_x_ = true;
  return footprint;
}

double PixelFootprint::density(double dx_px, double dy_px) const {
  if (std::abs(dx_px) > half_width_ || std::abs(dy_px) > half_width_) return 0.0;
  if (!pieces_.empty()) {
    const double across = along_x_ ? dy_px : dx_px, along = along_x_ ? dx_px : dy_px;
    if (std::abs(across) > half_width_across_) return 0.0;
    for (const Piece& piece : pieces_)
      if (along >= piece.y0 && along <= piece.y1) return 0.5 * piece.at(along) / half_width_across_;
    return 0.0;
  }
  if (uniform()) return 0.25 / (half_width_ * half_width_);
  return values_->at(dx_px, dy_px);
}

double Table::at(double dx_px, double dy_px) const {
  const double cells_per_px = cells / (2.0 * half_width);
  // Beyond the outermost centres the outermost values hold, which keeps the integral at 1.
  const auto locate = [&](double d, int& low, double& share) {
    const double at = std::clamp((d + half_width) * cells_per_px - 0.5, 0.0, cells - 1.0);
    low = std::min(static_cast<int>(at), std::max(0, cells - 2));
    share = at - low;
  };
  int i = 0, j = 0;
  double s = 0.0, t = 0.0;
  locate(dx_px, i, s);
  locate(dy_px, j, t);
  const int i1 = std::min(i + 1, cells - 1), j1 = std::min(j + 1, cells - 1);
  const auto at = [&](int column, int row) {
    return density[static_cast<std::size_t>(row * cells + column)];
  };
  return (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i1, j)) + t * ((1.0 - s) * at(i, j1) + s * at(i1, j1));
}

void PixelFootprint::densities(std::span<const double> x, std::span<const double> y, Point2 at,
                               std::span<double> to) const {
  if (values_) return values_->at(x, y, at, to);
  for (std::size_t k = 0; k < to.size(); ++k) to[k] = density(x[k] - at.x, y[k] - at.y);
}

void Table::at(std::span<const double> x, std::span<const double> y, Point2 at, std::span<double> to) const {
  // As density() has it, without a branch, so that the loop becomes one over vectors.
  const double half = half_width, cells_per_px = cells / (2.0 * half_width), last = cells - 1.0;
  const int before_last = std::max(0, cells - 2), side = cells, next = cells > 1 ? 1 : 0;
  const double* const table = density.data();
  const double *const xs = x.data(), *const ys = y.data();
  double* const found = to.data();
  for (std::size_t k = 0; k < to.size(); ++k) {
    const double dx = xs[k] - at.x, dy = ys[k] - at.y;
    const double across = std::min(std::max((dx + half) * cells_per_px - 0.5, 0.0), last);
    const double down = std::min(std::max((dy + half) * cells_per_px - 0.5, 0.0), last);
    const int i = std::min(static_cast<int>(across), before_last),
              j = std::min(static_cast<int>(down), before_last);
    const double s = across - i, t = down - j;
    const int own = j * side + i, below = own + next * side;
    const double inside = (1.0 - t) * ((1.0 - s) * table[own] + s * table[own + next]) +
                          t * ((1.0 - s) * table[below] + s * table[below + next]);
    found[k] = std::abs(dx) > half || std::abs(dy) > half ? 0.0 : inside;
  }
}

double PixelFootprint::integral(double x0_px, double y0_px, double x1_px, double y1_px) const {
  const auto inside = [&](double d) { return std::clamp(d, -half_width_, half_width_); };
  const double x0 = inside(x0_px), x1 = inside(x1_px), y0 = inside(y0_px), y1 = inside(y1_px);
  if (x1 <= x0 || y1 <= y0) return 0.0;
  if (!pieces_.empty()) {
    const double across =
        std::min(along_x_ ? y1 : x1, half_width_across_) - std::max(along_x_ ? y0 : x0, -half_width_across_);
    const double along =
        striped_below(pieces_, along_x_ ? x1 : y1) - striped_below(pieces_, along_x_ ? x0 : y0);
    return across > 0.0 ? 0.5 * across / half_width_across_ * along : 0.0;
  }
  if (uniform()) return (x1 - x0) * (y1 - y0) * 0.25 / (half_width_ * half_width_);
  return values_->integral(x0, y0, x1, y1);
}

double Table::integral(double x0, double y0, double x1, double y1) const {
  // Of the bilinear density: up to a place, all cells before the last centre count whole, that one and the next in part.
  const double cells_per_px = cells / (2.0 * half_width);
  struct Share {
    int cell;
    double own, next;
  };
  const auto share_of = [&](double d) -> Share {
    const double u = (d + half_width) * cells_per_px;
    const int cell = std::clamp(static_cast<int>(std::floor(u - 0.5)), 0, cells - 1);
    const double past = u - 0.5 - cell;  // the centre
    if (past < 0.0 || cell == cells - 1) return {cell, u - cell, 0.0};
    return {cell, 0.5 + past - 0.5 * past * past, 0.5 * past * past};
  };
  const auto below = [&](double x, double y) {
    const Share across = share_of(x), down = share_of(y);
    const auto row = [&](int j) {
      const double* sums = &summed[static_cast<std::size_t>(j * (cells + 1) + across.cell)];
      double sum = sums[0] + across.own * (sums[1] - sums[0]);
      if (across.next > 0.0) sum += across.next * (sums[2] - sums[1]);
      return sum;
    };
    const double above = row(down.cell), own = row(down.cell + 1);
    double sum = above + down.own * (own - above);
    if (down.next > 0.0) sum += down.next * (row(down.cell + 2) - own);
    return sum;
  };
  return below(x1, y1) - below(x0, y1) - below(x1, y0) + below(x0, y0);
}

}  // namespace ifov::sampling
