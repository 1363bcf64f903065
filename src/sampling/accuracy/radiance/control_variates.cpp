#include "sampling/accuracy/radiance/control_variates.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/mapped_surface.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

namespace {

/// It is taken up in a column where it leaves no more than this of the variance of the lattice's values.
constexpr double kLeaves = 0.7;
/// So many vertices tell how light depends on the reflectance; fewer, that it is proportional to it.
constexpr double kManyVertices = 32.0;
/// A line is taken in place of a proportion where it leaves no more than this of the variance that that leaves.
constexpr double kBetter = 0.9;

}  // namespace

struct ControlVariates::Sums {
  double count = 0.0;
  std::vector<double> r, rr, y, ry, yy;
};

ControlVariates::ControlVariates(Field& field, const Lattice& lattice, const LabelTable& table,
                                 std::uint64_t seed)
    : field_(field),
      lattice_(lattice),
      table_(table),
      seed_(seed),
      columns_(static_cast<std::size_t>(field.columns())),
      stride_(static_cast<std::size_t>(field.stride())) {
  for (std::size_t c = 0; c < columns_; ++c)
    leaders_.push_back(static_cast<std::size_t>(field.leader(static_cast<int>(c))));
}

ControlVariates::~ControlVariates() = default;

FocalPoint ControlVariates::place(const FocalPoint& point) const { return point; }

const MappedSurface* ControlVariates::surface(int source, std::uint32_t label) const {
  const auto found = surfaces_.find(key(source, label));
  return found == surfaces_.end() ? nullptr : found->second.surface.get();
}

/// The pixel whose surface foretells the value of a vertex, which stands on the rim of up to four.
int ControlVariates::owner(std::size_t vertex) const {
  const auto row = static_cast<std::size_t>(lattice_.columns()) + 1;
  const int k = lattice_.cells_per_pixel(), width = lattice_.domain().width(),
            height = lattice_.domain().height();
  const int x = std::min(static_cast<int>(vertex % row) / k, width - 1),
            y = std::min(static_cast<int>(vertex / row) / k, height - 1);
  return y * width + x;
}

void ControlVariates::fit(LatticeValues& values, LabelSpread& spread, const InverseSquares& allowed) {
  std::vector<std::uint8_t> wanted = worth(values, spread, allowed);
  if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end()) return;
  find_surfaces(values, wanted);
  if (surfaces_.empty()) return;
  fit_labels(values, wanted.size());
  take_rests(values);
  take_spread(values, spread);
  if (!drop_useless(spread, wanted)) return;
  take_rests(values);
  if (!surfaces_.empty()) take_spread(values, spread);
}

/// Labels whose values differ so much that strata of a whole pixel take many.
std::vector<std::uint8_t> ControlVariates::worth(const LatticeValues& values, const LabelSpread& spread,
                                                 const InverseSquares& allowed) const {
  const std::size_t labels = values.constant.size();
  std::vector<double> needed(labels, 0.0), count(labels, 0.0);
  for (std::size_t v = 0; v < values.labels.size(); ++v) {
    const std::uint32_t label = values.labels[v];
    if (spread.constant(label) || values.constant[label] != 0) continue;
    const std::span<const double> inverse = allowed(owner(v));
    double most = 0.0;
    for (std::size_t c = 0; c < columns_; ++c)
      most = std::max(most, spread.local(label, static_cast<int>(c)) * inverse[c]);
    needed[label] += most;
    count[label] += 1.0;
  }
  std::vector<std::uint8_t> wanted(labels);
  for (std::size_t l = 0; l < labels; ++l) wanted[l] = needed[l] > kWorthValues * count[l];
  return wanted;
}

