#include "sampling/accuracy/edges/contradictions.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/traced_pixels.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed standard error below which a strip as wide as a cell, from side to side of a pixel, may be wrong.
constexpr double kNegligible = 0.1;
/// Allowed standard errors that a tip, of half the area of its square, may hide where nothing is followed from beyond.
constexpr double kTip = 0.5;

}  // namespace

bool Contradictions::disagrees(FocalPoint point, std::uint32_t label, double slack_px) const {
  const Cell& cell = model_.tree()[model_.tree().leaf_at(point)];
  const std::uint32_t model = model_.label_in(cell, point);
  const bool unlike = model == kNoLabel
                          ? foreign(cell, label)
                          : model != label && !within_tolerance(cell, point, model, label, slack_px);
  return unlike && !under_arc_beside(cell, point, label, slack_px);
}

bool Contradictions::matters(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const {
  return a != b && model_.tree().lattice().side_px(0) * contrast_(pixel, a, b) * kUniformSpread >
                       kNegligible * pixels_.allowed_deviation(pixel);
}

double Contradictions::tip_that_matters(std::uint32_t pixel, std::uint32_t a, std::uint32_t b) const {
  const double contrast = contrast_(pixel, a, b);
  return contrast > 0.0 ? std::sqrt(2.0 * kTip / contrast) : INFINITY;
}

double Contradictions::dismissed(FocalPoint point, std::uint32_t label) const {
  const Cell& cell = model_.tree()[model_.tree().leaf_at(point)];
  if (pixels_.abandoned(cell.pixel)) return 0.0;
  const std::uint32_t model = model_.label_in(cell, point);
  if (model == label) return 0.0;
  if (under_arc_beside(cell, point, label, 0.0)) return 0.0;
  if (model == kNoLabel) {
    // What the corners say of a complex cell is part of its variance.
    if (std::find(cell.corner, cell.corner + 4, label) != cell.corner + 4) return 0.0;
    return contrast_(cell.pixel, cell.corner[0], label);
  }
  return beside_border(cell, point, label, 0.0) ? 0.0 : contrast_(cell.pixel, model, label);
}

/// Whether a label that no corner of a complex cell has would matter in it.
bool Contradictions::foreign(const Cell& cell, std::uint32_t label) const {
  if (cell.kind != CellKind::complex) return false;
  double contrast = 0.0;
  for (std::uint32_t corner : cell.corner) {
    if (corner == label) return false;
    contrast = std::max(contrast, contrast_(cell.pixel, corner, label));
  }
  const double side_px = model_.tree().lattice().side_px(cell.level),
               allowed = pixels_.allowed_deviation(cell.pixel);
  // Corners that look alike claim no error for the cell: what else is met in it counts as in one of a single label.
  if (kUniformSpread * side_px * contrast_.among(cell.pixel, cell.corner) < kNegligible * allowed)
    return kUniformSpread * side_px * contrast > kNegligible * allowed;
  return kUniformSpread * side_px * side_px * contrast > kLooseCell * allowed;
}

/// Whether a contradiction is one that the intervals already allow for: beside a border, no farther than it
/// is uncertain, or in a cell too small to matter.
bool Contradictions::within_tolerance(const Cell& cell, FocalPoint point, std::uint32_t model,
                                      std::uint32_t seen, double slack_px) const {
  const double side = model_.tree().lattice().side_px(cell.level);
  const double error = side * contrast_(cell.pixel, model, seen) / std::sqrt(12.0);
  if (error < kNegligible * pixels_.allowed_deviation(cell.pixel)) return true;
  return beside_border(cell, point, seen, slack_px);
}

/// Whether a point lies no farther from a border in its cell than the border is uncertain, with what is on its other side.
bool Contradictions::beside_border(const Cell& cell, FocalPoint point, std::uint32_t seen,
                                   double slack_px) const {
  if (cell.kind == CellKind::junction) return beside_legs(cell, point, seen, slack_px);
  if (cell.kind != CellKind::chord) return false;
  const Curve& curve = model_.curve_of(cell);
  const BracketStore& brackets = model_.brackets();
  if (seen != curve.inner && seen != curve.outer) return false;
  const double width = std::max({brackets[curve.bracket[0]].width(), brackets[curve.bracket[1]].width(),
                                 2.0 * curve.middle_width, curve.leg_width}) +
                       slack_px;
  const Polygon region = model_.inner_region(cell, model_.shape_of(cell));
  const int first = curve.side[1] - curve.side[0] + 1;  // from the end of the curve back to its start
  for (int i = first; i < region.count; ++i) {
    if (distance_to_segment({point.x_px, point.y_px}, region.vertex[i],
                            region.vertex[(i + 1) % region.count]) <= width)
      return true;
  }
  return false;
}

/// Whether the arc of a cell beside this one reaches over the point, which is counted there: a round thing that looks in between two
/// vertices.
bool Contradictions::under_arc_beside(const Cell& cell, FocalPoint point, std::uint32_t seen,
                                      double slack_px) const {
  const Lattice& lattice = model_.tree().lattice();
  const double x0 = lattice.x_px(cell.x), y0 = lattice.y_px(cell.y), side = lattice.side_px(cell.level),
               just_px = 0.5 * lattice.unit_px();
  for (const FocalPoint beyond : {FocalPoint{point.x_px, y0 - just_px},
                                  {point.x_px, y0 + side + just_px},
                                  {x0 - just_px, point.y_px},
                                  {x0 + side + just_px, point.y_px}}) {
    const PixelRect& domain = lattice.domain();
    if (beyond.x_px < domain.x0 || beyond.y_px < domain.y0 || beyond.x_px >= domain.x1 ||
        beyond.y_px >= domain.y1)
      continue;
    const Cell& next = model_.tree()[model_.tree().leaf_at(beyond)];
    if (next.pixel == cell.pixel && next.kind == CellKind::chord && under_arc(next, point, seen, slack_px))
      return true;
  }
  return false;
}

bool Contradictions::under_arc(const Cell& cell, FocalPoint point, std::uint32_t seen,
                               double slack_px) const {
  const Curve& curve = model_.curve_of(cell);
  if (curve.corner || (seen != curve.inner && seen != curve.outer)) return false;
  const CurveShape shape = model_.shape_of(cell);
  Point2 knots[3];
  arc_knots(shape.a, shape.b, shape.sagitta, knots);
  const Point2 p{point.x_px, point.y_px}, d = shape.b - shape.a;
  Polygon bulge;
  bulge.add(shape.a);
  for (const Point2 knot : knots) bulge.add(knot);
  bulge.add(shape.b);
  // What lies on the chord's other side.
  const Polygon inner = model_.inner_region(cell, {shape.a, shape.b, shape.chord, 0.0});
  Point2 middle{};
  for (int i = 0; i < inner.count; ++i) middle = middle + (1.0 / inner.count) * inner.vertex[i];
  const bool inner_bulges = cross(d, middle - shape.a) * cross(d, knots[1] - shape.a) < 0.0;
  if (seen != (inner_bulges ? curve.inner : curve.outer)) return false;
  if (bulge.contains(p)) return true;
  const double width = 2.0 * curve.middle_width + slack_px;
  for (int i = 0; i + 1 < bulge.count; ++i)
    if (distance_to_segment(p, bulge.vertex[i], bulge.vertex[i + 1]) <= width) return true;
  return false;
}

bool Contradictions::beside_legs(const Cell& cell, FocalPoint point, std::uint32_t seen,
                                 double slack_px) const {
  const Junction& junction = model_.junction_of(cell);
  const BracketStore& brackets = model_.brackets();
  if (std::find(junction.sector, junction.sector + 3, seen) == junction.sector + 3) return false;
  const Point2 p{point.x_px, point.y_px};
  for (int i = 0; i < 3; ++i) {
    const double blur = brackets[junction.bracket[i]].width();
    const double width = std::max({blur, 2.0 * junction.width, 2.0 * junction.leg_width[i]}) + slack_px;
    if (distance_to_segment(p, brackets.end_point(junction.bracket[i]), junction.at) <= width) return true;
  }
  return false;
}

}  // namespace ifov::sampling
