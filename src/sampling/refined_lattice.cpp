#include "sampling/refined_lattice.h"

#include <algorithm>
#include <cmath>

#include "sampling/hash.h"
#include "sampling/sequence.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

namespace {

constexpr std::uint32_t kInactive = 0xffffffffu;
constexpr std::uint64_t kRotation = 0x726f74617465ull;

}  // namespace

RefinedLattice::RefinedLattice(const SubElementLattice& lattice, const AdaptiveOptions& options,
                               const TileProblem& problem)
    : lattice_(lattice), options_(options), problem_(problem) {
  const int kx = lattice.columns_per_pixel(), ky = lattice.rows_per_pixel();
  cap_ = options.max_samples / (kx * ky);
  const auto core = [&](const PixelRect& r, int& x0, int& y0, int& x1, int& y1) {
    x0 = r.x0 * kx + lattice.first_column();
    y0 = r.y0 * ky + lattice.first_row();
    x1 = (r.x1 - 1) * kx + lattice.first_column() + lattice.width();
    y1 = (r.y1 - 1) * ky + lattice.first_row() + lattice.height();
  };
  int x0, y0, x1, y1, image_x0, image_y0, image_x1, image_y1;
  core(problem.tile, x0, y0, x1, y1);
  core(problem.image, image_x0, image_y0, image_x1, image_y1);
  first_column_ = std::max(image_x0, x0 - 2);
  first_row_ = std::max(image_y0, y0 - 2);
  width_ = std::min(image_x1, x1 + 2) - first_column_;
  height_ = std::min(image_y1, y1 + 2) - first_row_;
  refine_x0_ = std::max(image_x0, x0 - 1) - first_column_;
  refine_y0_ = std::max(image_y0, y0 - 1) - first_row_;
  refine_x1_ = std::min(image_x1, x1 + 1) - first_column_;
  refine_y1_ = std::min(image_y1, y1 + 1) - first_row_;
}

FocalPoint RefinedLattice::point(std::size_t cell, int sample) const {
  const int column = first_column_ + static_cast<int>(cell) % width_;
  const int row = first_row_ + static_cast<int>(cell) / width_;
  Point2 p = halton_point(static_cast<std::uint32_t>(sample));
  if (options_.rotate_points) {
    p.x += unit_double(hash(problem_.seed, column, row, kRotation, 0));
    p.y += unit_double(hash(problem_.seed, column, row, kRotation, 1));
    p.x -= std::floor(p.x);
    p.y -= std::floor(p.y);
  }
  return lattice_.at(column, row, p);
}

bool RefinedLattice::refinable(std::size_t cell) const {
  const int x = static_cast<int>(cell) % width_, y = static_cast<int>(cell) / width_;
  return x >= refine_x0_ && x < refine_x1_ && y >= refine_y0_ && y < refine_y1_;
}

void RefinedLattice::draw(const std::vector<std::uint32_t>& cells, Field& field) {
  const int kx = lattice_.columns_per_pixel(), ky = lattice_.rows_per_pixel();
  for_each_value(
      field, problem_.cancel, cells.size(),
      [&](std::size_t k) {
        const std::size_t cell = cells[k];
        const int column = first_column_ + static_cast<int>(cell) % width_;
        const int row = first_row_ + static_cast<int>(cell) / width_;
        const int i = floor_divide(column, kx), j = floor_divide(row, ky);
        const int inside = (row - j * ky) * kx + column - i * kx;
        return PathRequest{point(cell, count_[cell]), hash(problem_.seed, i, j, kPixelPaths),
                           static_cast<std::uint32_t>(inside + count_[cell] * kx * ky)};
      },
      [&](std::size_t k, Label label, const float* values) {
        const std::size_t cell = cells[k];
        float* mean = &mean_[cell * columns_];
        const int n = ++count_[cell];
        if (n == 1) {
          first_label_[cell] = label;
          std::copy(values, values + columns_, mean);
          return;
        }
        labels_[active_[cell] * static_cast<std::size_t>(cap_ - 1) + static_cast<std::size_t>(n - 2)] = label;
        float* spread = &spread_[active_[cell] * columns_];
        const float share = 1.0f / static_cast<float>(n);
        bool moved = false;
        for (std::size_t c = 0; c < columns_; ++c) {
          const float before = values[c] - mean[c];
          mean[c] += before * share;
          spread[c] += before * (values[c] - mean[c]);
          moved |= before != 0.0f;
        }
        changed_[cell] = moved;
      });
}

