#include "sampling/accuracy/tile_work.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sampling/accuracy/clutter.h"
#include "sampling/accuracy/source_domain.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed variance that borders may take where paths vary as well.
constexpr double kGeometryShareWithPaths = 0.15;
/// The first run of a tile that is kept traces borders, and tells clutter, for an error this much smaller: rays that look
/// beside a border are of no use where it is known better, nor are values of clutter in a pixel that is traced.
constexpr double kForesight = 2.0;
/// Source pixels that weigh less than this in every output are traced as if they weighed so much.
constexpr double kLeastImportance = 0.02;
/// Source pixels that weigh less than this are not probed.
constexpr double kLeastProbed = 0.4;
/// A footprint's outermost pixels, where they weigh less than this, need no others around them to be traced
/// well enough.
constexpr double kNegligibleRim = 1e-3;

/// Pixels around those that the footprints reach.
int halo_of(const PixelFootprint& footprint) {
  const double rim = std::ceil(footprint.half_width_px() - 0.5 - 1e-12);
  const double weight = footprint.integral(rim - 0.5, -0.5, rim + 0.5, 0.5);
  return weight < kNegligibleRim * footprint.integral(-0.5, -0.5, 0.5, 0.5) ? 0 : 1;
}

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

std::optional<TileMemory> memory_of(const TileProblem& problem, int columns) {
  if (problem.before != nullptr) return TileMemory(static_cast<std::size_t>(columns), problem.before->memory);
  if (problem.keep_memory) return TileMemory(static_cast<std::size_t>(columns));
  return std::nullopt;
}

}  // namespace

TileWork::TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
                   const AccuracyFaults& faults, TileResult& result)
    : problem_(problem),
      options_(options),
      result_(result),
      columns_(field.columns()),
      stopping_(problem.tolerance->confidence()),
      lattice_(source_domain(problem, halo_of(*problem.footprint)), options.lattice),
      table_(columns_),
      memory_(memory_of(problem, columns_)),
      ledger_(field, problem, lattice_, table_, faults, memory_ ? &*memory_ : nullptr),
      contrast_(table_, problem.drivers, lattice_.domain().count()),
      tracer_(lattice_, ledger_, table_, contrast_, options, faults, problem.seed),
      prober_(tracer_, ledger_, options, problem.seed),
      all_columns_(static_cast<std::size_t>(columns_)),
      outputs_(static_cast<std::size_t>(problem.tile.count())),
      sums_(outputs_.size()),
      predicted_(static_cast<std::size_t>(lattice_.domain().count()), 0.0f),
      clutter_rounds_(predicted_.size()),
      faults_(faults) {
  std::iota(all_columns_.begin(), all_columns_.end(), 0);
  result_.reset(problem.tile, columns_);
  if (memory_)
    for (std::size_t o = 0; o < memory_->looks_before().size() && o < outputs_.size(); ++o) {
      outputs_[o].look = memory_->looks_before()[o];
      outputs_[o].last_look += outputs_[o].look;
    }
}

int TileWork::nearest_output(int source) const {
  const PixelRect &d = lattice_.domain(), &t = problem_.tile;
  const int x = std::clamp(d.x0 + source % d.width(), t.x0, t.x1 - 1) - t.x0;
  const int y = std::clamp(d.y0 + source / d.width(), t.y0, t.y1 - 1) - t.y0;
  return y * t.width() + x;
}

int TileWork::source_of(int output) const {
  const PixelRect &d = lattice_.domain(), &t = problem_.tile;
  return (t.y0 + output / t.width() - d.y0) * d.width() + t.x0 + output % t.width() - d.x0;
}

/// Weight of a source pixel in the output where it weighs most, relative to that of the output's own pixel.
double TileWork::relative_weight(int source) const {
  const PixelRect &d = lattice_.domain(), &t = problem_.tile;
  const int x = d.x0 + source % d.width(), y = d.y0 + source / d.width();
  const double dx = x - std::clamp(x, t.x0, t.x1 - 1), dy = y - std::clamp(y, t.y0, t.y1 - 1);
  return problem_.footprint->integral(dx - 0.5, dy - 0.5, dx + 0.5, dy + 0.5) /
         problem_.footprint->integral(-0.5, -0.5, 0.5, 0.5);
}

