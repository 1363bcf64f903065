#include "sampling/accuracy/tile_work.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/edges/traced_pixels.h"
#include "sampling/accuracy/lattice_survey.h"
#include "sampling/accuracy/leaf_integrator.h"
#include "sampling/accuracy/like_neighbours.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/radiance.h"
#include "sampling/accuracy/round_planner.h"
#include "sampling/accuracy/spread.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"

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

}  // namespace

TileWork::TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
                   const AccuracyParts& parts, TileResult& result)
    : problem_(problem),
      options_(options),
      parts_(parts),
      result_(result),
      columns_(field.columns()),
      lattice_(source_domain(problem, halo_of(*problem.footprint)), options.lattice),
      grid_(lattice_, *problem.footprint, problem.tile),
      table_(columns_),
      recall_(problem, columns_),
      ledger_(field, problem.cancel, lattice_, table_, recall_.memory()),
      contrast_(table_, problem.drivers, lattice_.domain().count()),
      dither_(parts.dither()),
      tracer_(lattice_, ledger_, table_, contrast_, options, *dither_, problem.seed),
      prober_(tracer_, ledger_, options, problem.seed),
      intervals_(*problem.tolerance, table_, problem.tile.count(), !problem.footprint->whole_pixel()),
      errors_(problem, grid_, lattice_, lattice_values_, intervals_.stopping().normal(), contrast_),
      clutter_(lattice_, lattice_values_, contrast_, recall_, problem.drivers),
      look_(grid_, lattice_, options.looks_per_side, problem.seed),
      report_(prober_, ledger_, table_, options.max_samples_per_pixel, result) {
  result.reset(problem.tile, columns_);
  recall_.recall_looks(intervals_.states());
}

TileWork::~TileWork() = default;

void TileWork::trace_lattice() {
  ask_vertices(lattice_, ledger_, problem_.seed, lattice_values_);
  merge_twins(ledger_, table_, lattice_values_);
  not_looked_at_ = look_.look_at_constants(ledger_, table_, lattice_values_);
  take_means(lattice_, table_, lattice_values_);
  spread_ = parts_.spread(lattice_, table_, lattice_values_);
  contrast_.spread().resize(table_.size() * problem_.drivers.size());
  for (std::size_t l = 0; l < table_.size(); ++l)
    for (std::size_t d = 0; d < problem_.drivers.size(); ++d)
      contrast_.spread()[l * problem_.drivers.size() + d] =
          spread_->local(static_cast<std::uint32_t>(l), problem_.drivers[d]);
  errors_.take_from_lattice();
  for (int p = 0; p < lattice_.domain().count(); ++p)
    tracer_.pixels().allow_variance(static_cast<std::uint32_t>(p), errors_.border_variance(p, *spread_));
  tracer_.plant(lattice_values_.labels);
}

void TileWork::switch_clutter() {
  const PixelRect& d = lattice_.domain();
  if (options_.seeds) ledger_.field().known_detail({d.x0, d.y0, d.x1, d.y1}, known_);
  if (!options_.clutter_switch) return;
  for (std::size_t p = 0; p < known_.full.size(); ++p)
    if (known_.full[p]) tracer_.pixels().abandon(static_cast<std::uint32_t>(p));
  clutter_.choose(errors_, *spread_, tracer_.pixels());
}

void TileWork::trace_borders() {
  tracer_.settle();
  std::vector<std::uint8_t> worth(static_cast<std::size_t>(lattice_.domain().count()));
  for (std::size_t p = 0; p < worth.size(); ++p)
    worth[p] = grid_.relative_weight(static_cast<int>(p)) > kLeastProbed;
  LikeNeighbours(tracer_, prober_, lattice_values_, table_, problem_.seed).look_between(worth);
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
    if (tracer_.pixels().abandoned(static_cast<std::uint32_t>(p))) continue;
    const std::vector<FocalPoint> more = look_.points(p);
    points.insert(points.end(), more.begin(), more.end());
  }
  prober_.look_around(lattice_values_.look.points, lattice_values_.look.labels, points);
}

/// Where looks went on finding what the model did not have, there is more than they have found.
void TileWork::leave_unsettled() {
  if (!options_.clutter_switch) return;
  for (int p = 0; p < lattice_.domain().count(); ++p)
    if (prober_.unsettled(p)) tracer_.pixels().abandon(static_cast<std::uint32_t>(p));
}

