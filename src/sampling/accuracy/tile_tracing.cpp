#include "sampling/accuracy/tile_tracing.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/allowed_errors.h"
#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/basis/stopping.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/label_values.h"
#include "sampling/accuracy/borders/steering_columns.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/clutter_choice.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/edges/probing.h"
#include "sampling/accuracy/lattice_survey.h"
#include "sampling/accuracy/like_neighbours.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/radiance/control_variates.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/standout_values.h"
#include "sampling/accuracy/random_look.h"
#include "sampling/accuracy/source_grid.h"
#include "sampling/accuracy/tile_recall.h"
#include "sampling/footprint_groups.h"
#include "sampling/known_detail.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sampling/tolerance.h"

namespace ifov::sampling {

namespace {

/// Source pixels that weigh less than this are not probed.
constexpr double kLeastProbed = 0.4;
/// A footprint's outermost pixels, where they weigh less than this, need no others around them to be traced
/// well enough.
constexpr double kNegligibleRim = 1e-3;

/// Pixels around those that the footprints reach.
int halo_of(const ColumnFootprints& footprints, int first_column) {
  if (footprints.by_column()) return 1;
  const double rim = footprints.reach();
  for (std::size_t group = 0; group < footprints.groups(); ++group) {
    const Point2 shift = footprints.shift_px(group, first_column);
    const double side =
        std::max(std::abs(shift.x), std::abs(shift.y));  // as if it were shifted straight there
    const PixelFootprint& footprint = footprints.footprint(group);
    const double weight = footprint.integral(rim - side - 0.5, -0.5, rim - side + 0.5, 0.5);
    if (!(weight < kNegligibleRim * footprint.integral(-0.5, -0.5, 0.5, 0.5))) return 1;
  }
  return 0;
}

}  // namespace

/// Each knows those above it that it needs, and none below.
struct TileTracing::Parts {
  Parts(const TileProblem& problem, Field& field, const AccuracyOptions& options, const AccuracyParts& parts,
        const ColumnFootprints& footprints, TileRecall& recall)
      : lattice(source_domain(problem, footprints.reach(), halo_of(footprints, problem.tile.x0)),
                options.lattice),
        grid(lattice, footprints, problem.tile),
        table(field),
        ledger(field, problem.cancel, lattice, table, recall.memory()),
        steering(problem.steering_channels, table.columns()),
        contrast(table, steering.list()),
        dither(parts.dither()),
        tracer(lattice, ledger, table, contrast, options, *dither, problem.seed),
        prober(tracer, ledger, options, problem.seed),
        look(grid, lattice, options.random_rays_per_side, problem.seed),
        errors(problem, footprints, grid, lattice, values, Stopping(problem.tolerance->confidence()).normal(),
               steering, contrast),
        clutter(lattice, values, contrast, recall, steering),
        standouts(lattice, values),
        controls(parts.controls(field, lattice, table, problem.seed)) {}

