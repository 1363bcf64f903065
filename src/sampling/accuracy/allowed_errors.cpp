#include "sampling/accuracy/allowed_errors.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/no_label.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/steering_columns.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/source_grid.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/pixel_limits.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed variance that borders may take where paths vary as well.
constexpr double kGeometryShareWithPaths = 0.15;
/// Source pixels that weigh less than this in every output are traced as if they weighed so much.
constexpr double kLeastImportance = 0.02;

/// The first run of a tile that is kept traces borders, and tells clutter, for an error this much smaller: rays that look
/// beside a border are of no use where it is known better, nor are values of clutter in a pixel that is traced.
constexpr double kForesight = 2.0;

/// Integral of the square of the footprint: the variance of a pixel made of many equally uncertain source
/// pixels.
double footprint_energy(const PixelFootprint& footprint) {
  const double h = footprint.half_width_px();
  if (footprint.uniform()) return 0.25 / (h * h);
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double d =
          footprint.density((2.0 * (i + 0.5) / kSteps - 1.0) * h, (2.0 * (j + 0.5) / kSteps - 1.0) * h);
      sum += d * d;
    }
  return sum * 4.0 * h * h / (kSteps * kSteps);
}

double most_energy(const ColumnFootprints& footprints) {
  double most = 0.0;
  for (std::size_t group = 0; group < footprints.groups(); ++group)
    most = std::max(most, footprint_energy(footprints.footprint(group)));
  return most;
}

}  // namespace

AllowedErrors::AllowedErrors(const TileProblem& problem, const ColumnFootprints& footprints,
                             const SourceGrid& grid, const Lattice& lattice, const LatticeValues& values,
                             double normal, SteeringColumns& steering, Contrast& contrast)
    : problem_(problem),
      footprints_(footprints),
      grid_(grid),
      lattice_(lattice),
      values_(values),
      steering_(steering),
      contrast_(contrast),
      unit_(normal * (problem.keep_memory && problem.before == nullptr ? kForesight : 1.0)),
      energy_(most_energy(footprints)) {}

void AllowedErrors::take_from_lattice() {
  find_lattice_limits();
  cover_lattice();
}

void AllowedErrors::set_contrasts() {
  const int pixels = lattice_.domain().count();
  contrast_.begin(pixels);
  for (int p = 0; p < pixels; ++p) {
    const double* limit = &lattice_limits_[grid_.nearest_output(p) * values_.columns];
    const std::span<double> allowed = contrast_.allowed(p);
    for (std::size_t d = 0; d < allowed.size(); ++d) allowed[d] = limit[steering_.list()[d]];
  }
}

std::span<const double> AllowedErrors::inverse_squares(int source) {
  const int output = grid_.nearest_output(source);
  if (output != inverse_of_) {
    inverse_of_ = output;
    const double* limit = &lattice_limits_[output * values_.columns];
    inverse_.resize(values_.columns);
    for (std::size_t c = 0; c < inverse_.size(); ++c) inverse_[c] = 1.0 / (limit[c] * limit[c]);
  }
  return inverse_;
}

void AllowedErrors::find_lattice_limits() {
  const PixelRect& d = lattice_.domain();
  const std::size_t columns = values_.columns;
  const std::vector<double> source_mean = source_means();
  const int reach = footprints_.reach();
  const std::size_t groups = footprints_.groups();
  const int looked_at = footprints_.by_column() ? problem_.tile.width() : 1;
  std::vector<double>
      pixel_weight;  // [column of the tile][source pixel][group], of one column where all are alike
  for (int column = 0; column < looked_at; ++column)
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        for (std::size_t group = 0; group < groups; ++group)
          pixel_weight.push_back(
              footprints_.integral(group, problem_.tile.x0 + column, dx - 0.5, dy - 0.5, dx + 0.5, dy + 0.5));
  const std::size_t of_column = pixel_weight.size() / static_cast<std::size_t>(looked_at);
  PixelLimits limits(*problem_.tolerance, problem_.later);
  std::vector<double> mean(columns), known_mean, limit(columns);
  lattice_limits_.resize(static_cast<std::size_t>(problem_.tile.count()) * columns);
  for (int o = 0; o < problem_.tile.count(); ++o) {
    std::fill(mean.begin(), mean.end(), 0.0);
    const int source = grid_.source_of(o);
    const double* w =
        &pixel_weight[static_cast<std::size_t>(o % problem_.tile.width() % looked_at) * of_column];
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx, w += groups) {
        const double* from = &source_mean[static_cast<std::size_t>(source + dy * d.width() + dx) * columns];
        for (std::size_t c = 0; c < columns; ++c) mean[c] += w[footprints_.group_of(c)] * from[c];
      }
    if (mean != known_mean || !limits.alike()) {
      limits.of(static_cast<std::size_t>(o), mean, limit);
      known_mean = mean;
    }
    for (std::size_t c = 0; c < columns; ++c)
      lattice_limits_[static_cast<std::size_t>(o) * columns + c] = limit[c] / unit_;
  }
}