void TileWork::trace_lattice() {
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
  lattice_values_.stride = stride;
  lattice_values_.labels.resize(vertices);
  lattice_values_.values.resize(vertices * stride);
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> labels;
  for (int first = 0; first <= lattice_.rows(); first += rows_at_once) {
    requests.clear();
    for (int j = first; j <= std::min(first + rows_at_once - 1, lattice_.rows()); ++j) {
      const std::int32_t y = j * Lattice::side(0);
      const double y_px = lattice_.y_px(y);
      const std::int64_t image_y = lattice_.image_y(y);
      for (const Column& column : columns)
        requests.push_back({{column.x_px, y_px}, extend(column.key, image_y, 0x766572), 0});
    }
    const std::size_t v = static_cast<std::size_t>(first) * row;
    ledger_.first_values(requests, labels,
                   std::span<float>(lattice_values_.values).subspan(v * stride, requests.size() * stride));
    std::copy(labels.begin(), labels.end(), lattice_values_.labels.begin() + static_cast<std::ptrdiff_t>(v));
  }
  merge_twins();
  for (std::size_t v = 0; v < vertices; ++v)
    table_.add(lattice_values_.labels[v], &lattice_values_.values[v * stride]);
  spread_ = std::make_unique<LabelSpread>(lattice_, table_, columns_, lattice_values_.labels,
                                          lattice_values_.values, lattice_values_.stride);
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

/// Labels of one material whose values at all vertices are the same to the last bit (black things at one
/// temperature, level ground under the Sun) are one label: no radiance tells them apart, and a border between
/// them would cost rays for nothing.
void TileWork::merge_twins() {
  const std::size_t stride = lattice_values_.stride, columns = static_cast<std::size_t>(columns_);
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> first(table_.size(), kNone);
  std::vector<std::uint8_t> constant(table_.size(), 1);
  const auto same = [&](std::size_t v, std::size_t w) {
    return std::equal(&lattice_values_.values[v * stride], &lattice_values_.values[v * stride] + columns,
                      &lattice_values_.values[w * stride]);
  };
  for (std::size_t v = 0; v < lattice_values_.labels.size(); ++v) {
    const std::uint32_t label = lattice_values_.labels[v];
    if (first[label] == kNone)
      first[label] = v;
    else if (constant[label] && !same(v, first[label]))
      constant[label] = 0;
  }
  std::multimap<std::pair<std::uint32_t, float>, std::uint32_t> kept;  // by material and first column
  for (std::uint32_t label = 0; label < table_.size(); ++label) {
    if (!constant[label] || first[label] == kNone) continue;
    const std::pair<std::uint32_t, float> key{ledger_.field().material_of(table_.label(label)),
                                              lattice_values_.values[first[label] * stride]};
    const auto [begin, end] = kept.equal_range(key);
    const auto twin =
        std::find_if(begin, end, [&](const auto& e) { return same(first[e.second], first[label]); });
    if (twin == end)
      kept.emplace(key, label);
    else
      table_.merge(label, twin->second);
  }
  for (std::uint32_t& label : lattice_values_.labels) label = table_.merged(label);
}

/// Limits from the means over the lattice, seen through the footprint.
void TileWork::set_limits() {
  const PixelRect& d = lattice_.domain();
  const std::size_t columns = static_cast<std::size_t>(columns_),
                    row = static_cast<std::size_t>(lattice_.columns()) + 1;
  const int k = lattice_.cells_per_pixel();
  const int reach =
      std::max(0, static_cast<int>(std::ceil(problem_.footprint->half_width_px() - 0.5 - 1e-12)));
  std::vector<double> source_mean(static_cast<std::size_t>(d.count()) * columns, 0.0);
  for (int p = 0; p < d.count(); ++p)
    for (int j = 0; j <= k; ++j)
      for (int i = 0; i <= k; ++i) {
        const double w = (i == 0 || i == k ? 0.5 : 1.0) * (j == 0 || j == k ? 0.5 : 1.0) / (k * k);
        const std::size_t v = static_cast<std::size_t>(p / d.width() * k + j) * row + p % d.width() * k + i;
        for (std::size_t c = 0; c < columns; ++c)
          source_mean[p * columns + c] += w * lattice_values_.values[v * lattice_values_.stride + c];
      }
  const double foresight = problem_.keep_memory && problem_.before == nullptr ? kForesight : 1.0;
  std::vector<double> mean(columns), limit(columns), allowed(outputs_.size() * problem_.drivers.size());
  for (int o = 0; o < problem_.tile.count(); ++o) {
    std::fill(mean.begin(), mean.end(), 0.0);
    const int source = source_of(o);
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const double w = problem_.footprint->integral(dx - 0.5, dy - 0.5, dx + 0.5, dy + 0.5);
        const double* from = &source_mean[static_cast<std::size_t>(source + dy * d.width() + dx) * columns];
        for (std::size_t c = 0; c < columns; ++c) mean[c] += w * from[c];
      }
    problem_.tolerance->limits(mean, limit);
    for (std::size_t n = 0; n < problem_.drivers.size(); ++n)
      allowed[o * problem_.drivers.size() + n] = limit[problem_.drivers[n]] / (stopping_.normal() * foresight);
  }
  for (int p = 0; p < d.count(); ++p)
    std::copy_n(&allowed[nearest_output(p) * problem_.drivers.size()], problem_.drivers.size(),
                contrast_.allowed(p).begin());
}

