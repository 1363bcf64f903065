#include "sampling/grid_sampler.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "sampling/footprint_groups.h"
#include "sampling/hash.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/pixel_accumulator.h"
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

/// All columns of a field, by group.
std::vector<std::vector<std::size_t>> columns_by_group(const ColumnFootprints& footprints, int columns) {
  std::vector<int> all(static_cast<std::size_t>(columns));
  std::iota(all.begin(), all.end(), 0);
  return footprints.positions(all);
}

/// A pixel whose columns weigh samples by group.
class GroupedPixel {
 public:
  /// Keeps a reference.
  GroupedPixel(const std::vector<std::vector<std::size_t>>& columns_of, int columns)
      : columns_of_(columns_of), columns_(static_cast<std::size_t>(columns)) {
    for (const auto& own : columns_of) groups_.emplace_back(static_cast<int>(own.size()));
  }

  void clear() {
    for (PixelAccumulator& group : groups_) group.clear();
  }
  void add(std::size_t group, double weight, Label label, std::uint32_t material, const float* values) {
    if (groups_.size() == 1) return groups_[0].add(weight, label, material, values);
    if (weight == 0.0) return;
    own_.clear();
    for (const std::size_t column : columns_of_[group]) own_.push_back(values[column]);
    groups_[group].add(weight, label, material, own_.data());
  }
  /// Samples of the group that has fewest.
  int fewest() const {
    int count = groups_.front().count();
    for (const PixelAccumulator& group : groups_) count = std::min(count, group.count());
    return count;
  }
  /// Shares of materials are those of the reference.
  PixelEstimate estimate() const {
    PixelEstimate all = groups_.front().estimate();
    if (groups_.size() == 1) return all;
    for (std::vector<double>* row : {&all.mean, &all.variance_geometry, &all.variance_path})
      row->resize(columns_);
    for (std::size_t group = groups_.size(); group-- > 0;) {
      const PixelEstimate own = groups_[group].estimate();
      for (std::size_t k = 0; k < columns_of_[group].size(); ++k) {
        all.mean[columns_of_[group][k]] = own.mean[k];
        all.variance_geometry[columns_of_[group][k]] = own.variance_geometry[k];
        all.variance_path[columns_of_[group][k]] = own.variance_path[k];
      }
    }
    return all;
  }

 private:
  const std::vector<std::vector<std::size_t>>& columns_of_;
  std::size_t columns_;
  std::vector<PixelAccumulator> groups_;
  std::vector<float> own_;
};

}  // namespace

GridSampler::GridSampler(int columns_per_pixel, int rows_per_pixel)
    : columns_(columns_per_pixel), rows_(rows_per_pixel) {
  if (columns_ < 1 || rows_ < 1) throw std::invalid_argument("a grid needs at least one ray per pixel");
}

void GridSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  result.reset(problem.tile, field.columns());
  const RayCounts before = field.counts();
  const ColumnFootprints footprints = problem.footprints(field);
  const SubElementLattices lattices(footprints, problem.tile, columns_, rows_);
  const SubElementLattice& lattice = lattices.any();
  const std::vector<std::vector<std::size_t>> columns_of = columns_by_group(footprints, field.columns());
  const GridOrder order(lattice, problem.tile);
  StudentTable student(confidence_of(problem));
  const int tile_width = problem.tile.width();

  const auto write = [&](const GroupedPixel& pixel, std::size_t index) {
    PixelEstimate estimate = pixel.estimate();
    if (pixel.fewest() > 1) estimate.quantile = student(pixel.fewest() - 1);
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
        add(static_cast<std::size_t>((j - t.y0) * tile_width + i - t.x0), a - i * columns_, b - j * rows_);
  };

  std::vector<GroupedPixel> pixels(order.shared() ? result.samples.size() : 1,
                                   GroupedPixel(columns_of, result.columns));
  for_each_value(field, problem.cancel, order.count(), request,
                 [&](std::size_t k, Label label, const float* values) {
                   const std::uint32_t material = field.material_of(label);
                   share_out(k, [&](std::size_t index, int a, int b) {
                     GroupedPixel& pixel = pixels[order.shared() ? index : 0];
                     const int column = problem.tile.x0 + static_cast<int>(index) % tile_width;
                     for (std::size_t group = 0; group < lattices.groups(); ++group)
                       pixel.add(group, lattices.of(group, column).weight(a, b), label, material, values);
                     // Groups leave out what does not weigh with them.
                     const bool whole = (k + 1) % static_cast<std::size_t>(order.per_pixel()) == 0;
                     if (order.shared() || !whole) return;
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
  // Footprints that have one centre have one ray.
  const ColumnFootprints footprints = problem.footprints(field);
  const auto centre_at = [&](std::size_t group, std::size_t pixel) {
    return footprints.shift_px(group, problem.tile.x0 + static_cast<int>(pixel) % width);
  };
  const int looked_at = footprints.by_column() ? width : 1;
  std::vector<std::size_t> centres;  // groups that have a ray of their own
  std::vector<std::size_t> ray_of_group;
  for (std::size_t group = 0; group < footprints.groups(); ++group) {
    const auto is_that_of = [&](std::size_t other) {
      for (int i = 0; i < looked_at; ++i) {
        const Point2 a = centre_at(group, static_cast<std::size_t>(i)),
                     b = centre_at(other, static_cast<std::size_t>(i));
        if (a.x != b.x || a.y != b.y) return false;
      }
      return true;
    };
    const auto found = std::find_if(centres.begin(), centres.end(), is_that_of);
    ray_of_group.push_back(static_cast<std::size_t>(found - centres.begin()));
    if (found == centres.end()) centres.push_back(group);
  }
  std::vector<std::vector<std::size_t>> columns_of(centres.size());
  for (std::size_t c = 0; c < columns; ++c) columns_of[ray_of_group[footprints.group_of(c)]].push_back(c);
  // One point finds a feature of area a with probability a.
  constexpr float kFoundArea = 0.95f;
  const auto rays = static_cast<std::uint32_t>(centres.size());
  result.samples.assign(result.samples.size(), rays);
  result.radiance_evaluations.assign(result.samples.size(), rays);
  result.missable_fraction.assign(result.samples.size(), kFoundArea);
  if (problem.tolerance != nullptr)
    result.worst_ratio.assign(result.samples.size(), std::numeric_limits<float>::infinity());
  result.abundances.reserve(result.samples.size());
  for_each_value(
      field, problem.cancel, static_cast<std::size_t>(problem.tile.count()) * centres.size(),
      [&](std::size_t k) {
        const std::size_t pixel = k / centres.size();
        const Point2 centre = centre_at(centres[k % centres.size()], pixel);
        const int i = problem.tile.x0 + static_cast<int>(pixel) % width;
        const int j = problem.tile.y0 + static_cast<int>(pixel) / width;
        return PathRequest{
            {i + 0.5 + centre.x, j + 0.5 + centre.y}, hash(problem.seed, i, j, kPixelPaths), 0};
      },
      [&](std::size_t k, Label label, const float* values) {
        const std::size_t pixel = k / centres.size(), ray = k % centres.size();
        for (const std::size_t c : columns_of[ray]) result.mean[pixel * columns + c] = values[c];
        if (ray == 0)
          result.abundances.push_back({static_cast<std::uint32_t>(pixel), field.material_of(label), 1.0f,
                                       std::numeric_limits<float>::quiet_NaN()});
      });
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