void AllowedErrors::cover_lattice() {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (int p = 0; p < lattice_.domain().count() && !steering_.all(); ++p) {
    if (values_.only[p] != LatticeValues::kMixed) continue;
    const std::uint32_t* labels = &values_.labels[lattice_.first_vertex(p)];
    pairs.clear();
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
      if (a != b) pairs.push_back(std::minmax(a, b));
    };
    for (int j = 0; j <= k; ++j, labels += row)
      for (int i = 0; i <= k; ++i) {
        if (i < k) add(labels[i], labels[i + 1]);
        if (j < k) add(labels[i], labels[i + row]);
      }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [a, b] : pairs) steering_.cover(contrast_, a, b, inverse_squares(p));
  }
}

bool AllowedErrors::cover(const SourcePixels& traced) {
  const std::size_t before = steering_.list().size();
  for (const SourcePixel& pixel : traced.others()) {
    const auto& labels = pixel.model.labels;
    for (std::size_t i = 0; i < labels.size() && !steering_.all(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        steering_.cover(contrast_, labels[i], labels[j], inverse_squares(pixel.source));
  }
  if (steering_.list().size() == before) return false;
  contrast_.begin(lattice_.domain().count());
  return true;
}

/// Of the lattice's values, [source pixel][column].
std::vector<double> AllowedErrors::source_means() const {
  const PixelRect& d = lattice_.domain();
  const std::size_t columns = values_.columns, row = static_cast<std::size_t>(lattice_.columns()) + 1;
  const int k = lattice_.cells_per_pixel();
  std::vector<double> vertex_weight;
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i)
      vertex_weight.push_back((i == 0 || i == k ? 0.5 : 1.0) * (j == 0 || j == k ? 0.5 : 1.0) / (k * k));
  std::vector<double> source_mean(static_cast<std::size_t>(d.count()) * columns, 0.0);
  int flat = -1;  // the last pixel of one value
  for (int p = 0; p < d.count(); ++p) {
    double* mean = &source_mean[p * columns];
    if (values_.flat(p)) {
      if (flat >= 0 && values_.only[flat] == values_.only[p]) {
        std::copy_n(&source_mean[flat * columns], columns, mean);
        continue;
      }
      flat = p;
    }
    const double* w = vertex_weight.data();
    for (int j = 0; j <= k; ++j) {
      const float* value = values_.value(lattice_.first_vertex(p) + j * row);
      for (int i = 0; i <= k; ++i, ++w, value += columns)
        for (std::size_t c = 0; c < columns; ++c) mean[c] += *w * value[c];
    }
  }
  return source_mean;
}

void AllowedErrors::take_from_sums(OutputIntervals& intervals) {
  const std::size_t n = steering_.list().size();
  PixelLimits limits(*problem_.tolerance, problem_.later);
  std::vector<double> mean(values_.columns, 0.0), limit(mean.size());
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    const int output = grid_.nearest_output(p);
    const OutputSums::Row sum = intervals.sum(output);
    for (std::size_t d = 0; d < n; ++d) mean[steering_.list()[d]] = sum.mean[d];
    limits.of(static_cast<std::size_t>(output), mean, limit);
    for (std::size_t d = 0; d < n; ++d) contrast_.allowed(p)[d] = limit[steering_.list()[d]] / unit_;
  }
}

double AllowedErrors::geometry_share(int source, const LabelSpread& spread) const {
  if (values_.only[source] != LatticeValues::kMixed && spread.constant(values_.only[source])) return 1.0;
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const std::uint32_t* labels = &values_.labels[lattice_.first_vertex(source)];
  const auto allowed = contrast_.allowed(source);
  std::uint32_t known = kNoLabel;
  for (int j = 0; j <= k; ++j, labels += row)
    for (int i = 0; i <= k; ++i) {
      if (labels[i] == known) continue;
      known = labels[i];
      if (spread.constant(known)) continue;
      for (std::size_t d = 0; d < allowed.size(); ++d)
        if (spread.total(known, steering_.list()[d]) > 0.01 * allowed[d] * allowed[d])
          return kGeometryShareWithPaths;
    }
  return 1.0;
}

double AllowedErrors::border_part(int source, const double* geometry) const {
  const auto allowed = contrast_.allowed(source);
  double worst = 0.0;
  for (std::size_t d = 0; d < allowed.size(); ++d)
    worst = std::max(worst, geometry[d] / (allowed[d] * allowed[d]));
  return worst;
}

double AllowedErrors::border_variance(int source, const LabelSpread& spread) const {
  const double importance = std::max(grid_.relative_weight(source), kLeastImportance);
  return geometry_share(source, spread) / (energy_ * importance * importance);
}

}  // namespace ifov::sampling
