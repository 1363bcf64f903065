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
/// Source pixels that weigh less than this in every output are traced as if they weighed so much, and those
/// below twice of it are not probed.
constexpr double kLeastImportance = 0.2;
/// A pilot round draws about this many values per pixel, and at least a few per stratum.
constexpr double kPilot = 16.0, kFewest = 4.0;
/// Planned rounds aim a little beyond the limit, because variances are estimates.
constexpr double kMargin = 1.15;
/// After a pilot, a stratum grows at most this many times, until two rounds have told how its variance falls.
constexpr double kFirstGrowth = 12.0;
/// Later rounds grow at most this many times: the finer the grid, the faster texture gets exact.
constexpr double kGrowth = 2.5;
/// From here on replicated nets cost less than jittered values: early where paths make the variance and not
/// texture.
constexpr double kManyPaths = 320.0, kManyValues = 16384.0;

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

TileWork::TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
                   const AccuracyFaults& faults, TileResult& result)
    : problem_(problem),
      options_(options),
      result_(result),
      columns_(field.columns()),
      stopping_(problem.tolerance->confidence()),
      lattice_(source_domain(problem, 1), options.lattice),
      table_(columns_),
      ledger_(field, problem, lattice_, table_, faults),
      contrast_(table_, problem.drivers, lattice_.domain().count()),
      tracer_(lattice_, ledger_, table_, contrast_, options, faults, problem.seed),
      prober_(tracer_, ledger_, options, problem.seed),
      all_columns_(static_cast<std::size_t>(columns_)),
      outputs_(static_cast<std::size_t>(problem.tile.count())),
      sums_(outputs_.size()),
      net_sizes_(static_cast<std::size_t>(lattice_.domain().count()), 0),
      faults_(faults) {
  std::iota(all_columns_.begin(), all_columns_.end(), 0);
  result_.reset(problem.tile, columns_);
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
  std::vector<PathRequest> requests;
  for (int j = 0; j <= lattice_.rows(); ++j)
    for (int i = 0; i <= lattice_.columns(); ++i) {
      const std::int32_t x = i * Lattice::side(0), y = j * Lattice::side(0);
      requests.push_back(
          {lattice_.point(x, y), hash(problem_.seed, lattice_.image_x(x), lattice_.image_y(y), 0x766572), 0});
    }
  lattice_values_.stride = static_cast<std::size_t>(ledger_.field().stride());
  lattice_values_.values.resize(requests.size() * lattice_values_.stride);
  ledger_.values(requests, lattice_values_.labels, lattice_values_.values);
  merge_twins();
  for (std::size_t v = 0; v < requests.size(); ++v)
    table_.add(lattice_values_.labels[v], &lattice_values_.values[v * lattice_values_.stride]);
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
/// temperature, level ground under the Sun) are one label: no radiance tells them apart, and a border between them
/// would cost rays for nothing.
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
    const auto twin = std::find_if(begin, end, [&](const auto& e) { return same(first[e.second], first[label]); });
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
      allowed[o * problem_.drivers.size() + n] = limit[problem_.drivers[n]] / stopping_.normal();
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
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::uint32_t label = lattice_values_.labels[static_cast<std::size_t>(y + j) * row + x + i];
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
    const double strata =
        stratified_cost(std::sqrt(squares / crossings), crossings / crossings_per_length(k));
    if (kTracingCostPerCrossing * crossings > std::max(strata, kFewestStratified))
      tracer_.abandon(static_cast<std::uint32_t>(p));
  }
}

void TileWork::trace_borders() {
  tracer_.settle();
  if (options_.seeds) prober_.follow_seeds(problem_.seeds);
  std::vector<std::uint8_t> worth(static_cast<std::size_t>(lattice_.domain().count()));
  for (std::size_t p = 0; p < worth.size(); ++p)
    worth[p] = relative_weight(static_cast<int>(p)) > 2.0 * kLeastImportance;
  prober_.probe_until_clean(worth);
  tighten_borders();
}

