#include "sampling/accuracy/edges/edge_tracer.h"

#include <cmath>

#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/edge_cells.h"
#include "sampling/accuracy/borders/point_queries.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/cell_growth.h"
#include "sampling/accuracy/edges/complex_cells.h"
#include "sampling/accuracy/edges/contradictions.h"
#include "sampling/accuracy/edges/crossing_precision.h"
#include "sampling/accuracy/edges/curve_predictor.h"
#include "sampling/accuracy/edges/curve_verifier.h"
#include "sampling/accuracy/edges/junction_predictor.h"
#include "sampling/accuracy/edges/junction_verifier.h"
#include "sampling/accuracy/edges/narrow_features.h"
#include "sampling/accuracy/edges/open_borders.h"
#include "sampling/accuracy/edges/sharpener.h"

namespace ifov::sampling {

namespace {

/// Passes of tracing in which borders are made sharper.
constexpr int kMaxPasses = 24;

}  // namespace

/// Each knows those above it that it needs, and none below.
struct EdgeTracer::Parts {
  Parts(const Lattice& lattice, RayLedger& ledger, LabelTable& table, Contrast& contrast,
        const AccuracyOptions& options, const Dither& dither, std::uint64_t seed)
      : pixels(lattice.domain().count(), options.tracing_budget),
        queries(ledger, table, contrast, seed),
        tree(lattice, queries, pixels),
        edge_cells(pixels.size()),
        brackets(tree, contrast, pixels, queries, dither, options.initial_bracket_px, seed),
        model(tree, brackets),
        features(tree, brackets),
        contradictions(model, contrast, pixels),
        complex(tree, features, contrast, pixels, options.thinnest_px),
        growth(tree, brackets, model, edge_cells, complex, features, contrast, pixels),
        curve_predictor(model, features, contrast, pixels, dither, seed),
        curve_verifier(tree, model, curve_predictor, features, contrast, pixels, queries),
        junction_predictor(model),
        junction_verifier(tree, model, junction_predictor, complex, pixels, queries),
        crossing_precision(tree, brackets, complex, pixels),
        sharpener(tree, model, edge_cells, crossing_precision, junction_predictor, contrast, pixels) {}

  TracedPixels pixels;
  PointQueries queries;
  CellTree tree;
  EdgeCells edge_cells;
  BracketStore brackets;
  BorderModel model;
  NarrowFeatures features;
  Contradictions contradictions;
  ComplexCells complex;
  CellGrowth growth;
  CurvePredictor curve_predictor;
  CurveVerifier curve_verifier;
  JunctionPredictor junction_predictor;
  JunctionVerifier junction_verifier;
  CrossingPrecision crossing_precision;
  Sharpener sharpener;
  OpenBorders open;
};

EdgeTracer::EdgeTracer(const Lattice& lattice, RayLedger& ledger, LabelTable& table, Contrast& contrast,
                       const AccuracyOptions& options, const Dither& dither, std::uint64_t seed)
    : lattice_(lattice),
      ledger_(ledger),
      clutter_switch_(options.clutter_switch),
      parts_(std::make_unique<Parts>(lattice, ledger, table, contrast, options, dither, seed)) {}

EdgeTracer::~EdgeTracer() = default;

void EdgeTracer::plant(std::span<const std::uint32_t> vertex_labels) {
  parts_->tree.plant(vertex_labels);
  // Most of these cells get one curve, and share its two crossings with their neighbours.
  const std::size_t fresh = parts_->tree.fresh_cells().size(), crossed = fresh + fresh / 8;
  parts_->model.reserve(crossed);
  parts_->brackets.plant(crossed);
  parts_->edge_cells.reserve(crossed);
}

void EdgeTracer::settle() {
  CellTree& tree = parts_->tree;
  OpenBorders& open = parts_->open;
  for (int pass = 0;; ++pass) {
    while (!tree.fresh_cells().empty()) {
      // What the lattice did not announce may turn out while tracing.
      if (clutter_switch_) parts_->pixels.abandon_beyond_budget(ledger_.label_rays());
      if (tree.look_at_vertices()) parts_->growth.grow(open);
    }
    // What there is then is verified to its end: that splits cells, but opens none that was verified.
    if (pass < kMaxPasses) parts_->sharpener.sharpen(open);
    if (!tree.fresh_cells().empty()) continue;
    if (open.curves.empty() && open.junctions.empty()) return;
    parts_->junction_verifier.verify(open.junctions);
    parts_->curve_verifier.verify(open.curves);
  }
}

bool EdgeTracer::contradict(FocalPoint point, std::uint32_t label) {
  const std::uint32_t leaf = parts_->tree.leaf_at(point);
  const Cell& cell = parts_->tree[leaf];
  if (cell.level == kMaxLevel || parts_->pixels.abandoned(cell.pixel) ||
      !parts_->contradictions.disagrees(point, label, 0.0))
    return false;
  parts_->pixels.note_suspect(cell.pixel);
  parts_->tree.split(leaf);
  return true;
}

void EdgeTracer::ask_at(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels,
                        Purpose purpose) {
  parts_->queries.ask(points, labels, purpose);
}

double EdgeTracer::narrowest_followed(std::uint32_t pixel) const {
  const int level = parts_->pixels.followed(pixel);
  return level > 0 ? lattice_.side_px(level) : INFINITY;
}

double EdgeTracer::narrowest_met(std::uint32_t pixel) const {
  return parts_->edge_cells.crossed(pixel) ? parts_->features.narrowest_met(pixel) : INFINITY;
}

bool EdgeTracer::may_have_corners(std::uint32_t a, std::uint32_t b) const {
  return parts_->queries.may_have_corners(a, b);
}

double EdgeTracer::leaf_side_px(FocalPoint point) const {
  return lattice_.side_px(parts_->tree[parts_->tree.leaf_at(point)].level);
}

TracedPixels& EdgeTracer::pixels() { return parts_->pixels; }
const TracedPixels& EdgeTracer::pixels() const { return parts_->pixels; }
const CellTree& EdgeTracer::tree() const { return parts_->tree; }
const EdgeCells& EdgeTracer::edge_cells() const { return parts_->edge_cells; }
const BorderModel& EdgeTracer::model() const { return parts_->model; }
const Contradictions& EdgeTracer::contradictions() const { return parts_->contradictions; }

}  // namespace ifov::sampling
