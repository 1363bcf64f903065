#include "sampling/refined_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sampling/hash.h"
#include "sampling/sequence.h"

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
  for (int k = 0; k < cap_; ++k) points_.push_back(halton_point(static_cast<std::uint32_t>(k)));
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
  for (int x = 0; x < width_; ++x) pixel_column_.push_back(floor_divide(first_column_ + x, kx));
  for (int y = 0; y < height_; ++y) pixel_row_.push_back(floor_divide(first_row_ + y, ky));
  refine_x0_ = std::max(image_x0, x0 - 1) - first_column_;
  refine_y0_ = std::max(image_y0, y0 - 1) - first_row_;
  refine_x1_ = std::min(image_x1, x1 + 1) - first_column_;
  refine_y1_ = std::min(image_y1, y1 + 1) - first_row_;
}

Point2 RefinedLattice::within(int column, int row, int sample) const {
  Point2 p = points_[static_cast<std::size_t>(sample)];
  if (options_.rotate_points) {
    p.x += unit_double(hash(problem_.seed, column, row, kRotation, 0));
    p.y += unit_double(hash(problem_.seed, column, row, kRotation, 1));
    p.x -= std::floor(p.x);
    p.y -= std::floor(p.y);
  }
  return p;
}

void RefinedLattice::draw(const std::vector<std::uint32_t>& cells, Field& field) {
  const int kx = lattice_.columns_per_pixel(), ky = lattice_.rows_per_pixel();
  struct {
    int i = std::numeric_limits<int>::min(), j = 0;
    std::uint64_t paths = 0;
  } pixel;  // of the last request: the next is mostly in the same
  for_each_value(
      field, problem_.cancel, cells.size(), batch_,
      [&](std::size_t k) {
        const std::size_t cell = cells[k];
        const int column = first_column_ + static_cast<int>(cell) % width_;
        const int row = first_row_ + static_cast<int>(cell) / width_;
        const int i = pixel_column_[static_cast<std::size_t>(column - first_column_)];
        const int j = pixel_row_[static_cast<std::size_t>(row - first_row_)];
        if (i != pixel.i || j != pixel.j) pixel = {i, j, hash(problem_.seed, i, j, kPixelPaths)};
        const int a = column - i * kx, b = row - j * ky;
        return PathRequest{lattice_.at(i, j, a, b, within(column, row, count_[cell])), pixel.paths,
                           static_cast<std::uint32_t>(b * kx + a + count_[cell] * kx * ky)};
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

bool RefinedLattice::differs(const float* own, const float* theirs) const {
  for (int c : judged_) {
    const double mean = static_cast<double>(own[c]);
    const double scale = options_.relative ? std::abs(mean) : 1.0;
    if (std::abs(static_cast<double>(theirs[c]) - mean) > options_.allowed_difference * scale) return true;
  }
  return false;
}

std::vector<std::uint32_t> RefinedLattice::first_marked() const {
  const std::size_t width = static_cast<std::size_t>(width_), cells = mean_.size() / columns_;
  std::vector<std::uint8_t> marks(cells, 0);
  std::vector<double> value(cells), limit(cells, options_.allowed_difference);
  for (int c : judged_) {
    for (std::size_t cell = 0; cell < cells; ++cell) value[cell] = static_cast<double>(mean(cell)[c]);
    if (options_.relative)
      for (std::size_t cell = 0; cell < cells; ++cell)
        limit[cell] = options_.allowed_difference * std::abs(value[cell]);
    for (int y = refine_y0_; y < refine_y1_; ++y)
      for (int b = std::max(0, y - 1); b <= std::min(height_ - 1, y + 1); ++b)
        for (int shift = -1; shift <= 1; ++shift) {
          const std::size_t row = static_cast<std::size_t>(y) * width;
          const double* const own = &value[row];
          const double* const theirs = &value[static_cast<std::size_t>(b) * width] + shift;
          for (int x = std::max(refine_x0_, -shift); x < std::min(refine_x1_, width_ - shift); ++x)
            marks[row + static_cast<std::size_t>(x)] |=
                std::abs(theirs[x] - own[x]) > limit[row + static_cast<std::size_t>(x)];
        }
  }
  std::vector<std::uint32_t> marked;
  for (std::size_t cell = 0; cell < cells; ++cell)
    if (marks[cell] != 0) marked.push_back(static_cast<std::uint32_t>(cell));
  return marked;
}

std::vector<std::uint32_t> RefinedLattice::newly_marked(const std::vector<std::uint32_t>& drawn) const {
  std::vector<std::uint32_t> marked;
  for (std::uint32_t cell : drawn) {
    if (changed_[cell] == 0) continue;
    const int x = static_cast<int>(cell) % width_, y = static_cast<int>(cell) / width_;
    for (int b = std::max(refine_y0_, y - 1); b <= std::min(refine_y1_ - 1, y + 1); ++b)
      for (int a = std::max(refine_x0_, x - 1); a <= std::min(refine_x1_ - 1, x + 1); ++a) {
        const std::size_t other = static_cast<std::size_t>(b * width_ + a);
        if (active_[other] == kInactive && differs(mean(other), mean(cell)))
          marked.push_back(static_cast<std::uint32_t>(other));
      }
  }
  std::sort(marked.begin(), marked.end());
  marked.erase(std::unique(marked.begin(), marked.end()), marked.end());
  return marked;
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
  changed_.assign(cells, 0);

  std::vector<std::uint32_t> round(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) round[cell] = static_cast<std::uint32_t>(cell);
  draw(round, field);
  if (cap_ <= 1) return;
  std::uint32_t refined = 0;
  std::vector<std::uint32_t> fresh = first_marked();
  round.clear();
  while (true) {
    for (std::uint32_t cell : fresh) active_[cell] = refined++;
    spread_.resize(refined * columns_, 0.0f);
    labels_.resize(refined * static_cast<std::size_t>(cap_ - 1), 0);
    std::erase_if(round, [&](std::uint32_t cell) { return count_[cell] >= cap_; });
    const std::size_t running = round.size();
    round.insert(round.end(), fresh.begin(), fresh.end());
    std::inplace_merge(round.begin(), round.begin() + static_cast<std::ptrdiff_t>(running), round.end());
    if (round.empty()) return;
    draw(round, field);
    fresh = newly_marked(round);
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
  const double share = factor * 0.5 / n;
  for (int k = 0; k < n; ++k) {
    const float *own = mean(cell), *theirs = mean(near[k]);
    for (std::size_t c = 0; c < columns_; ++c) {
      const double d = static_cast<double>(own[c]) - static_cast<double>(theirs[c]);
      variance[c] += share * d * d;
    }
  }
  return n > 0;
}

void RefinedLattice::count_samples(TileResult& result) const {
  const PixelRect& t = problem_.tile;
  std::size_t cell = 0;
  for (int j : pixel_row_)
    for (int i : pixel_column_) {
      const auto n = static_cast<std::uint32_t>(count_[cell++]);
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