/// Of each pixel and label wanted, about the vertex nearest to the pixel's middle; clears `wanted` where there are none.
void ControlVariates::find_surfaces(const LatticeValues& values, std::vector<std::uint8_t>& wanted) {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  struct Nearest {
    std::uint32_t label;
    int distance;
    std::size_t vertex;
  };
  std::vector<Nearest> nearest;
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    nearest.clear();
    for (int j = 0; j <= k; ++j)
      for (int i = 0; i <= k; ++i) {
        const std::size_t v = lattice_.first_vertex(p) + static_cast<std::size_t>(j * row + i);
        const std::uint32_t label = values.labels[v];
        if (wanted[label] == 0) continue;
        const int distance = (2 * i - k) * (2 * i - k) + (2 * j - k) * (2 * j - k);
        const auto known =
            std::find_if(nearest.begin(), nearest.end(), [&](const Nearest& n) { return n.label == label; });
        if (known == nearest.end())
          nearest.push_back({label, distance, v});
        else if (distance < known->distance)
          *known = {label, distance, v};
      }
    for (const Nearest& n : nearest) {
      if (wanted[n.label] == 0) continue;
      std::unique_ptr<const MappedSurface> surface =
          field_.mapped_surface(table_.label(n.label), lattice_.vertex_point(n.vertex));
      if (surface != nullptr)
        surfaces_[key(p, n.label)] = {std::move(surface), n.label};
      else
        wanted[n.label] = 0;
    }
  }
  for (auto s = surfaces_.begin(); s != surfaces_.end();)
    s = wanted[s->second.label] == 0 ? surfaces_.erase(s) : std::next(s);
}

/// By the values of all vertices of a label: light in proportion to the reflectance, or a line where that fits better.
void ControlVariates::fit_labels(const LatticeValues& values, std::size_t labels) {
  std::vector<Sums> sums(labels);
  own_.resize(stride_);
  reflectance_.resize(stride_);
  for (std::size_t v = 0; v < values.labels.size(); ++v) {
    const std::uint32_t label = values.labels[v];
    const MappedSurface* known = surface(owner(v), label);
    if (known == nullptr) continue;
    const FocalPoint point = lattice_.vertex_point(v);
    known->look_up({&point, 1}, own_, reflectance_);
    Sums& sum = sums[label];
    for (std::vector<double>* row : {&sum.r, &sum.rr, &sum.y, &sum.ry, &sum.yy}) row->resize(columns_, 0.0);
    sum.count += 1.0;
    const float* value = values.value(v);
    for (std::size_t c = 0; c < columns_; ++c) {
      const double r = reflectance_[c], y = static_cast<double>(value[c]) - own_[c];
      sum.r[c] += r;
      sum.rr[c] += r * r;
      sum.y[c] += y;
      sum.ry[c] += r * y;
      sum.yy[c] += y * y;
    }
  }
  fits_.resize(labels);
  for (std::size_t l = 0; l < labels; ++l) {
    const Sums& sum = sums[l];
    const double n = sum.count;
    if (n == 0.0) continue;
    Fit& fit = fits_[l];
    fit.slope.assign(columns_, 0.0f);
    fit.constant.assign(columns_, 0.0f);
    fit.on.assign(columns_, 1);
    std::vector<std::uint8_t> line(columns_, 0);  // a line is taken
    for (std::size_t c = 0; c < columns_; ++c) {
      double slope = 0.0, constant = sum.y[c] / n;
      if (sum.r[c] > 0.0) {
        slope = sum.y[c] / sum.r[c];
        constant = 0.0;
        const double left = sum.yy[c] - 2.0 * slope * sum.ry[c] + slope * slope * sum.rr[c];
        const double variance = sum.rr[c] - sum.r[c] * sum.r[c] / n,
                     covariance = sum.ry[c] - sum.r[c] * sum.y[c] / n,
                     of_line = sum.yy[c] - sum.y[c] * sum.y[c] / n -
                               (variance > 0.0 ? covariance * covariance / variance : 0.0);
        line[c] = leaders_[c] == c
                      ? n >= kManyVertices && variance > 1e-9 * sum.rr[c] && of_line < kBetter * left
                      : line[leaders_[c]];
        if (line[c] != 0) {
          slope = covariance / variance;
          constant = (sum.y[c] - slope * sum.r[c]) / n;
        }
      }
      fit.slope[c] = static_cast<float>(slope);
      fit.constant[c] = static_cast<float>(constant);
    }
  }
}

