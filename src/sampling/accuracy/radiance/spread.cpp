#include "sampling/accuracy/radiance/spread.h"

#include <algorithm>

namespace ifov::sampling {

namespace {

/// Weight, in values, of what all labels say about one of them.
constexpr double kBorrowed = 2.0;

/// Sums of squares and degrees of freedom become variances; row `labels` is the pool, which every row borrows
/// from.
void pool(std::vector<double>& squares, const std::vector<double>& freedom, std::size_t labels,
          std::size_t columns) {
  double total_freedom = 0.0;
  for (std::size_t l = 0; l < labels; ++l) total_freedom += freedom[l];
  double* all = &squares[labels * columns];
  for (std::size_t c = 0; c < columns; ++c) {
    double sum = 0.0;
    for (std::size_t l = 0; l < labels; ++l) sum += squares[l * columns + c];
    all[c] = total_freedom > 0.0 ? sum / total_freedom : 0.0;
    for (std::size_t l = 0; l < labels; ++l)
      squares[l * columns + c] = (squares[l * columns + c] + kBorrowed * all[c]) / (freedom[l] + kBorrowed);
  }
}

}  // namespace

LabelSpread::LabelSpread(const Lattice& lattice, const LabelTable& table, const LatticeValues& at)
    : columns_(at.columns),
      labels_(table.size()),
      local_((labels_ + 1) * columns_, 0.0),
      total_((labels_ + 1) * columns_, 0.0),
      rare_((labels_ + 1) * columns_, 0.0),
      lowest_(labels_ * columns_) {
  for (std::uint32_t l = 0; l < labels_; ++l) std::copy_n(table.mean(l), columns_, &lowest_[l * columns_]);
  std::vector<double> local_freedom(labels_, 0.0), total_freedom(labels_);
  const std::size_t row_length = static_cast<std::size_t>(lattice.columns()) + 1, vertices = at.labels.size();
  for (std::uint32_t l = 0; l < labels_; ++l) total_freedom[l] = table.count(l) - 1.0;
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::uint32_t l = at.labels[v];
    if (at.constant[l]) continue;
    const double* mean = table.mean(l);
    const float* value = at.value(v);
    for (std::size_t c = 0; c < columns_; ++c) {
      const double d = value[c] - mean[c];
      total_[l * columns_ + c] += d * d;
      lowest_[l * columns_ + c] = std::min(lowest_[l * columns_ + c], static_cast<double>(value[c]));
    }
  }
  for (std::size_t i = 0; i < at.random.labels.size(); ++i) {
    const std::uint32_t l = at.random.labels[i];
    if (at.constant[l]) continue;
    const float* value = at.random.value(i, columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      const double d = value[c] - table.mean(l)[c];
      total_[l * columns_ + c] += d * d;
    }
  }
  double known = 0.0;
  for (double& f : total_freedom) known += f = std::max(f, 0.0);
  if (known == 0.0) {
    // No label was seen twice: what labels differ by bounds what a label's own values may.
    for (std::size_t v = 1; v < vertices; ++v)
      for (std::size_t c = 0; c < columns_; ++c) {
        const double d = static_cast<double>(at.value(v)[c]) - at.value(v - 1)[c];
        total_[at.labels[v] * columns_ + c] += 0.5 * d * d;
      }
    for (std::size_t v = 1; v < vertices; ++v) total_freedom[at.labels[v]] += 1.0;
  }
  for (int j = 0; j < lattice.rows(); ++j) {
    const std::size_t first = static_cast<std::size_t>(j) * row_length;
    const std::uint32_t *above = &at.labels[first], *below = above + row_length;
    for (int i = 0; i < lattice.columns(); ++i) {
      const std::uint32_t l = above[i];
      if (above[i + 1] != l || below[i] != l || below[i + 1] != l) continue;
      local_freedom[l] += 1.0;
      if (at.constant[l]) continue;
      const std::size_t v = first + static_cast<std::size_t>(i);
      const float *a = at.value(v), *b = a + columns_, *d = at.value(v + row_length), *e = d + columns_;
      for (std::size_t c = 0; c < columns_; ++c) {
        const double twist = (static_cast<double>(a[c]) - b[c]) - (static_cast<double>(d[c]) - e[c]);
        const double square = 0.25 * twist * twist;
        local_[l * columns_ + c] += square;
        rare_[l * columns_ + c] += square * square;
      }
    }
  }
  add_random_points(lattice, at, local_freedom);
  blocks_ = local_freedom;
  double any = 0.0;
  for (double f : local_freedom) any += f;
  if (any == 0.0) {
    local_ = total_;
    local_freedom = total_freedom;
  }
  pool(rare_, local_freedom, labels_, columns_);
  pool(local_, local_freedom, labels_, columns_);
  for (std::size_t k = 0; k < rare_.size(); ++k)
    rare_[k] = local_[k] > 0.0 ? std::max(0.0, 4.0 * rare_[k] / local_[k] - 12.0 * local_[k]) : 0.0;
  pool(total_, total_freedom, labels_, columns_);
  constant_.resize(labels_);
  for (std::size_t l = 0; l < labels_; ++l) {
    const auto agree = [&](const std::vector<double>& variances) {
      const double* row = &variances[l * columns_];
      return std::all_of(row, row + columns_, [](double v) { return v == 0.0; });
    };
    constant_[l] = at.constant[l] != 0 && agree(local_) && agree(total_);
  }
}