/// Moments per column of one stratum are weighed into every output that its source pixel reaches.
void TileWork::gather(const LeafIntegrator& integrator, std::span<const int> columns,
                      std::vector<Sums>& sums) const {
  const std::size_t n = columns.size();
  std::vector<StratumMoments> moments;
  std::vector<double> net_mean, net_variance, weighted(n);
  for (const Radiance::Pixel& pixel : radiance_->pixels()) {
    const PixelModel& model = pixel.model;
    if (model.outputs.empty()) continue;
    if (pixel.cluttered) {
      for (int output : model.outputs) {
        Sums& sum = sums[output];
        radiance_->nets(pixel, integrator.unit_box() ? nullptr : &integrator.footprint(),
                        integrator.centre(output), columns, net_mean, net_variance);
        const double w = integrator.whole_weight(pixel.source, output);
        for (std::size_t c = 0; c < n; ++c) {
          const double variance = w * w * net_variance[c];
          sum.mean[c] += w * net_mean[c];
          sum.path[c].add(variance, Radiance::kReplicates - 1.0);
          sum.deviation[c] += std::sqrt(variance * Radiance::kReplicates * pixel.net_size);
        }
      }
      continue;
    }
    const std::size_t regions = model.labels.size();
    moments.resize(std::max(moments.size(), regions));
    for (std::size_t r = 0; r < regions; ++r) radiance_->moments(pixel, r, columns, moments[r]);
    for (std::size_t o = 0; o < model.outputs.size(); ++o) {
      Sums& sum = sums[model.outputs[o]];
      for (std::size_t r = 0; r < regions; ++r) {
        const double w = model.weight[o * regions + r];
        if (w == 0.0) continue;
        weighted = moments[r].mean;
        double share = 1.0;
        if (moments[r].sampled)
          share = integrator.unit_box()
                      ? 1.0 / static_cast<double>(pixel.strata[r].count())
                      : radiance_->weigh(pixel, r, integrator.footprint(),
                                         integrator.centre(model.outputs[o]), columns, weighted);
        for (std::size_t c = 0; c < n; ++c) {
          sum.mean[c] += w * weighted[c];
          sum.path[c].add(w * w * moments[r].variance[c] * share, moments[r].freedom);
          sum.deviation[c] += w * std::sqrt(moments[r].variance[c]);
        }
      }
      for (std::size_t b = 0; b < model.borders.size(); ++b) {
        const std::size_t in = model.region_of(model.borders[b].inner),
                          out = model.region_of(model.borders[b].outer);
        const double variance = model.border_variance[o * model.borders.size() + b];
        for (std::size_t c = 0; c < n; ++c) {
          const double step = moments[in].mean[c] - moments[out].mean[c];
          sum.geometry[c] += variance * (step * step + moments[in].variance[c] + moments[out].variance[c]);
        }
      }
      for (std::size_t l = 0; l < model.loose.size(); ++l) {
        const double w = model.loose_weight[o * model.loose.size() + l];
        for (std::size_t c = 0; c < n; ++c) {
          double low = INFINITY, high = -INFINITY, within = 0.0;
          for (std::uint32_t corner : model.loose[l].corner) {
            const StratumMoments& m = moments[model.region_of(corner)];
            low = std::min(low, m.mean[c]);
            high = std::max(high, m.mean[c]);
            within = std::max(within, m.variance[c]);
          }
          sum.geometry[c] += w * w * ((high - low) * (high - low) / 12.0 + within);
        }
      }
    }
  }
}

