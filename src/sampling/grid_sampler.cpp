#include "sampling/grid_sampler.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sampling/hash.h"
#include "sampling/pixel_accumulator.h"
#include "sampling/quantiles.h"
#include "sampling/sub_element_lattice.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

namespace {

constexpr Point2 kCentre{0.5, 0.5};

/// The sub-elements of a tile, in the order in which they are asked for.
class GridOrder {
 public:
  GridOrder(const SubElementLattice& lattice, PixelRect tile)
      : lattice_(lattice),
        tile_(tile),
        per_pixel_(lattice.columns_per_pixel() * lattice.rows_per_pixel()),
        shared_(lattice.width() != lattice.columns_per_pixel() ||
                lattice.height() != lattice.rows_per_pixel()),
        first_column_(tile.x0 * lattice.columns_per_pixel() + lattice.first_column()),
        first_row_(tile.y0 * lattice.rows_per_pixel() + lattice.first_row()),
        width_((tile.width() - 1) * lattice.columns_per_pixel() + lattice.width()),
        height_((tile.height() - 1) * lattice.rows_per_pixel() + lattice.height()) {}

  bool shared() const { return shared_; }
  int per_pixel() const { return per_pixel_; }
  std::size_t count() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

  /// Pixel by pixel where pixels share nothing, so that one is finished before the next begins; else row by
  /// row.
  void position(std::size_t k, int& column, int& row) const {
    if (shared_) {
      column = first_column_ + static_cast<int>(k % static_cast<std::size_t>(width_));
      row = first_row_ + static_cast<int>(k / static_cast<std::size_t>(width_));
      return;
    }
    const int pixel = static_cast<int>(k / static_cast<std::size_t>(per_pixel_));
    const int inside = static_cast<int>(k % static_cast<std::size_t>(per_pixel_));
    column = (tile_.x0 + pixel % tile_.width()) * lattice_.columns_per_pixel() +
             inside % lattice_.columns_per_pixel();
    row = (tile_.y0 + pixel / tile_.width()) * lattice_.rows_per_pixel() +
          inside / lattice_.columns_per_pixel();
  }

 private:
  const SubElementLattice& lattice_;
  PixelRect tile_;
  int per_pixel_;
  bool shared_;
  int first_column_, first_row_, width_, height_;
};

}  // namespace

GridSampler::GridSampler(int columns_per_pixel, int rows_per_pixel)
    : columns_(columns_per_pixel), rows_(rows_per_pixel) {
  if (columns_ < 1 || rows_ < 1) throw std::invalid_argument("a grid needs at least one ray per pixel");
}

void GridSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  result.reset(problem.tile, field.columns());
  const RayCounts before = field.counts();
  const SubElementLattice lattice(*problem.footprint, columns_, rows_);
  const GridOrder order(lattice, problem.tile);
  StudentTable student(confidence_of(problem));
  const int tile_width = problem.tile.width();

  const auto write = [&](const PixelAccumulator& pixel, std::size_t index) {
    PixelEstimate estimate = pixel.estimate();
    if (pixel.count() > 1) estimate.quantile = student(pixel.count() - 1);
    estimate.spent = true;
    write_pixel(estimate, problem, index, result);
  };
  const auto request = [&](std::size_t k) {
    int c = 0, r = 0;
    order.position(k, c, r);
    const int i = floor_divide(c, columns_), j = floor_divide(r, rows_);
    const int a = c - i * columns_, b = r - j * rows_;
    return PathRequest{lattice.at(i, j, a, b, kCentre), hash(problem.seed, i, j, kPixelPaths),
                       static_cast<std::uint32_t>(b * columns_ + a)};
  };
  // Adds a sample to every pixel of the tile that weighs it, and counts it for the pixel it lies in.
  const auto share_out = [&](std::size_t k, auto add) {
    int c = 0, r = 0;
    order.position(k, c, r);
    const int own_i = floor_divide(c, columns_), own_j = floor_divide(r, rows_);
    const PixelRect& t = problem.tile;
    if (own_i >= t.x0 && own_i < t.x1 && own_j >= t.y0 && own_j < t.y1) {
      const auto own = static_cast<std::size_t>((own_j - t.y0) * tile_width + own_i - t.x0);
      ++result.samples[own];
      ++result.radiance_evaluations[own];
    } else {
      ++result.halo_samples;
    }
    const int a = c - lattice.first_column(), b = r - lattice.first_row();
    const int i0 = std::max(t.x0, floor_divide(a - lattice.width(), columns_) + 1);
    const int i1 = std::min(t.x1 - 1, floor_divide(a, columns_));
    const int j0 = std::max(t.y0, floor_divide(b - lattice.height(), rows_) + 1);
    const int j1 = std::min(t.y1 - 1, floor_divide(b, rows_));
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        add(static_cast<std::size_t>((j - t.y0) * tile_width + i - t.x0),
            lattice.weight(a - i * columns_, b - j * rows_));
  };

  std::vector<PixelAccumulator> pixels(order.shared() ? result.samples.size() : 1,
                                       PixelAccumulator(result.columns));
  for_each_value(field, problem.cancel, order.count(), request,
                 [&](std::size_t k, Label label, const float* values) {
                   const std::uint32_t material = field.material_of(label);
                   share_out(k, [&](std::size_t index, double weight) {
                     PixelAccumulator& pixel = pixels[order.shared() ? index : 0];
                     pixel.add(weight, label, material, values);
                     if (order.shared() || pixel.count() < order.per_pixel()) return;
                     write(pixel, index);
                     pixel.clear();
                   });
                 });
  if (order.shared())
    for (std::size_t index = 0; index < pixels.size(); ++index) write(pixels[index], index);
  result.rays = rays_since(before, field);
}

void SingleSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  result.reset(problem.tile, field.columns(), false);
  const RayCounts before = field.counts();
  const int width = problem.tile.width();
  const std::size_t columns = static_cast<std::size_t>(field.columns());
  // One point finds a feature of area a with probability a.
  constexpr float kFoundArea = 0.95f;
  result.samples.assign(result.samples.size(), 1);
  result.radiance_evaluations.assign(result.samples.size(), 1);
  result.missable_fraction.assign(result.samples.size(), kFoundArea);
  if (problem.tolerance != nullptr)
    result.worst_ratio.assign(result.samples.size(), std::numeric_limits<float>::infinity());
  result.abundances.reserve(result.samples.size());
  for_each_value(
      field, problem.cancel, static_cast<std::size_t>(problem.tile.count()),
      [&](std::size_t pixel) {
        const int i = problem.tile.x0 + static_cast<int>(pixel) % width;
        const int j = problem.tile.y0 + static_cast<int>(pixel) / width;
        return PathRequest{{i + 0.5, j + 0.5}, hash(problem.seed, i, j, kPixelPaths), 0};
      },
      [&](std::size_t pixel, Label label, const float* values) {
        std::copy(values, values + columns,
                  result.mean.begin() + static_cast<std::ptrdiff_t>(pixel * columns));
        result.abundances.push_back({static_cast<std::uint32_t>(pixel), field.material_of(label), 1.0f,
                                     std::numeric_limits<float>::quiet_NaN()});
      });
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