void ControlVariates::foretell(const MappedSurface& surface, std::uint32_t label,
                               std::span<const FocalPoint> points, std::span<float> rows) const {
  reflectance_.resize(points.size() * stride_);
  surface.look_up(points, rows, reflectance_);
  const Fit& fit = fits_[label];
  for (std::size_t i = 0; i < points.size(); ++i) {
    float* row = &rows[i * stride_];
    const float* reflectance = &reflectance_[i * stride_];
    for (std::size_t c = 0; c < columns_; ++c)
      row[c] = fit.on[c] != 0 ? row[c] + fit.slope[c] * reflectance[c] + fit.constant[c] : 0.0f;
    std::fill(row + columns_, row + stride_, 0.0f);
  }
}

void ControlVariates::foretell(const SourcePixel& pixel, const Stratum& stratum,
                               std::span<const FocalPoint> points, std::span<float> rows) const {
  foretell(*surface(pixel.source, stratum.label), stratum.label, points, rows);
}

void ControlVariates::take_rests(LatticeValues& values) const {
  values.rest.clear();
  if (surfaces_.empty()) return;
  values.rest = values.values;
  std::vector<float> row(stride_);
  for (std::size_t v = 0; v < values.labels.size(); ++v) {
    const MappedSurface* known = surface(owner(v), values.labels[v]);
    if (known == nullptr) continue;
    const FocalPoint point = lattice_.vertex_point(v);
    foretell(*known, values.labels[v], {&point, 1}, row);
    for (std::size_t c = 0; c < columns_; ++c) values.rest[v * columns_ + c] -= row[c];
  }
}

/// How rests differ, as LabelSpread has it of values.
void ControlVariates::take_spread(const LatticeValues& values, LabelSpread& spread) const {
  LabelTable table(static_cast<int>(columns_));
  // Labels that first values met since are no better known than all together.
  for (std::uint32_t label = 0; label < values.constant.size(); ++label) table.index(table_.label(label));
  LatticeValues rests = values;
  rests.values.swap(rests.rest);
  std::vector<float> row(stride_);
  for (std::size_t i = 0; i < rests.random.labels.size(); ++i) {
    const FocalPoint point = rests.random.points[i];
    const std::uint32_t label = rests.random.labels[i];
    const MappedSurface* known = surface(lattice_.pixel_at(point), label);
    if (known == nullptr) continue;
    foretell(*known, label, {&point, 1}, row);
    for (std::size_t c = 0; c < columns_; ++c) rests.random.values[i * columns_ + c] -= row[c];
  }
  for (std::size_t v = 0; v < rests.labels.size(); ++v) table.add(rests.labels[v], rests.value(v));
  for (std::size_t i = 0; i < rests.random.labels.size(); ++i)
    table.add(rests.random.labels[i], rests.random.value(i, columns_));
  spread.take_rest(std::make_unique<LabelSpread>(lattice_, table, rests));
}

/// Leaves out columns whose rests differ hardly less than their values, and labels of which no column is left. True where
/// something was left out.
bool ControlVariates::drop_useless(const LabelSpread& spread, const std::vector<std::uint8_t>& wanted) {
  bool any = false;
  std::vector<std::uint8_t> kept(wanted.size(), 0);
  for (std::uint32_t l = 0; l < wanted.size(); ++l) {
    if (wanted[l] == 0 || fits_[l].on.empty()) continue;
    // Few blocks of the lattice say nothing; what all of its vertices differ by from their mean does.
    constexpr double kTelling = 8.0;
    const bool local = spread.blocks(l) >= kTelling;
    for (std::size_t c = 0; c < columns_; ++c) {
      if (leaders_[c] != c) {
        fits_[l].on[c] = fits_[l].on[leaders_[c]];
        continue;
      }
      const int column = static_cast<int>(c);
      const double before = local ? spread.local(l, column) : spread.total(l, column),
                   after = local ? spread.rest().local(l, column) : spread.rest().total(l, column);
      if (after < kLeaves * before) {
        kept[l] = 1;
        continue;
      }
      any = any || before > 0.0;
      fits_[l].on[c] = 0;
    }
    any = any || kept[l] == 0;
  }
  for (auto s = surfaces_.begin(); s != surfaces_.end();)
    s = kept[s->second.label] == 0 ? surfaces_.erase(s) : std::next(s);
  return any;
}

}  // namespace ifov::sampling