  Lattice lattice;
  SourceGrid grid;
  LabelTable table;
  RayLedger ledger;
  SteeringColumns steering;
  Contrast contrast;
  std::unique_ptr<Dither> dither;
  EdgeTracer tracer;
  Prober prober;
  LatticeValues values;
  RandomLook look;
  AllowedErrors errors;
  ClutterChoice clutter;
  StandoutValues standouts;
  std::unique_ptr<ControlVariates> controls;
  std::unique_ptr<LabelSpread> spread;
  KnownDetail known;
  Prober::Finds gaps;              // between labels of pixels that would else have been left to few values
  std::vector<int> not_looked_at;  // source pixels whose random points are asked when borders are traced
};

TileTracing::TileTracing(const TileProblem& problem, Field& field, const AccuracyOptions& options,
                         const AccuracyParts& parts, const ColumnFootprints& footprints, TileRecall& recall)
    : problem_(problem),
      options_(options),
      parts_of_method_(parts),
      footprints_(footprints),
      parts_(std::make_unique<Parts>(problem, field, options, parts, footprints, recall)) {}

TileTracing::~TileTracing() = default;

const Lattice& TileTracing::lattice() const { return parts_->lattice; }
const SourceGrid& TileTracing::grid() const { return parts_->grid; }
const LabelTable& TileTracing::table() const { return parts_->table; }
RayLedger& TileTracing::ledger() { return parts_->ledger; }
EdgeTracer& TileTracing::tracer() { return parts_->tracer; }
const Prober& TileTracing::prober() const { return parts_->prober; }
const RandomLook& TileTracing::look() const { return parts_->look; }
AllowedErrors& TileTracing::errors() { return parts_->errors; }
const ClutterChoice& TileTracing::clutter() const { return parts_->clutter; }
const SteeringColumns& TileTracing::steering() const { return parts_->steering; }
const LatticeValues& TileTracing::lattice_values() const { return parts_->values; }
const StandoutValues& TileTracing::standouts() const { return parts_->standouts; }
const LabelSpread& TileTracing::spread() const { return *parts_->spread; }
const ControlVariates& TileTracing::controls() const { return *parts_->controls; }

void TileTracing::trace_lattice() {
  const Lattice& lattice = parts_->lattice;
  RayLedger& ledger = parts_->ledger;
  LabelTable& table = parts_->table;
  LatticeValues& values = parts_->values;
  ask_vertices(lattice, ledger, problem_.seed, values);
  merge_twins(ledger, table, values);
  parts_->not_looked_at = parts_->look.test_constant_labels(ledger, table, values);
  take_means(lattice, table, values);
  parts_->spread = parts_of_method_.spread(lattice, table, values);
  const LabelSpread& spread = *parts_->spread;
  std::vector<double>& variances = parts_->contrast.spread();
  variances.reserve(table.size() * table.columns());
  for (std::uint32_t label = 0; label < table.size(); ++label)
    for (int column = 0; column < static_cast<int>(table.columns()); ++column)
      variances.push_back(spread.local(label, column));
  tell_uneven();
  const PixelRect& d = lattice.domain();
  if (options_.pilot_rays) {
    ledger.field().known_detail({d.x0, d.y0, d.x1, d.y1}, parts_->known);
    parts_->standouts.ask(parts_->known.standouts, problem_.thin_shadows, ledger, problem_.seed);
  }
  parts_->errors.take_from_lattice();
  parts_->standouts.judge(
      spread, [this](int p) { return parts_->errors.inverse_squares(p); }, parts_->steering);
  parts_->errors.set_contrasts();
  if (ControlVariates::affordable(footprints_, lattice.domain().count(), ledger.field().columns()))
    parts_->controls->fit(values, *parts_->spread,
                          [this](int p) { return parts_->errors.inverse_squares(p); });
  for (int p = 0; p < lattice.domain().count(); ++p)
    parts_->tracer.pixels().allow_variance(static_cast<std::uint32_t>(p),
                                           parts_->errors.border_variance(p, spread));
  parts_->tracer.plant(values.labels);
}

/// What the lattice met seldom of a label that is uneven says little of how its values differ.
void TileTracing::tell_uneven() {
  const LatticeValues& values = parts_->values;
  std::vector<std::uint8_t> wanted(parts_->table.size());
  for (std::uint32_t label = 0; label < wanted.size(); ++label)
    wanted[label] = parts_->table.count(label) < LabelValues::kOfUneven &&
                    parts_->table.merged(label) == label &&
                    parts_->ledger.field().uneven(parts_->table.label(label));
  std::vector<std::uint32_t> labels;
  std::vector<FocalPoint> points;
  const auto want = [&](std::uint32_t label, FocalPoint point) {
    if (!wanted[label]) return;
    wanted[label] = 0;
    labels.push_back(label);
    points.push_back(point);
  };
  for (std::size_t v = 0; v < values.labels.size(); ++v)
    want(values.labels[v], parts_->lattice.vertex_point(v));
  for (std::size_t i = 0; i < values.random.labels.size(); ++i)
    want(values.random.labels[i], values.random.points[i]);
  LabelValues(parts_->ledger, parts_->table, parts_->contrast, problem_.seed).take(labels, points);
}

void TileTracing::switch_clutter() {
  const KnownDetail& known = parts_->known;
  if (!options_.clutter_switch) return;
  TracedPixels& pixels = parts_->tracer.pixels();
  for (std::size_t p = 0; p < known.full.size(); ++p)
    if (known.full[p]) pixels.abandon(static_cast<std::uint32_t>(p));
  const std::vector<std::uint8_t> overlooking =
      parts_->clutter.choose(parts_->errors, *parts_->spread, pixels);
  // Rays find what stands out, and values alone tell how much of it there is.
  for (int p = 0; p < parts_->lattice.domain().count(); ++p)
    if (const double apart = parts_->standouts.apart(p); apart > 1.0) {
      pixels.abandon(static_cast<std::uint32_t>(p));
      parts_->clutter.expect_values(p, apart);
    }
  std::vector<std::uint8_t> worth = worth_probing();
  for (std::size_t p = 0; p < worth.size(); ++p) worth[p] &= overlooking[p];
  parts_->gaps = LikeNeighbours(parts_->tracer, parts_->prober, parts_->values, parts_->table, problem_.seed)
                     .gaps_in(worth);
  std::vector<std::uint8_t> gap(overlooking.size(), 0);
  for (std::size_t i = 0; i < parts_->gaps.points.size(); ++i) {
    const int pixel = parts_->lattice.pixel_at(parts_->gaps.points[i]);
    gap[pixel] = 1;
    parts_->clutter.expect(pixel, parts_->gaps.labels[i], pixels);
  }
  for (std::size_t p = 0; p < overlooking.size(); ++p)
    if (overlooking[p] && !gap[p]) pixels.abandon(static_cast<std::uint32_t>(p));
}

std::vector<std::uint8_t> TileTracing::worth_probing() const {
  std::vector<std::uint8_t> worth(static_cast<std::size_t>(parts_->lattice.domain().count()));
  for (std::size_t p = 0; p < worth.size(); ++p)
    worth[p] = parts_->grid.relative_weight(static_cast<int>(p)) > kLeastProbed;
  return worth;
}

void TileTracing::trace_borders() {
  Prober& prober = parts_->prober;
  parts_->tracer.settle();
  prober.take_in_expected(parts_->gaps.points, parts_->gaps.labels);
  const std::vector<std::uint8_t> worth = worth_probing();
  LikeNeighbours(parts_->tracer, prober, parts_->values, parts_->table, problem_.seed).probe_between(worth);
  probe_around();
  if (options_.pilot_rays) {
    prober.follow_pilot_rays(problem_.pilot_points, problem_.pilot_objects);
    prober.follow_pilot_rays(parts_->known.points, {});
  }
  prober.probe_until_clean(worth);
  leave_unsettled();
  const std::size_t columns = parts_->table.columns();
  const std::vector<double>& known = parts_->contrast.spread();
  for (std::uint32_t label = 0; label < known.size() / columns; ++label)
    if (parts_->ledger.field().uneven(parts_->table.label(label)))
      parts_->spread->learn(label, std::span(known).subspan(label * columns, columns));
}

/// In clutter the values will look.
void TileTracing::probe_around() {
  std::vector<FocalPoint> points;
  for (const int p : parts_->not_looked_at) {
    if (parts_->tracer.pixels().abandoned(static_cast<std::uint32_t>(p))) continue;
    const std::vector<FocalPoint> more = parts_->look.points(p);
    points.insert(points.end(), more.begin(), more.end());
  }
  parts_->prober.probe_around(parts_->values.random.points, parts_->values.random.labels, points);
}

/// Where looks went on finding what the model did not have, there is more than they have found.
void TileTracing::leave_unsettled() {
  if (!options_.clutter_switch) return;
  for (int p = 0; p < parts_->lattice.domain().count(); ++p)
    if (parts_->prober.unsettled(p)) parts_->tracer.pixels().abandon(static_cast<std::uint32_t>(p));
}

}  // namespace ifov::sampling