/// All of the variance may come from borders where every label looks the same everywhere.
double TileWork::geometry_share(int source) const {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  const int x = source % lattice_.domain().width() * k, y = source / lattice_.domain().width() * k;
  const auto allowed = contrast_.allowed(source);
  std::uint32_t known = EdgeTracer::kNoLabel;
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::uint32_t label = lattice_values_.labels[static_cast<std::size_t>(y + j) * row + x + i];
      if (label == known) continue;
      known = label;
      for (std::size_t d = 0; d < problem_.drivers.size(); ++d)
        if (spread_->total(label, problem_.drivers[d]) > 0.01 * allowed[d] * allowed[d])
          return kGeometryShareWithPaths;
    }
  return 1.0;
}

void TileWork::switch_clutter() {
  if (!options_.clutter_switch) return;
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    const int x = p % lattice_.domain().width() * k, y = p / lattice_.domain().width() * k;
    const auto label = [&](int i, int j) {
      return lattice_values_.labels[static_cast<std::size_t>(y + j) * row + x + i];
    };
    double crossings = 0.0, squares = 0.0;
    const auto look = [&](std::uint32_t a, std::uint32_t b) {
      if (a == b) return;
      const double contrast = contrast_(static_cast<std::uint32_t>(p), a, b);
      crossings += 1.0;
      squares += contrast * contrast;
    };
    for (int j = 0; j <= k; ++j)
      for (int i = 0; i <= k; ++i) {
        if (i < k) look(label(i, j), label(i + 1, j));
        if (j < k) look(label(i, j), label(i, j + 1));
      }
    if (crossings == 0.0) continue;
    const double contrast = std::sqrt(squares / crossings), border_px = crossings / crossings_per_length(k);
    const double strata = stratified_cost(contrast, border_px);
    if (kTracingCostPerCrossing * crossings > std::max(clutter_to_come(p, strata), kFewestStratified))
      tracer_.abandon(static_cast<std::uint32_t>(p));
    predicted_[p] = static_cast<float>(strata);
    const double patience = kPatience * stratified_cost(contrast, std::max(border_px, kLeastBorder_px));
    std::uint32_t& budget = tracer_.budget()[p];
    budget = static_cast<std::uint32_t>(std::min<double>(budget, std::max(patience, kFewestTraced)));
  }
}

void TileWork::trace_borders() {
  tracer_.settle();
  if (options_.seeds) prober_.follow_seeds(problem_.seeds, problem_.seed_objects);
  std::vector<std::uint8_t> worth(static_cast<std::size_t>(lattice_.domain().count()));
  for (std::size_t p = 0; p < worth.size(); ++p)
    worth[p] = relative_weight(static_cast<int>(p)) > kLeastProbed;
  prober_.probe_until_clean(worth);
  tighten_borders();
}

/// Contrasts that steered the tracer are those of the tile; a pixel may differ. Borders are made more precise
/// where the pixel's own strata say so.
void TileWork::tighten_borders() {
  const std::size_t n = problem_.drivers.size();
  for (int pass = 0; pass < 4; ++pass) {
    const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
    if (radiance_ == nullptr || !radiance_->refresh(integrator)) {
      radiance_ = std::make_unique<Radiance>(tracer_, ledger_, table_, *spread_, lattice_values_, faults_,
                                             problem_.seed, !integrator.unit_box());
      for (int p = 0; p < lattice_.domain().count(); ++p) radiance_->add_pixel(p, integrator);
    }
    tracer_.forget_changes();
    std::vector<Sums>& sums = sums_;
    for (Sums& s : sums) s.clear(n);
    gather(integrator, problem_.drivers, sums);
    bool any = false;
    std::vector<double> factor(tracer_.allowed_variance().size(), 1.0);
    for (const Radiance::Pixel& pixel : radiance_->pixels())
      for (int output : pixel.model.outputs) {
        const auto allowed = contrast_.allowed(source_of(output));
        double worst = 0.0;
        for (std::size_t d = 0; d < n; ++d)
          worst = std::max(worst, sums[output].geometry[d] / (allowed[d] * allowed[d]));
        const double share = geometry_share(source_of(output));
        if (worst > 1.02 * share) factor[pixel.source] = std::max(factor[pixel.source], 1.1 * worst / share);
      }
    for (std::size_t p = 0; p < factor.size(); ++p)
      if (factor[p] > 1.0 && !tracer_.abandoned(static_cast<std::uint32_t>(p)) &&
          ledger_.spent(static_cast<int>(p)) < options_.max_samples_per_pixel) {
        tracer_.allowed_variance()[p] /= std::min(factor[p], 16.0);
        any = true;
      }
    if (!any) return;
    tracer_.settle();
  }
  const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
  if (!radiance_->refresh(integrator)) radiance_.reset();
}

}  // namespace ifov::sampling
