#include "sampling/accuracy/tile_work.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/source_domain.h"

namespace ifov::sampling {

namespace {

/// Source pixels that weigh less than this are not probed.
constexpr double kLeastProbed = 0.4;
/// Share of what borders may take from which on they are traced more precisely: they leave a little to paths that hardly
/// vary, and a pixel that borders fill to the brim ends above its limit.
constexpr double kTight = 0.97;
/// A footprint's outermost pixels, where they weigh less than this, need no others around them to be traced
/// well enough.
constexpr double kNegligibleRim = 1e-3;

/// Pixels around those that the footprints reach.
int halo_of(const PixelFootprint& footprint) {
  const double rim = std::ceil(footprint.half_width_px() - 0.5 - 1e-12);
  const double weight = footprint.integral(rim - 0.5, -0.5, rim + 0.5, 0.5);
  return weight < kNegligibleRim * footprint.integral(-0.5, -0.5, 0.5, 0.5) ? 0 : 1;
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
      sums_(outputs_.size(), !problem.footprint->whole_pixel()),
      predicted_(static_cast<std::size_t>(lattice_.domain().count()), 0.0f),
      looks_(predicted_.size()),
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
  const int dx = x - std::clamp(x, t.x0, t.x1 - 1), dy = y - std::clamp(y, t.y0, t.y1 - 1);
  if (dx == 0 && dy == 0) return 1.0;
  return problem_.footprint->integral(dx - 0.5, dy - 0.5, dx + 0.5, dy + 0.5) /
         problem_.footprint->integral(-0.5, -0.5, 0.5, 0.5);
}

void TileWork::trace_borders() {
  tracer_.settle();
  std::vector<std::uint8_t> worth(static_cast<std::size_t>(lattice_.domain().count()));
  for (std::size_t p = 0; p < worth.size(); ++p)
    worth[p] = relative_weight(static_cast<int>(p)) > kLeastProbed;
  look_between(worth);
  look_around();
  if (options_.seeds) {
    prober_.follow_seeds(problem_.seeds, problem_.seed_objects);
    prober_.follow_seeds(known_.points, {});
  }
  prober_.probe_until_clean(worth);
  leave_unsettled();
  tighten_borders();
}

/// In clutter the values will look.
void TileWork::look_around() {
  std::vector<FocalPoint> points;
  for (const int p : not_looked_at_) {
    if (tracer_.abandoned(static_cast<std::uint32_t>(p))) continue;
    const std::vector<FocalPoint> more = random_points(p);
    points.insert(points.end(), more.begin(), more.end());
  }
  prober_.look_around(lattice_values_.look.points, lattice_values_.look.labels, points);
}

/// The lattice may have been in step with what it looked at: limits follow the means that borders tell.
void TileWork::take_limits_from_sums() {
  const std::size_t n = problem_.drivers.size();
  std::vector<double> mean(static_cast<std::size_t>(columns_), 0.0), limit(mean.size());
  const double unit = stopping_.normal() * foresight();
  for (int p = 0; p < lattice_.domain().count(); ++p) {
    const OutputSums::Row sum = sums_[nearest_output(p)];
    for (std::size_t d = 0; d < n; ++d) mean[problem_.drivers[d]] = sum.mean[d];
    problem_.tolerance->limits(mean, limit);
    for (std::size_t d = 0; d < n; ++d) contrast_.allowed(p)[d] = limit[problem_.drivers[d]] / unit;
  }
}

/// The first run of a tile that is kept traces borders, and tells clutter, for an error this much smaller: rays that look
/// beside a border are of no use where it is known better, nor are values of clutter in a pixel that is traced.
double TileWork::foresight() const {
  constexpr double kForesight = 2.0;
  return problem_.keep_memory && problem_.before == nullptr ? kForesight : 1.0;
}

/// Contrasts that steered the tracer are those of the tile; a pixel may differ. Borders are made more precise
/// where the pixel's own strata say so.
void TileWork::tighten_borders() {
  const std::size_t n = problem_.drivers.size();
  std::vector<int> every_output(outputs_.size());
  std::iota(every_output.begin(), every_output.end(), 0);
  for (int pass = 0; pass < 4; ++pass) {
    const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
    if (radiance_ == nullptr || !radiance_->refresh(integrator)) {
      radiance_ = std::make_unique<Radiance>(tracer_, prober_, ledger_, table_, *spread_, lattice_values_,
                                             faults_, problem_.seed, !integrator.unit_box());
      radiance_->add_pixels(0, lattice_.domain().count(), integrator);
    }
    tracer_.forget_changes();
    gather(integrator, problem_.drivers, every_output);
    take_limits_from_sums();
    bool any = false;
    std::vector<double> factor(tracer_.allowed_variance().size(), 1.0);
    for (const Radiance::Pixel& pixel : radiance_->pixels())
      for (int output : pixel.model.outputs) {
        const auto allowed = contrast_.allowed(source_of(output));
        double worst = 0.0;
        for (std::size_t d = 0; d < n; ++d)
          worst = std::max(worst, sums_[output].geometry[d] / (allowed[d] * allowed[d]));
        const double share = geometry_share(source_of(output));
        if (worst > kTight * share)
          factor[pixel.source] = std::max(factor[pixel.source], 1.1 * worst / share);
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
