#include "sampling/accuracy/tile_work.h"

#include <algorithm>
#include <numeric>

#include "sampling/accuracy/allowed_errors.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/border_tightening.h"
#include "sampling/accuracy/borders/steering_columns.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/clutter_choice.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/radiance/control_variates.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/unseen_values.h"
#include "sampling/accuracy/round_planner.h"
#include "sampling/accuracy/weights/leaf_integrator.h"
#include "sampling/tile.h"

namespace ifov::sampling {

TileWork::TileWork(const TileProblem& problem, Field& field, const AccuracyOptions& options,
                   const AccuracyParts& parts, TileResult& result)
    : problem_(problem),
      options_(options),
      parts_(parts),
      result_(result),
      columns_(field.columns()),
      footprints_(problem.footprints(field)),
      recall_(problem, columns_),
      tracing_(problem, field, options, parts, footprints_, recall_),
      sources_(tracing_.lattice().domain().count()),
      intervals_(*problem.tolerance, problem.later, tracing_.table(), field, problem.tile.count(),
                 footprints_),
      report_(tracing_.prober(), tracing_.ledger(), tracing_.table(), options.max_samples_per_pixel, result) {
  result.reset(problem.tile, columns_);
  recall_.recall_tests(intervals_.states());
}

TileWork::~TileWork() = default;

void TileWork::trace() {
  tracing_.trace_lattice();
  tracing_.switch_clutter();
  tracing_.trace_borders();
  const Lattice& lattice = tracing_.lattice();
  const LatticeValues& values = tracing_.lattice_values();
  const LabelTable& table = tracing_.table();
  const LabelSpread& spread = tracing_.spread();
  const Field& field = tracing_.ledger().field();
  nearby_ = parts_.nearby(lattice, values, tracing_.prober(), field, table, spread);
  estimates_ = parts_.estimates(lattice, values, table, spread);
  unseen_ = parts_.unseen(spread, tracing_.prober(), tracing_.standouts(), table, field);
  tighten_borders();
}

void TileWork::begin_radiance(int first, int last, const LeafIntegrator& integrator) {
  radiance_ = std::make_unique<Radiance>(
      tracing_.tracer(), tracing_.ledger(), tracing_.table(),
      Radiance::Judges{tracing_.spread(), *nearby_, *estimates_, *unseen_, tracing_.controls()},
      problem_.seed, !integrator.unit_box());
  radiance_->add_pixels(first, last, integrator);
}

/// Contrasts that steered the tracer are those of the tile; a pixel may differ. Borders are made more precise
/// where the pixel's own strata say so.
void TileWork::tighten_borders() {
  std::vector<int> every_output(intervals_.states().size());
  std::iota(every_output.begin(), every_output.end(), 0);
  for (int pass = 0; pass < 4; ++pass) {
    const LeafIntegrator integrator(tracing_.tracer(), footprints_, problem_.tile);
    if (radiance_ == nullptr || !radiance_->refresh(integrator)) begin_radiance(0, sources_, integrator);
    tracing_.tracer().pixels().forget_changes();
    if (pass == 0) tracing_.errors().cover(radiance_->pixels());
    intervals_.gather(*radiance_, integrator, tracing_.steering().list(), every_output);
    tracing_.errors().take_from_sums(intervals_);
    if (!tighten_pixels(*radiance_, tracing_.grid(), tracing_.errors(), tracing_.spread(), tracing_.ledger(),
                        options_.max_samples_per_pixel, intervals_, tracing_.tracer().pixels()))
      return;
    tracing_.tracer().settle();
  }
  const LeafIntegrator integrator(tracing_.tracer(), footprints_, problem_.tile);
  if (!radiance_->refresh(integrator)) radiance_.reset();
}

void TileWork::estimate() {
  const LeafIntegrator integrator(tracing_.tracer(), footprints_, problem_.tile);
  // Pixels of a box footprint are independent of each other: they are finished in groups, so that few values
  // are in memory at a time. A wider footprint ties them together.
  const int group =
      integrator.unit_box() ? std::max<int>(64, 81920 / tracing_.ledger().field().stride()) : sources_;
  estimates_->doubt();
  RoundPlanner planner(options_, tracing_.ledger(), tracing_.clutter(), intervals_);
  for (int first = 0; first < sources_; first += group) {
    const bool ready = group >= sources_ && radiance_ != nullptr;  // by tighten_borders, of all pixels
    if (!ready) begin_radiance(first, std::min(sources_, first + group), integrator);
    tracing_.controls().attach(radiance_->pixels(), tracing_.tracer().model(), integrator, *nearby_,
                               tracing_.spread(),
                               [this](int p) { return tracing_.errors().inverse_squares(p); });
    const std::vector<int> outputs = radiance_->outputs_reached(problem_.tile.count());
    recall_.recall_values(*radiance_, intervals_.states());
    planner.run(*radiance_, integrator, outputs, tracing_.steering().list(), columns_);
    report_.add_group(*radiance_, integrator, outputs, intervals_);
    recall_.remember_values(*radiance_, tracing_.clutter().predicted());
  }
}

void TileWork::report() {
  report_.finish(tracing_.lattice(), tracing_.look());
  recall_.finish(intervals_.states(), result_);
}

}  // namespace ifov::sampling
