#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/flat_map.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/edges/bracket.h"
#include "sampling/accuracy/edges/cell.h"
#include "sampling/accuracy/edges/chord.h"
#include "sampling/accuracy/edges/contrast.h"
#include "sampling/accuracy/edges/curve_check.h"
#include "sampling/accuracy/edges/junction.h"

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
  std::vector<double>& allowed_variance() {
    allowed_may_differ_ = true;
    return allowed_variance_;
  }

  /// Traces until every leaf is verified and every pixel's variance is as small as allowed_variance asks.
  void settle();

  /// Marks the leaf at a point to be split where the model contradicts what was seen there; false where it
  /// agrees or cannot be refined further. The next settle() does the work.
  bool contradict(FocalPoint point, std::uint32_t label);
  /// Whether what was seen at a point contradicts the model, where its curves may be off by the width to
  /// which they are known and `slack_px` more.
  bool disagrees(FocalPoint point, std::uint32_t label, double slack_px) const;

  /// Whether a strip of one label on the other, as wide as the lattice is fine, would matter in the pixel.
  bool matters(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const;

  /// Contrast of what was seen at a point to the model, where the two differ in a cell that is too small to be refined;
  /// 0 where they agree or a border's own uncertainty explains it.
  double dismissed(FocalPoint point, std::uint32_t label) const;

  /// Labels of further points, for seeds and probes.
  void ask_at(const std::vector<FocalPoint>& points, std::vector<std::uint32_t>& labels, Purpose purpose) {
    points_ = points;
    ask(labels, purpose);
  }

  /// Label of the traced model at a point of the domain; kNoLabel in complex cells.
  static constexpr std::uint32_t kNoLabel = ~std::uint32_t{0};
  std::uint32_t model_label(FocalPoint point) const { return label_in(cells_[leaf_at(point)], point); }

  /// About how wide the narrowest feature is that was followed into the pixel across the sides of its cells; infinite where
  /// none was.
  double narrowest_followed(std::uint32_t pixel) const {
    return followed_[pixel] > 0 ? lattice_.side_px(followed_[pixel]) : INFINITY;
  }
  /// Width of the narrowest feature that one of the pixel's vertices on the lattice lies in; infinite where none is
  /// narrower than the lattice is fine. Such a feature was met by chance.
  double narrowest_met(std::uint32_t pixel) const;

  /// Label of one of the lattice's own vertices in a pixel and on its sides, from 0 to cells_per_pixel() each way.
  std::uint32_t lattice_label(std::uint32_t pixel, int i, int j) const {
    const Cell& first = cells_[root_cell(static_cast<int>(pixel))];
    return root_vertices_[root_vertex(first.x, first.y) +
                          static_cast<std::size_t>(j * (lattice_.columns() + 1) + i)];
  }

  /// Side of the smallest cell that holds the point: about the width of what was traced there.
  double leaf_side_px(FocalPoint point) const { return lattice_.side_px(cells_[leaf_at(point)].level); }

  /// Label rays after which a pixel is clutter, one per pixel; at most AccuracyOptions::tracing_budget at
  /// first.
  std::vector<std::uint32_t>& budget() { return budget_; }

  /// Leaves this pixel as it is: no further rays.
  void abandon(std::uint32_t pixel) { abandoned_[pixel] = changed_[pixel] = 1; }
  bool abandoned(std::uint32_t pixel) const { return abandoned_[pixel] != 0; }

  /// Whether what is modelled in the pixel may differ from what it was when this was last forgotten.
  bool changed(std::uint32_t pixel) const { return changed_[pixel] != 0; }
  void forget_changes() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{0}); }

  /// Whether a border crosses the pixel; its cells are all uniform otherwise.
  bool crossed(std::uint32_t pixel) const { return edge_lists_[pixel].first != kNone; }
  /// The first of a pixel's cells on the lattice; rows of them are lattice().columns() apart.
  std::uint32_t root_cell(int pixel) const {
    const int width = lattice_.domain().width(), k = lattice_.cells_per_pixel();
    return static_cast<std::uint32_t>((pixel / width * lattice_.columns() + pixel % width) * k);
  }

  /// Whether tracing met anything in the pixel that the lattice alone had not announced.
  bool suspect(std::uint32_t pixel) const { return suspect_[pixel] != 0; }
  std::vector<std::uint8_t>& suspects() { return suspect_; }
  std::vector<std::uint8_t>& followed() { return followed_; }

  const Lattice& lattice() const { return lattice_; }
  const std::vector<Cell>& cells() const { return cells_; }
  const Curve& curve_of(const Cell& cell) const { return curves_[cell.chord]; }
  const Junction& junction_of(const Cell& cell) const { return junctions_[cell.chord]; }
  const Contrast& contrast() const { return contrast_; }

  CurveShape shape_of(const Cell& cell) const;

  /// The region of `inner` in a cell with a curve, as a polygon in image coordinates.
  Polygon inner_region(const Cell& cell, const CurveShape& shape) const;

  /// Area that `inner` gains, px^2, where the middles of the brackets of its ends lie beyond the sides (Bracket::excess).
  double area_beyond(const Cell& cell, const CurveShape& shape) const;

  /// Variance of the area of `inner` in px^4, from crossings, middle and legs; Curve::loose_area comes on
  /// top.
  double area_variance(const Cell& cell, const CurveShape& shape) const;

  /// Sector i of a cell with a junction, likewise.
  Polygon sector_region(const Cell& cell, int sector) const;
  /// Variance of the area that the sectors on either side of a junction's border i may have exchanged, px^4.
  double border_variance(const Cell& cell, int border) const;

 private:
  /// A position beside a side whose middle differs from its two ends: cells there must be smaller than
  /// `level`.
  struct HangingNode {
    std::int32_t x, y;
    int level;
  };

  /// Entry of a pixel's list of the cells that borders cross, in the order in which they were met.
  struct EdgeCell {
    std::uint32_t cell, next;
  };
  struct EdgeCellList {
    std::uint32_t first = kNone, last = kNone;
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // The quadtree and its vertices (edge_tracer_cells.cpp)
  void split(std::uint32_t cell);
  std::uint32_t push_cell(std::int32_t x, std::int32_t y, int level);
  std::uint32_t find_leaf(std::int32_t x, std::int32_t y) const;
  std::uint32_t leaf_at(FocalPoint point) const;
  void list_edge_cell(std::uint32_t cell);
  void vertex(std::int32_t x, std::int32_t y);
  /// Whether a position is one of the lattice's own vertices, whose labels stand in an array.
  static bool on_lattice(std::int32_t x, std::int32_t y) { return ((x | y) & (Lattice::side(0) - 1)) == 0; }
  std::size_t root_vertex(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>((y >> kMaxLevel) * (lattice_.columns() + 1) + (x >> kMaxLevel));
  }
  std::uint32_t known_vertex(std::int32_t x, std::int32_t y) const {
    return on_lattice(x, y) ? root_vertices_[root_vertex(x, y)]
                            : fine_vertices_[vertex_index_.find(Lattice::vertex_key(x, y))];
  }
  std::uint32_t label_if_known(std::int32_t x, std::int32_t y) const;
  void trace_vertices();
  void notice_hanging_nodes();
  void split_beside_hanging_nodes();

  // Growth (edge_tracer_grow.cpp)
  void grow();
  void classify(std::uint32_t cell, std::vector<std::uint32_t>& awaiting);
  void settle_complex(std::uint32_t cell);
  double reach(std::int32_t x, std::int32_t y, bool vertical, bool forward, int level,
               std::uint32_t label) const;
  bool narrow_corner(const Cell& cell) const;
  double feature_width(const Cell& cell) const;
  void end_in(std::uint32_t bracket, std::uint32_t cell);

  // Crossings (edge_tracer_brackets.cpp)
  std::uint32_t bracket_on(const Cell& cell, int side);
  std::uint32_t known_bracket(std::int32_t x, std::int32_t y, bool vertical, int level) const;
  std::size_t root_edge(std::int32_t x, std::int32_t y, bool vertical) const {
    return 2 * root_vertex(x, y) + vertical;
  }
  void locate();
  void look_into_brackets();

  // Contradictions (edge_tracer_contradict.cpp)
  bool foreign(const Cell& cell, std::uint32_t label) const;
  bool within_tolerance(const Cell& cell, FocalPoint point, std::uint32_t model, std::uint32_t seen,
                        double slack_px) const;
  bool beside_border(const Cell& cell, FocalPoint point, std::uint32_t seen, double slack_px) const;
  bool beside_legs(const Cell& cell, FocalPoint point, std::uint32_t seen, double slack_px) const;

  // Verification (edge_tracer_predict.cpp, edge_tracer_verify.cpp)
  void verify();
  void predict(CurveCheck& check);
  void weigh_answers(CurveCheck& check, const std::uint32_t* seen);
  void refuse(CurveCheck& check);
  void accept(CurveCheck& check);
  bool may_leave_pixel(const CurveCheck& check, std::uint32_t pixel) const;
  bool neighbour_end(std::uint32_t bracket, std::uint32_t cell, Point2& point) const;

  // Junctions (edge_tracer_junctions.cpp)
  void make_junction(std::uint32_t cell, const int crossed[3]);
  void crossings(const Junction& junction, Point2 crossing[3]) const;
  Point2 into_cell(const Cell& cell, Point2 p) const;
  void verify_junctions();
  double leg_tolerance(const Junction& junction, int border, Point2 leg) const;
  bool too_vague(const Junction& junction) const;
  void predict(JunctionCheck& check);
  void weigh_answers(JunctionCheck& check, const std::vector<std::uint32_t>& answers);
  void check_legs(JunctionCheck& check);
  void refuse(JunctionCheck& check);
  void accept(JunctionCheck& check);

  // The model (edge_tracer_model.cpp)
  std::uint32_t label_in(const Cell& cell, FocalPoint point) const;
  CurveEnds drawn_ends(const Curve& curve) const {
    return {end_point(curve.bracket[0]), end_point(curve.bracket[1])};
  }
  /// Where middles are predicted from.
  CurveEnds ends(const Curve& curve) const {
    return {middle_point(curve.bracket[0]), middle_point(curve.bracket[1])};
  }
  Point2 end_point(std::uint32_t bracket) const {
    const Bracket& b = brackets_[bracket];
    return b.at(b.centre());
  }
  /// The middle of a bracket, wherever it is: what end_point draws is never beyond the side, and errs inwards beside its end.
  Point2 middle_point(std::uint32_t bracket) const {
    const Bracket& b = brackets_[bracket];
    return b.at(0.5 * (b.low + b.high));
  }
  void sweep(const Cell& cell, const CurveShape& shape, double swept[2]) const;

  // Precision (edge_tracer_sharpen.cpp)
  struct CrossingTerm {
    std::uint32_t bracket;
    double variance;  ///< at first per px^2 of the bracket's width, of both cells that share it
    std::uint8_t halvings = 0;
  };
  struct MiddleTerm {
    std::uint32_t pixel, cell;
    double gain;  ///< variance per px^2 of the middle's width
  };
  struct LooseTerm {
    std::uint32_t cell;
    double variance;
    bool coherent;  ///< errs like the others of the pixel
  };
  void sharpen();
  void sharpen_pixel(std::uint32_t pixel);
  void collect_terms(std::uint32_t pixel);
  void collect_junction_terms(std::uint32_t cell);
  void add_crossing(std::uint32_t bracket, double gain);
  double split_largest_loose(std::uint32_t pixel);
  void want_halvings(double target);
  void halve_brackets();
  void share_middles(std::size_t first, std::size_t last);

  void stir(std::uint32_t pixel) { stirred_[pixel] = changed_[pixel] = 1; }
  void give_up_clutter();
  void ask(std::vector<std::uint32_t>& labels, Purpose purpose = Purpose::trace);
  void value_new_labels();

  Lattice lattice_;
  RayLedger& ledger_;
  LabelTable& table_;
  Contrast& contrast_;
  const AccuracyOptions& options_;
  const AccuracyFaults& faults_;
  std::uint64_t seed_;

  std::vector<Cell> cells_;
  std::vector<Curve> curves_;
  std::vector<Junction> junctions_;
  std::vector<Bracket> brackets_;
  FlatMap bracket_index_, vertex_index_;      // beyond the lattice's own
  std::vector<std::uint32_t> root_brackets_;  // by root_edge
  std::vector<std::uint32_t> root_vertices_;  // labels, (columns + 1) x (rows + 1)
  std::vector<std::uint32_t> fine_vertices_;  // labels of the others, in order of discovery
  std::vector<FocalPoint> pending_points_;    // fine vertices not traced yet
  std::vector<std::uint32_t> new_cells_, tentative_, open_junctions_, split_cells_;
  std::vector<HangingNode> hanging_;
  std::vector<double> allowed_variance_;
  std::vector<std::uint32_t> budget_;
  std::vector<std::uint8_t> abandoned_, suspect_;
  std::vector<std::uint8_t> followed_;  // finest level of cells that a feature was followed into; 0: none
  // Pixels whose cells, curves or brackets changed since they were sharpened.
  std::vector<std::uint8_t> stirred_;
  std::vector<std::uint8_t> changed_;  // those that changed since forget_changes()
  std::vector<std::uint8_t> due_;      // those that are being sharpened
  std::vector<double> sharpened_for_;  // allowed variance of each pixel when it was sharpened last
  bool allowed_may_differ_ = true;
  std::vector<EdgeCell> edge_cells_;
  std::vector<EdgeCellList> edge_lists_;  // by pixel

  std::vector<FocalPoint> points_, first_seen_point_;
  std::size_t valued_ = 0;  // labels below this number have a value
  // Kept for their memory.
  std::vector<std::uint32_t> seen_, active_, level_, awaiting_;
  std::vector<CurveCheck> checks_;
  std::vector<JunctionCheck> junction_checks_;
  std::vector<CrossingTerm> crossings_;
  std::vector<std::uint32_t> crossing_of_;  // by bracket: its place in crossings_, if that is of the bracket
  std::vector<MiddleTerm> middles_;
  std::vector<LooseTerm> loose_;
};

}  // namespace ifov::sampling
