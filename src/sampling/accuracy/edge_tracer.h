#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/bracket.h"
#include "sampling/accuracy/cell.h"
#include "sampling/accuracy/chord.h"
#include "sampling/accuracy/contrast.h"
#include "sampling/accuracy/flat_map.h"
#include "sampling/accuracy/lattice.h"
#include "sampling/accuracy/options.h"
#include "sampling/accuracy/ray_ledger.h"

namespace ifov::sampling {

/// Traces the borders between labels over a tile's lattice: a quadtree of cells whose leaves are uniform,
/// crossed by one verified curve, or too small to matter. Works level by level: all points of a stage are one
/// batch. docs/theory/accuracy_sampler.md, sections 2 to 4.
class EdgeTracer {
 public:
  EdgeTracer(const Lattice& lattice, RayLedger& ledger, LabelTable& table, Contrast& contrast,
             const AccuracyOptions& options, const AccuracyFaults& faults, std::uint64_t seed);

  /// Makes the root cells from the labels of the lattice's vertices, row by row.
  void plant(std::span<const std::uint32_t> vertex_labels);

  /// Variance of each pixel that tracing may leave, in squares of the allowed standard error.
  std::vector<double>& allowed_variance() { return allowed_variance_; }

  /// Traces until every leaf is verified and every pixel's variance is as small as allowed_variance asks.
  void settle();

  /// Marks the leaf at a point to be split where the model contradicts what was seen there; false where it
  /// agrees or cannot be refined further. The next settle() does the work.
  bool contradict(FocalPoint point, std::uint32_t label);
  /// Whether what was seen at a point contradicts the model, where its curves may be off by the width to which they
  /// are known and `slack_px` more.
  bool disagrees(FocalPoint point, std::uint32_t label, double slack_px) const;

  /// Labels of further points, for seeds and probes.
  void ask_at(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels, Purpose purpose) {
    points_ = points;
    ask(labels, purpose);
  }

  /// Label of the traced model at a point of the domain; kNoLabel in complex cells.
  static constexpr std::uint32_t kNoLabel = ~std::uint32_t{0};
  std::uint32_t model_label(FocalPoint point) const;

  /// Label rays after which a pixel is clutter, one per pixel; at most AccuracyOptions::tracing_budget at first.
  std::vector<std::uint32_t>& budget() { return budget_; }

  /// Leaves this pixel as it is: no further rays.
  void abandon(std::uint32_t pixel) { abandoned_[pixel] = 1; }
  bool abandoned(std::uint32_t pixel) const { return abandoned_[pixel] != 0; }

  /// Whether tracing met anything in the pixel that the lattice alone had not announced.
  bool suspect(std::uint32_t pixel) const { return suspect_[pixel] != 0; }
  std::vector<std::uint8_t>& suspects() { return suspect_; }

  const Lattice& lattice() const { return lattice_; }
  const std::vector<Cell>& cells() const { return cells_; }
  const Curve& curve_of(const Cell& cell) const { return curves_[cell.chord]; }
  const Contrast& contrast() const { return contrast_; }

  /// The region of `inner` in a cell with a curve, as a polygon in image coordinates.
  Polygon inner_region(const Cell& cell) const;

  /// Variance of the area of `inner` in px^4, from crossings, middle and legs; Curve::loose_area comes on
  /// top.
  double area_variance(const Cell& cell) const;

 private:
  struct Ends {
    Point2 a, b;
  };
  /// A position beside a side whose middle differs from its two ends: cells there must be smaller than
  /// `level`.
  struct HangingNode {
    std::int32_t x, y;
    int level;
  };

  // Growth (edge_tracer_grow.cpp)
  void grow();
  void split(std::uint32_t cell);
  std::uint32_t push_cell(std::int32_t x, std::int32_t y, int level);
  std::uint32_t find_leaf(std::int32_t x, std::int32_t y) const;
  std::uint32_t leaf_at(FocalPoint point) const;
  std::uint32_t vertex(std::int32_t x, std::int32_t y);
  std::uint32_t known_vertex(std::int32_t x, std::int32_t y) const;
  void trace_vertices();
  void notice_hanging_nodes();
  void split_beside_hanging_nodes();
  void classify(std::uint32_t cell, std::vector<std::uint32_t>& awaiting);
  void settle_complex(std::uint32_t cell);
  bool foreign(const Cell& cell, std::uint32_t label) const;
  std::uint32_t bracket_on(const Cell& cell, int side);
  void locate(std::vector<std::uint32_t>& brackets);
  bool narrow_corner(const Cell& cell) const;
  void value_new_labels();

  // Verification (edge_tracer_verify.cpp, edge_tracer_shape.cpp)
  void verify();
  struct Check;
  void predict(Check& check);
  void weigh_answers(Check& check, const std::uint32_t* seen);
  void refuse(Check& check);
  void accept(Check& check);
  Ends ends(const Curve& curve) const;
  Point2 end_point(std::uint32_t bracket) const;
  double sagitta(const Curve& curve, const Ends& e) const;
  double sweep(const Cell& cell, const Ends& e, int end) const;
  bool within_tolerance(const Cell& cell, FocalPoint point, std::uint32_t model, std::uint32_t seen,
                        double slack_px) const;
  bool neighbour_end(const Curve& curve, int end, Point2& point) const;

  // Precision (edge_tracer_sharpen.cpp)
  void give_up_clutter();
  void sharpen();

  void ask(std::vector<std::uint32_t>& labels, Purpose purpose = Purpose::trace);

  Lattice lattice_;
  RayLedger& ledger_;
  LabelTable& table_;
  Contrast& contrast_;
  const AccuracyOptions& options_;
  const AccuracyFaults& faults_;
  std::uint64_t seed_;

  std::vector<Cell> cells_;
  std::vector<Curve> curves_;
  std::vector<Bracket> brackets_;
  FlatMap bracket_index_, vertex_index_;
  std::vector<std::uint32_t> root_vertices_;  // labels, (columns + 1) x (rows + 1)
  std::vector<std::uint32_t> fine_vertices_;  // labels of the others, in order of discovery
  std::vector<FocalPoint> pending_points_;    // fine vertices not traced yet
  std::vector<std::uint32_t> new_cells_, tentative_, edge_cells_, split_cells_;
  std::vector<HangingNode> hanging_;
  std::vector<FocalPoint> points_, first_seen_point_;
  std::vector<double> allowed_variance_;
  std::vector<std::uint32_t> budget_;
  std::vector<std::uint8_t> abandoned_, suspect_;
  std::vector<std::uint8_t>
      stirred_;  // pixels whose cells, curves or brackets changed since they were sharpened
  std::vector<int> halvings_;             // per bracket, while crossings are sharpened
  std::vector<double> sharpened_for_;  // allowed variance of each pixel when it was sharpened last
};

}  // namespace ifov::sampling