/// Contrasts that steered the tracer are those of the tile; a pixel may differ. Borders are made more precise
/// where the pixel's own strata say so.
void TileWork::tighten_borders() {
  const std::size_t n = problem_.drivers.size();
  for (int pass = 0; pass < 4; ++pass) {
    const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
    radiance_ = std::make_unique<Radiance>(tracer_, ledger_, table_, *spread_, lattice_values_, faults_,
                                           problem_.seed);
    for (int p = 0; p < lattice_.domain().count(); ++p) radiance_->add_pixel(p, integrator);
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
  radiance_.reset();
}

void TileWork::estimate() {
  const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
  // Pixels of a box footprint are independent of each other: they are finished in groups, so that few values
  // are in memory at a time. A wider footprint ties them together.
  const int sources = lattice_.domain().count();
  const int group =
      integrator.unit_box() ? std::max<int>(64, static_cast<int>(65536 / lattice_values_.stride)) : sources;
  for (int first = 0; first < sources; first += group) {
    const bool ready = group >= sources && radiance_ != nullptr;  // by tighten_borders, of all pixels
    if (!ready) {
      radiance_ = std::make_unique<Radiance>(tracer_, ledger_, table_, *spread_, lattice_values_, faults_,
                                             problem_.seed);
      for (int p = first; p < std::min(sources, first + group); ++p) radiance_->add_pixel(p, integrator);
    }
    std::vector<std::uint8_t> touched(outputs_.size(), 0);
    for (const Radiance::Pixel& pixel : radiance_->pixels())
      for (int o : pixel.model.outputs) touched[o] = 1;
    std::vector<int> outputs;
    for (std::size_t o = 0; o < touched.size(); ++o)
      if (touched[o]) outputs.push_back(static_cast<int>(o));
    steering_.assign(problem_.drivers.begin(), problem_.drivers.end());
    do {
      while (plan_round(integrator, outputs)) radiance_->trace();
    } while (steer_by_more(integrator, outputs));
    finish(integrator, outputs);
  }
}

/// Drivers stand for all columns. Where they are satisfied and another column is not, it steers as well.
bool TileWork::steer_by_more(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = static_cast<std::size_t>(columns_);
  if (steering_.size() == n) return false;
  std::vector<Sums>& sums = sums_;
  for (int o : outputs) sums[o].clear(n);
  gather(integrator, all_columns_, sums);
  std::vector<double> limit(n);
  std::vector<int> more;
  for (int o : outputs) {
    if (outputs_[o].look >= Stopping::kLooks) continue;
    problem_.tolerance->limits(sums[o].mean, limit);
    double worst = 1.0 + 1e-6;
    int column = -1;
    for (std::size_t c = 0; c < n; ++c) {
      const double ratio = half_width(sums[o], c, outputs_[o].look) / limit[c];
      if (ratio > worst && sums[o].path[c].variance() > 0.0) worst = ratio, column = static_cast<int>(c);
    }
    if (column < 0) continue;
    if (std::find(steering_.begin(), steering_.end(), column) != steering_.end()) continue;
    outputs_[o].satisfied = false;
    if (std::find(more.begin(), more.end(), column) == more.end()) more.push_back(column);
  }
  steering_.insert(steering_.end(), more.begin(), more.end());
  return !more.empty();
}

double TileWork::half_width(const Sums& sum, std::size_t column, int look) const {
  const double path = sum.path[column].variance();
  const double t = path > 0.0 ? stopping_.student(look, sum.path[column].degrees_of_freedom()) : 0.0;
  return std::sqrt(stopping_.normal() * stopping_.normal() * sum.geometry[column] + t * t * path);
}

void TileWork::Sums::clear(std::size_t columns) {
  mean.assign(columns, 0.0);
  geometry.assign(columns, 0.0);
  path.assign(columns, {});
  deviation.assign(columns, 0.0);
}

/// Nets grow by doubling, at most fourfold between looks: their error falls faster than that of independent
/// values, by which `wanted` is reckoned.
std::uint32_t TileWork::net_size(const Radiance::Stratum& stratum, double wanted, double room) {
  constexpr double kGain = 8.0;  // about what nets save
  const double most =
      std::max(4.0, (room + static_cast<double>(stratum.count())) / Radiance::kStratumReplicates);
  std::uint32_t size = std::max(4u, stratum.nets.size);
  const double target = stratum.nets.size == 0 ? wanted / kGain / Radiance::kStratumReplicates
                                               : std::min(4.0 * size, wanted / Radiance::kStratumReplicates);
  while (size < target && 2.0 * size <= most) size *= 2;
  return size;
}

/// Looks at the intervals so far and plans values where they are too wide; false when nothing is left to do.
bool TileWork::plan_round(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = steering_.size();
  std::vector<Sums>& sums = sums_;
  bool cluttered_start = false;
  for (std::size_t p = 0; p < radiance_->pixels().size(); ++p) {
    const Radiance::Pixel& pixel = radiance_->pixels()[p];
    if (pixel.cluttered && pixel.net_size == 0 && !pixel.model.outputs.empty()) {
      radiance_->plan_nets(p, 4);
      cluttered_start = true;
    }
  }
  if (cluttered_start) return true;
  for (int o : outputs) sums[o].clear(n);
  gather(integrator, steering_, sums);

  std::vector<double> mean(static_cast<std::size_t>(columns_)), limit(mean.size());
  for (int o : outputs) {
    Output& output = outputs_[o];
    if (output.satisfied) continue;
    for (std::size_t d = 0; d < n; ++d) mean[steering_[d]] = sums[o].mean[d];
    problem_.tolerance->limits(mean, limit);
    output.path_budget.assign(n, 0.0);
    output.satisfied = true;
    for (std::size_t d = 0; d < n; ++d) {
      const double limit_d = limit[steering_[d]];
      const double from_borders = stopping_.normal() * stopping_.normal() * sums[o].geometry[d];
      const bool wide = half_width(sums[o], d, output.look) > limit_d && sums[o].path[d].variance() > 0.0;
      if (wide) output.satisfied = false;
      const double planned_t = stopping_.student(std::max(output.look + 1, 2),
                                                 std::max(sums[o].path[d].degrees_of_freedom(), 20.0));
      output.path_budget[d] =
          std::max(limit_d * limit_d - from_borders, 0.2 * limit_d * limit_d) / (planned_t * planned_t);
      // Few degrees of freedom may keep an interval wide whose variance is small: more values still.
      if (wide) output.path_budget[d] = std::min(output.path_budget[d], 0.7 * sums[o].path[d].variance());
    }
  }

  bool any = false;
  std::vector<std::uint8_t> looked(outputs_.size(), 0);
  StratumMoments moments;
  for (std::size_t p = 0; p < radiance_->pixels().size(); ++p) {
    const Radiance::Pixel& pixel = radiance_->pixels()[p];
    const PixelModel& model = pixel.model;
    const std::uint32_t spent = ledger_.spent(pixel.source);
    if (spent >= options_.max_samples_per_pixel) continue;
    if (std::all_of(model.outputs.begin(), model.outputs.end(), [&](int o) { return outputs_[o].satisfied; }))
      continue;
    const double room = options_.max_samples_per_pixel - spent;
    const std::size_t strata = pixel.cluttered ? 1 : model.labels.size();
    for (std::size_t s = 0; s < strata; ++s) {
      if (!pixel.cluttered) radiance_->moments(pixel, s, steering_, moments);
      double wanted = 0.0;
      for (std::size_t o = 0; o < model.outputs.size(); ++o) {
        const Output& output = outputs_[model.outputs[o]];
        if (output.satisfied || output.look >= Stopping::kLooks) continue;
        const Sums& sum = sums[model.outputs[o]];
        for (std::size_t d = 0; d < n; ++d) {
          double weighted_deviation = 0.0;
          if (pixel.cluttered) {
            weighted_deviation = sum.deviation[d];
          } else {
            weighted_deviation = model.weight[o * strata + s] * std::sqrt(moments.variance[d]);
          }
          wanted = std::max(wanted, weighted_deviation * sum.deviation[d] / output.path_budget[d]);
        }
      }
      if (pixel.cluttered) {
        if (wanted <= Radiance::kReplicates * pixel.net_size) continue;
        std::uint32_t net = pixel.net_size;
        const double per_replicate = std::min(wanted, room) / Radiance::kReplicates;
        while (net < per_replicate && net < 4 * pixel.net_size) net *= 2;
        if (net == pixel.net_size) continue;
        radiance_->plan_nets(p, net);
      } else {
        const Radiance::Stratum& stratum = pixel.strata[s];
        const double have = static_cast<double>(stratum.count());
        if (wanted <= std::max(1.0, have)) continue;
        const bool paths_differ = radiance_->paths_differ(stratum, steering_, moments);
        if (integrator.unit_box() &&
            (stratum.nets.size > 0 || (have > 0.0 && wanted > (paths_differ ? kManyPaths : kManyValues)))) {
          const std::uint32_t size = net_size(stratum, wanted, room);
          if (size == stratum.nets.size) continue;
          radiance_->plan_stratum_nets(p, s, size);
          any = true;
          for (int o : model.outputs) looked[o] = 1;
          continue;
        }
        if (stratum.round_starts.size() >= 2)
          wanted = std::min(radiance_->with_trend(pixel, s, steering_, wanted), kGrowth * have);
        else if (have > 0.0)
          wanted = std::min(wanted, kFirstGrowth * have);
        double more = kMargin * wanted - have;
        if (have == 0.0) more = std::min(std::max(more, kFewest), std::max(kFewest, kPilot * model.area[s]));
        radiance_->plan(p, s, std::min(std::max(more, kFewest), room));
      }
      any = true;
      for (int o : model.outputs) looked[o] = 1;
    }
  }
  for (std::size_t o = 0; o < looked.size(); ++o)
    if (looked[o] && !outputs_[o].satisfied) ++outputs_[o].look;
  return any;
}

void TileWork::finish(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = static_cast<std::size_t>(columns_);
  std::vector<Sums>& sums = sums_;
  for (int o : outputs) sums[o].clear(n);
  gather(integrator, all_columns_, sums);
  std::vector<double> limit(n);
  for (int o : outputs) {
    const Sums& sum = sums[o];
    problem_.tolerance->limits(sum.mean, limit);
    double worst = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t i = static_cast<std::size_t>(o) * n + c;
      const double path = sum.path[c].variance(), half = half_width(sum, c, outputs_[o].look);
      result_.mean[i] = static_cast<float>(sum.mean[c]);
      result_.variance_geometry[i] = static_cast<float>(sum.geometry[c]);
      result_.variance_path[i] = static_cast<float>(path);
      result_.half_width[i] = static_cast<float>(half);
      worst = std::max(worst, half / limit[c]);
    }
    result_.worst_ratio[o] = static_cast<float>(worst);
    result_.converged[o] = worst <= 1.0 + 1e-6;
  }
  for (const Radiance::Pixel& pixel : radiance_->pixels())
    if (pixel.cluttered) net_sizes_[pixel.source] = pixel.net_size;

  struct Share {
    std::uint32_t material;
    double fraction = 0.0, variance = 0.0;
  };
  std::vector<std::vector<Share>> shares(outputs_.size());
  const auto share_of = [&](int output, std::uint32_t label) -> Share& {
    const std::uint32_t material = ledger_.field().material_of(table_.label(label));
    for (Share& s : shares[output])
      if (s.material == material) return s;
    return shares[output].emplace_back(Share{material});
  };
  for (const Radiance::Pixel& pixel : radiance_->pixels()) {
    const PixelModel& model = pixel.model;
    for (std::size_t o = 0; o < model.outputs.size(); ++o) {
      const int output = model.outputs[o];
      if (pixel.cluttered) {
        double count = 0.0;
        for (const Radiance::Stratum& s : pixel.strata) count += static_cast<double>(s.samples.size());
        const double w = integrator.whole_weight(pixel.source, output);
        std::vector<std::pair<std::uint32_t, double>> seen;
        for (const Radiance::Stratum& s : pixel.strata)
          for (std::uint32_t i : s.samples) {
            const std::uint32_t label = radiance_->labels()[i];
            auto at = std::find_if(seen.begin(), seen.end(), [&](const auto& e) { return e.first == label; });
            if (at == seen.end())
              seen.push_back({label, 1.0});
            else
              at->second += 1.0;
          }
        for (const auto& [label, hits] : seen) {
          Share& share = share_of(output, label);
          const double f = hits / count;
          share.fraction += w * f;
          share.variance += w * w * f * (1.0 - f) / count;
        }
        continue;
      }
      for (std::size_t r = 0; r < model.labels.size(); ++r)
        if (model.weight[o * model.labels.size() + r] > 0.0)
          share_of(output, model.labels[r]).fraction += model.weight[o * model.labels.size() + r];
      for (std::size_t b = 0; b < model.borders.size(); ++b) {
        const PixelModel::Border& border = model.borders[b];
        if (&share_of(output, border.inner) == &share_of(output, border.outer)) continue;
        const double variance = model.border_variance[o * model.borders.size() + b];
        share_of(output, border.inner).variance += variance;
        share_of(output, border.outer).variance += variance;
      }
      for (std::size_t l = 0; l < model.loose.size(); ++l) {
        const double w = model.loose_weight[o * model.loose.size() + l];
        for (std::uint32_t corner : model.loose[l].corner)
          share_of(output, corner).variance += 0.25 * w * w / 12.0;
      }
    }
  }
  for (int o : outputs) {
    std::sort(shares[o].begin(), shares[o].end(),
              [](const Share& a, const Share& b) { return a.material < b.material; });
    for (const Share& s : shares[o])
      result_.abundances.push_back({static_cast<std::uint32_t>(o), s.material, static_cast<float>(s.fraction),
                                    static_cast<float>(stopping_.normal() * std::sqrt(s.variance))});
  }
}