void TileWork::begin_radiance(int first, int last, const LeafIntegrator& integrator) {
  radiance_ = std::make_unique<Radiance>(tracer_, prober_, ledger_, table_, *spread_, lattice_values_,
                                         problem_.seed, !integrator.unit_box());
  radiance_->pixels().add(first, last, integrator);
}

/// Contrasts that steered the tracer are those of the tile; a pixel may differ. Borders are made more precise
/// where the pixel's own strata say so.
void TileWork::tighten_borders() {
  std::vector<int> every_output(intervals_.states().size());
  std::iota(every_output.begin(), every_output.end(), 0);
  for (int pass = 0; pass < 4; ++pass) {
    const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
    if (radiance_ == nullptr || !radiance_->pixels().refresh(integrator))
      begin_radiance(0, lattice_.domain().count(), integrator);
    tracer_.pixels().forget_changes();
    intervals_.gather(*radiance_, integrator, problem_.drivers, every_output);
    errors_.take_from_sums(intervals_);
    if (!tighten_pixels()) return;
    tracer_.settle();
  }
  const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
  if (!radiance_->pixels().refresh(integrator)) radiance_.reset();
}

/// False where no pixel needs it.
bool TileWork::tighten_pixels() {
  const std::size_t n = problem_.drivers.size();
  TracedPixels& traced = tracer_.pixels();
  std::vector<double> factor(traced.size(), 1.0);
  for (const SourcePixel& pixel : radiance_->pixels().others())
    for (int output : pixel.model.outputs) {
      const auto allowed = contrast_.allowed(grid_.source_of(output));
      double worst = 0.0;
      for (std::size_t d = 0; d < n; ++d)
        worst = std::max(worst, intervals_.sum(output).geometry[d] / (allowed[d] * allowed[d]));
      const double share = errors_.geometry_share(grid_.source_of(output), *spread_);
      if (worst > kTight * share) factor[pixel.source] = std::max(factor[pixel.source], 1.1 * worst / share);
    }
  bool any = false;
  for (std::uint32_t p = 0; p < factor.size(); ++p)
    if (factor[p] > 1.0 && !traced.abandoned(p) &&
        ledger_.spent(static_cast<int>(p)) < options_.max_samples_per_pixel) {
      traced.allow_variance(p, traced.allowed_variance(p) / std::min(factor[p], 16.0));
      any = true;
    }
  return any;
}

void TileWork::estimate() {
  const LeafIntegrator integrator(tracer_, *problem_.footprint, problem_.tile);
  // Pixels of a box footprint are independent of each other: they are finished in groups, so that few values
  // are in memory at a time. A wider footprint ties them together.
  const int sources = lattice_.domain().count();
  const int group = integrator.unit_box() ? std::max<int>(64, 81920 / ledger_.field().stride()) : sources;
  RoundPlanner planner(options_, ledger_, clutter_, intervals_);
  for (int first = 0; first < sources; first += group) {
    const bool ready = group >= sources && radiance_ != nullptr;  // by tighten_borders, of all pixels
    if (!ready) begin_radiance(first, std::min(sources, first + group), integrator);
    const std::vector<int> outputs = outputs_reached();
    for (std::size_t p = 0; p < radiance_->pixels().others().size(); ++p)
      recall_.recall_values(*radiance_, p, intervals_.states());
    planner.run(*radiance_, integrator, outputs, problem_.drivers, columns_);
    report_.add_group(*radiance_, integrator, outputs, intervals_);
    recall_.remember_values(*radiance_, clutter_.predicted());
  }
}

/// The outputs in which source pixels of the group weigh.
std::vector<int> TileWork::outputs_reached() const {
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(problem_.tile.count()), 0);
  for (const PlainPixel& pixel : radiance_->pixels().plain()) touched[pixel.output] = 1;
  for (const SourcePixel& pixel : radiance_->pixels().others())
    for (int o : pixel.model.outputs) touched[o] = 1;
  std::vector<int> outputs;
  for (std::size_t o = 0; o < touched.size(); ++o)
    if (touched[o]) outputs.push_back(static_cast<int>(o));
  return outputs;
}

void TileWork::report() {
  report_.finish(lattice_, look_);
  recall_.finish(intervals_.states(), result_);
}

}  // namespace ifov::sampling
