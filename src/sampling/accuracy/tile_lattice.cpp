// The first look at a tile: labels and values at the lattice's vertices, and what follows from them before
// any border is traced.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sampling/accuracy/clutter.h"
#include "sampling/accuracy/tile_work.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed variance that borders may take where paths vary as well.
constexpr double kGeometryShareWithPaths = 0.15;
/// Source pixels that weigh less than this in every output are traced as if they weighed so much.
constexpr double kLeastImportance = 0.02;

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

}  // namespace

void TileWork::trace_lattice() {
  ask_vertices();
  merge_twins();
  look_at_constants();
  take_means();
  spread_ = std::make_unique<LabelSpread>(lattice_, table_, lattice_values_);
  contrast_.spread().resize(table_.size() * problem_.drivers.size());
  for (std::size_t l = 0; l < table_.size(); ++l)
    for (std::size_t d = 0; d < problem_.drivers.size(); ++d)
      contrast_.spread()[l * problem_.drivers.size() + d] =
          spread_->local(static_cast<std::uint32_t>(l), problem_.drivers[d]);
  set_limits();
  const double energy = footprint_energy(*problem_.footprint);
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    const double importance = std::max(relative_weight(p), kLeastImportance);
    tracer_.allowed_variance()[p] = geometry_share(p) / (energy * importance * importance);
  }
  tracer_.plant(lattice_values_.labels);
}

void TileWork::ask_vertices() {
  struct Column {
    double x_px;
    std::uint64_t key;
  };
  std::vector<Column> columns;
  for (int i = 0; i <= lattice_.columns(); ++i) {
    const std::int32_t x = i * Lattice::side(0);
    columns.push_back({lattice_.x_px(x), hash(problem_.seed, lattice_.image_x(x))});
  }
  const std::size_t row = columns.size(), stride = static_cast<std::size_t>(ledger_.field().stride());
  const std::size_t vertices = row * (static_cast<std::size_t>(lattice_.rows()) + 1);
  // Some rows at a time, so that requests and answers are still in the cache when they are worked on.
  const int rows_at_once = static_cast<int>(std::max<std::size_t>(1, RayLedger::kBatch / row));
  lattice_values_.columns = static_cast<std::size_t>(columns_);
  lattice_values_.labels.reserve(vertices);
  lattice_values_.values.resize(vertices * lattice_values_.columns);
  float* kept = lattice_values_.values.data();
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> labels;
  std::vector<float> values;
  for (int first = 0; first <= lattice_.rows(); first += rows_at_once) {
    const int last = std::min(first + rows_at_once, lattice_.rows() + 1);
    requests.resize(static_cast<std::size_t>(last - first) * row);
    PathRequest* request = requests.data();
    for (int j = first; j < last; ++j) {
      const std::int32_t y = j * Lattice::side(0);
      const double y_px = lattice_.y_px(y);
      const std::int64_t image_y = lattice_.image_y(y);
      for (const Column& column : columns)
        *request++ = {{column.x_px, y_px}, extend(column.key, image_y, 0x766572), 0};
    }
    values.resize(requests.size() * stride);
    ledger_.first_values(requests, labels, values);
    lattice_values_.labels.insert(lattice_values_.labels.end(), labels.begin(), labels.end());
    for (std::size_t v = 0; v < labels.size(); ++v) kept = std::copy_n(&values[v * stride], columns_, kept);
  }
}