/// Values beside the lattice differ from what its four vertices around them make of the position.
void LabelSpread::add_random_points(const Lattice& lattice, const LatticeValues& at,
                                    std::vector<double>& local_freedom) {
  const std::size_t row_length = static_cast<std::size_t>(lattice.columns()) + 1;
  const double k = lattice.cells_per_pixel();
  for (std::size_t p = 0; p < at.random.labels.size(); ++p) {
    const std::uint32_t l = at.random.labels[p];
    if (at.constant[l]) continue;
    const double x = (at.random.points[p].x_px - lattice.domain().x0) * k,
                 y = (at.random.points[p].y_px - lattice.domain().y0) * k;
    const int i = std::clamp(static_cast<int>(x), 0, lattice.columns() - 1),
              j = std::clamp(static_cast<int>(y), 0, lattice.rows() - 1);
    const std::size_t v = static_cast<std::size_t>(j) * row_length + static_cast<std::size_t>(i);
    const std::size_t corner[4] = {v, v + 1, v + row_length, v + row_length + 1};
    const double u = x - i, w = y - j;
    double weight[4] = {(1.0 - u) * (1.0 - w), u * (1.0 - w), (1.0 - u) * w, u * w};
    // Beside a border: from those of its label alone.
    const auto own = std::count_if(corner, corner + 4, [&](std::size_t c) { return at.labels[c] == l; });
    if (own == 0) continue;
    for (int q = 0; own < 4 && q < 4; ++q)
      weight[q] = at.labels[corner[q]] == l ? 1.0 / static_cast<double>(own) : 0.0;
    double squares = 1.0;
    for (const double share : weight) squares += share * share;
    local_freedom[l] += 1.0;
    for (std::size_t c = 0; c < columns_; ++c) {
      double difference = at.random.value(p, columns_)[c];
      for (int q = 0; q < 4; ++q) difference -= weight[q] * at.value(corner[q])[c];
      const double square = difference * difference / squares;
      local_[l * columns_ + c] += square;
      rare_[l * columns_ + c] += square * square;
    }
  }
}

void LabelSpread::learn(std::uint32_t label, std::span<const double> variances) {
  if (row_of(label) == labels_) {
    if (label - labels_ >= late_.size()) late_.resize(label - labels_ + 1, labels_);
    late_[label - labels_] = local_.size() / columns_;
    for (std::vector<double>* table : {&local_, &total_, &rare_}) {
      const std::vector<double> all(table->begin() + static_cast<std::ptrdiff_t>(labels_ * columns_),
                                    table->begin() + static_cast<std::ptrdiff_t>((labels_ + 1) * columns_));
      table->insert(table->end(), all.begin(), all.end());
    }
  }
  for (std::size_t c = 0; c < columns_; ++c)
    for (std::vector<double>* table : {&local_, &total_}) {
      double& known = (*table)[row_of(label) * columns_ + c];
      known = std::max(known, variances[c]);
    }
}

}  // namespace ifov::sampling