namespace {

/// The smallest area fraction that independent stratified rounds of these sizes find with probability 0.95: a
/// compact feature smaller than a stratum is missed by a round of n with probability 1 - n a.
double missable(const std::vector<double>& rounds) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double a = 0.5 * (low + high);
    double missed = 1.0;
    for (double n : rounds) missed *= std::max(0.0, 1.0 - n * a);
    (missed > 0.05 ? low : high) = a;
  }
  return high;
}

}  // namespace

void TileWork::report() {
  const PixelRect &d = lattice_.domain(), &t = problem_.tile;
  // Neighbours were mostly looked at alike.
  std::pair<int, std::uint32_t> known_looks{-1, 0};
  float known_fraction = 1.0f;
  for (int p = 0; p < d.count(); ++p) {
    const int x = d.x0 + p % d.width(), y = d.y0 + p / d.width();
    if (x < t.x0 || x >= t.x1 || y < t.y0 || y >= t.y1) {
      result_.halo_samples += ledger_.spent(p);
      continue;
    }
    const std::size_t o = static_cast<std::size_t>((y - t.y0) * t.width() + x - t.x0);
    result_.label_rays[o] = ledger_.label_rays(p);
    result_.radiance_evaluations[o] = ledger_.value_rays(p);
    result_.samples[o] = ledger_.spent(p);
    const std::pair<int, std::uint32_t> looks{prober_.clean_rounds(p), net_sizes_[p]};
    if (looks != known_looks) {
      known_looks = looks;
      std::vector<double> rounds{static_cast<double>(options_.lattice) * options_.lattice};
      for (int r = 0; r < looks.first; ++r)
        rounds.push_back(static_cast<double>(options_.probes_per_side) * options_.probes_per_side);
      if (looks.second > 0) rounds.push_back(static_cast<double>(Radiance::kReplicates) * looks.second);
      known_fraction = static_cast<float>(missable(rounds));
    }
    result_.missable_fraction[o] = known_fraction;
  }
  result_.seed_samples = ledger_.seed_rays();
  result_.probe_samples = ledger_.probe_rays();
  result_.rays = ledger_.field().counts();
}

}  // namespace ifov::sampling