/// Labels of one material whose values at all vertices are the same to the last bit (black things at one
/// temperature, level ground under the Sun) are one label: no radiance tells them apart, and a border between
/// them would cost rays for nothing.
void TileWork::merge_twins() {
  LatticeValues& at = lattice_values_;
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> first(table_.size(), kNone);
  at.constant.assign(table_.size(), 1);
  for (std::uint32_t label = 0; label < table_.size(); ++label)
    if (ledger_.field().uneven(table_.label(label))) at.constant[label] = 0;
  const auto same = [&](std::size_t v, std::size_t w) {
    return std::equal(at.value(v), at.value(v) + at.columns, at.value(w));
  };
  for (std::size_t v = 0; v < at.labels.size(); ++v) {
    const std::uint32_t label = at.labels[v];
    if (first[label] == kNone)
      first[label] = v;
    else if (at.constant[label] && !same(v, first[label]))
      at.constant[label] = 0;
  }
  std::multimap<std::pair<std::uint32_t, float>, std::uint32_t> kept;  // by material and first column
  bool any = false;
  for (std::uint32_t label = 0; label < table_.size(); ++label) {
    if (!at.constant[label] || first[label] == kNone) continue;
    const std::pair<std::uint32_t, float> key{ledger_.field().material_of(table_.label(label)),
                                              at.value(first[label])[0]};
    const auto [begin, end] = kept.equal_range(key);
    const auto twin =
        std::find_if(begin, end, [&](const auto& e) { return same(first[e.second], first[label]); });
    if (twin == end) {
      kept.emplace(key, label);
    } else {
      table_.merge(label, twin->second);
      any = true;
    }
  }
  if (!any) return;
  at.own = at.labels;
  for (std::uint32_t& label : at.labels) label = table_.merged(label);
}

/// Means of the labels, and which pixels show one label alone.
void TileWork::take_means() {
  LatticeValues& at = lattice_values_;
  struct Seen {
    std::size_t first = 0;
    std::uint32_t times = 0;
  };
  std::vector<Seen> seen(table_.size());
  for (std::size_t v = 0; v < at.labels.size(); ++v) {
    const std::uint32_t label = at.labels[v];
    if (!at.constant[label])
      table_.add(label, at.value(v));
    else if (seen[label].times++ == 0)
      seen[label].first = v;
  }
  for (std::uint32_t label = 0; label < seen.size(); ++label)
    table_.add_same(label, at.value(seen[label].first), seen[label].times);
  for (std::size_t i = 0; i < at.look.labels.size(); ++i)
    if (!at.constant[at.look.labels[i]]) table_.add(at.look.labels[i], at.look.value(i, at.columns));

  at.only.resize(static_cast<std::size_t>(lattice_.domain().count()));
  const int k = lattice_.cells_per_pixel();
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    const std::uint32_t* labels = &at.labels[first_vertex(p)];
    const std::uint32_t label = labels[0];
    std::uint32_t unlike = 0;
    for (int j = 0; j <= k; ++j, labels += lattice_.columns() + 1)
      for (int i = 0; i <= k; ++i) unlike |= labels[i] ^ label;
    at.only[p] = unlike == 0 ? label : LatticeValues::kMixed;
  }
}

/// Limits from the means over the lattice, seen through the footprint.
void TileWork::set_limits() {
  const PixelRect& d = lattice_.domain();
  const std::size_t columns = static_cast<std::size_t>(columns_), drivers = problem_.drivers.size(),
                    row = static_cast<std::size_t>(lattice_.columns()) + 1;
  const int k = lattice_.cells_per_pixel();
  std::vector<double> vertex_weight;
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i)
      vertex_weight.push_back((i == 0 || i == k ? 0.5 : 1.0) * (j == 0 || j == k ? 0.5 : 1.0) / (k * k));
  std::vector<double> source_mean(static_cast<std::size_t>(d.count()) * columns, 0.0);
  int flat = -1;  // the last pixel of one value
  for (int p = 0; p < d.count(); ++p) {
    double* mean = &source_mean[p * columns];
    if (lattice_values_.flat(p)) {
      if (flat >= 0 && lattice_values_.only[flat] == lattice_values_.only[p]) {
        std::copy_n(&source_mean[flat * columns], columns, mean);
        continue;
      }
      flat = p;
    }
    const double* w = vertex_weight.data();
    for (int j = 0; j <= k; ++j) {
      const float* value = lattice_values_.value(first_vertex(p) + j * row);
      for (int i = 0; i <= k; ++i, ++w, value += columns)
        for (std::size_t c = 0; c < columns; ++c) mean[c] += *w * value[c];
    }
  }

  const int reach =
      std::max(0, static_cast<int>(std::ceil(problem_.footprint->half_width_px() - 0.5 - 1e-12)));
  std::vector<double> pixel_weight;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      pixel_weight.push_back(problem_.footprint->integral(dx - 0.5, dy - 0.5, dx + 0.5, dy + 0.5));
  const double unit = stopping_.normal() * foresight();
  std::vector<double> mean(columns), known_mean, limit(columns), allowed(outputs_.size() * drivers);
  for (int o = 0; o < problem_.tile.count(); ++o) {
    std::fill(mean.begin(), mean.end(), 0.0);
    const int source = source_of(o);
    const double* w = pixel_weight.data();
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx, ++w) {
        const double* from = &source_mean[static_cast<std::size_t>(source + dy * d.width() + dx) * columns];
        for (std::size_t c = 0; c < columns; ++c) mean[c] += *w * from[c];
      }
    if (mean != known_mean) {
      problem_.tolerance->limits(mean, limit);
      known_mean = mean;
    }
    for (std::size_t n = 0; n < drivers; ++n) allowed[o * drivers + n] = limit[problem_.drivers[n]] / unit;
  }
  for (int p = 0; p < d.count(); ++p)
    std::copy_n(&allowed[nearest_output(p) * drivers], drivers, contrast_.allowed(p).begin());
}