bool RefinedLattice::differs_from_neighbour(std::size_t cell) const {
  const int x = static_cast<int>(cell) % width_, y = static_cast<int>(cell) / width_;
  const float* own = mean(cell);
  for (int b = std::max(0, y - 1); b <= std::min(height_ - 1, y + 1); ++b)
    for (int a = std::max(0, x - 1); a <= std::min(width_ - 1, x + 1); ++a) {
      const std::size_t other = static_cast<std::size_t>(b * width_ + a);
      if (!changed_[other]) continue;
      const float* theirs = mean(other);
      for (int c : judged_) {
        const double scale = options_.relative ? std::abs(static_cast<double>(own[c])) : 1.0;
        if (std::abs(static_cast<double>(theirs[c]) - static_cast<double>(own[c])) >
            options_.allowed_difference * scale)
          return true;
      }
    }
  return false;
}

void RefinedLattice::refine(Field& field) {
  const std::size_t cells = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  columns_ = static_cast<std::size_t>(field.columns());
  judged_.assign(problem_.steering_channels.begin(), problem_.steering_channels.end());
  if (judged_.empty())
    for (int c = 0; c < field.columns(); ++c) judged_.push_back(c);
  count_.assign(cells, 0);
  mean_.assign(cells * columns_, 0.0f);
  first_label_.assign(cells, 0);
  active_.assign(cells, kInactive);
  changed_.assign(cells, 1);

  std::vector<std::uint32_t> round(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) round[cell] = static_cast<std::uint32_t>(cell);
  draw(round, field);
  std::uint32_t refined = 0;
  while (cap_ > 1) {
    std::vector<std::uint32_t> marked;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      if (count_[cell] >= cap_ || !refinable(cell)) continue;
      if (active_[cell] != kInactive || differs_from_neighbour(cell))
        marked.push_back(static_cast<std::uint32_t>(cell));
    }
    if (marked.empty()) return;
    for (std::uint32_t cell : marked)
      if (active_[cell] == kInactive) active_[cell] = refined++;
    spread_.resize(refined * columns_, 0.0f);
    labels_.resize(refined * static_cast<std::size_t>(cap_ - 1), 0);
    std::fill(changed_.begin(), changed_.end(), 0);
    draw(marked, field);
  }
}

bool RefinedLattice::mixed(std::size_t cell) const {
  if (count_[cell] > 1) {
    const Label* more = more_labels(cell);
    return std::any_of(more, more + count_[cell] - 1, [&](Label l) { return l != first_label_[cell]; });
  }
  std::size_t near[4];
  const int n = neighbours(cell, near);
  return std::any_of(near, near + n,
                     [&](std::size_t other) { return first_label_[other] != first_label_[cell]; });
}

int RefinedLattice::neighbours(std::size_t cell, std::size_t (&out)[4]) const {
  const int x = static_cast<int>(cell) % width_, y = static_cast<int>(cell) / width_;
  int n = 0;
  if (x > 0) out[n++] = cell - 1;
  if (x + 1 < width_) out[n++] = cell + 1;
  if (y > 0) out[n++] = cell - static_cast<std::size_t>(width_);
  if (y + 1 < height_) out[n++] = cell + static_cast<std::size_t>(width_);
  return n;
}

bool RefinedLattice::add_variance(std::size_t cell, double factor, std::span<double> variance) const {
  if (const int n = count_[cell]; n > 1) {
    const float* spread = &spread_[active_[cell] * columns_];
    const double scale = factor / (static_cast<double>(n) * (n - 1));
    for (std::size_t c = 0; c < columns_; ++c) variance[c] += scale * static_cast<double>(spread[c]);
    return true;
  }
  std::size_t near[4];
  const int n = neighbours(cell, near);
  for (int k = 0; k < n; ++k) {
    const float *own = mean(cell), *theirs = mean(near[k]);
    for (std::size_t c = 0; c < columns_; ++c) {
      const double d = static_cast<double>(own[c]) - static_cast<double>(theirs[c]);
      variance[c] += factor * 0.5 / n * d * d;
    }
  }
  return n > 0;
}

void RefinedLattice::count_samples(TileResult& result) const {
  const PixelRect& t = problem_.tile;
  for (std::size_t cell = 0; cell < count_.size(); ++cell) {
    const int i = floor_divide(first_column_ + static_cast<int>(cell) % width_, lattice_.columns_per_pixel());
    const int j = floor_divide(first_row_ + static_cast<int>(cell) / width_, lattice_.rows_per_pixel());
    const auto n = static_cast<std::uint32_t>(count_[cell]);
    if (i < t.x0 || i >= t.x1 || j < t.y0 || j >= t.y1) {
      result.halo_samples += n;
      continue;
    }
    const auto pixel = static_cast<std::size_t>((j - t.y0) * t.width() + i - t.x0);
    result.samples[pixel] += n;
    result.radiance_evaluations[pixel] += n;
  }
}

}  // namespace ifov::sampling