/// All of the variance may come from borders where every label looks the same everywhere.
double TileWork::geometry_share(int source) const {
  if (lattice_values_.only[source] != LatticeValues::kMixed &&
      spread_->constant(lattice_values_.only[source]))
    return 1.0;
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const std::uint32_t* labels = &lattice_values_.labels[first_vertex(source)];
  const auto allowed = contrast_.allowed(source);
  std::uint32_t known = EdgeTracer::kNoLabel;
  for (int j = 0; j <= k; ++j, labels += row)
    for (int i = 0; i <= k; ++i) {
      if (labels[i] == known) continue;
      known = labels[i];
      if (spread_->constant(known)) continue;
      for (std::size_t d = 0; d < problem_.drivers.size(); ++d)
        if (spread_->total(known, problem_.drivers[d]) > 0.01 * allowed[d] * allowed[d])
          return kGeometryShareWithPaths;
    }
  return 1.0;
}

void TileWork::switch_clutter() {
  const PixelRect& d = lattice_.domain();
  if (options_.seeds) ledger_.field().known_detail({d.x0, d.y0, d.x1, d.y1}, known_);
  if (!options_.clutter_switch) return;
  for (std::size_t p = 0; p < known_.full.size(); ++p)
    if (known_.full[p]) tracer_.abandon(static_cast<std::uint32_t>(p));
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    if (lattice_values_.only[p] != LatticeValues::kMixed) continue;
    const std::uint32_t* labels = &lattice_values_.labels[first_vertex(p)];
    double crossings = 0.0, squares = 0.0;
    const auto look = [&](std::uint32_t a, std::uint32_t b) {
      if (a == b) return;
      const double contrast = contrast_(static_cast<std::uint32_t>(p), a, b);
      crossings += 1.0;
      squares += contrast * contrast;
    };
    for (int j = 0; j <= k; ++j, labels += row)
      for (int i = 0; i <= k; ++i) {
        if (i < k) look(labels[i], labels[i + 1]);
        if (j < k) look(labels[i], labels[i + row]);
      }
    // In allowed standard errors of this pixel, which counts only in part in each output.
    const double whole = tracer_.allowed_variance()[p] / geometry_share(p);
    const double contrast = std::sqrt(squares / (crossings * whole)),
                 border_px = crossings / crossings_per_length(k);
    const double strata = stratified_cost(contrast, border_px);
    if (kTracingCostPerCrossing * crossings > std::max(clutter_to_come(p, strata), kFewestStratified))
      tracer_.abandon(static_cast<std::uint32_t>(p));
    predicted_[p] = static_cast<float>(strata);
    const double patience = kPatience * stratified_cost(contrast, std::max(border_px, kLeastBorder_px));
    std::uint32_t& budget = tracer_.budget()[p];
    budget = static_cast<std::uint32_t>(std::min<double>(budget, std::max(patience, kFewestTraced)));
  }
}

}  // namespace ifov::sampling
