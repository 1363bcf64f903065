#include "sampling/accuracy/borders/border_model.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

std::uint32_t BorderModel::add(const Curve& curve) {
  curves_.push_back(curve);
  return static_cast<std::uint32_t>(curves_.size() - 1);
}

std::uint32_t BorderModel::add(const Junction& junction) {
  junctions_.push_back(junction);
  return static_cast<std::uint32_t>(junctions_.size() - 1);
}

bool BorderModel::neighbour_end(std::uint32_t shared, std::uint32_t from, Point2& point) const {
  for (std::uint32_t entry : brackets_[shared].cells) {
    if (entry == 0 || entry - 1 == from) continue;
    const Cell& cell = tree_[entry - 1];
    if (cell.kind == CellKind::junction && junctions_[cell.chord].located) {
      point = junctions_[cell.chord].at;
      return true;
    }
    if (cell.kind != CellKind::tentative && cell.kind != CellKind::chord) continue;
    const Curve& next = curves_[cell.chord];
    point = brackets_.middle_point(next.bracket[next.bracket[0] == shared ? 1 : 0]);
    return true;
  }
  return false;
}

CurveShape BorderModel::shape_of(const Cell& cell) const {
  const Curve& curve = curves_[cell.chord];
  CurveShape shape{brackets_.end_point(curve.bracket[0]), brackets_.end_point(curve.bracket[1])};
  const Point2 d = shape.b - shape.a;
  shape.chord = length(d);
  if (cell.kind != CellKind::chord || curve.corner || shape.chord == 0.0) return shape;
  double s = curve.bend;
  if (curve.measured) {
    // The drawn arc is moved with its ends (area_beyond): what was measured is not.
    const CurveEnds whole = ends(curve);
    s = 0.5 * (curve.low + curve.high) - dot(0.5 * (whole.a + whole.b) - curve.origin, curve.normal);
  }
  s *= (-d.y * curve.normal.x + d.x * curve.normal.y) / shape.chord;
  shape.sagitta = std::clamp(s, -0.5 * shape.chord, 0.5 * shape.chord);
  return shape;
}

Polygon BorderModel::inner_region(const Cell& cell, const CurveShape& shape) const {
  const Curve& curve = curves_[cell.chord];
  return region_beside(cell, shape, curve.side[0] + 1, curve.side[1], false);
}

Polygon BorderModel::outer_region(const Cell& cell, const CurveShape& shape) const {
  const Curve& curve = curves_[cell.chord];
  return region_beside(cell, shape, curve.side[1] + 1, curve.side[0] + 4, true);
}

Polygon BorderModel::region_beside(const Cell& cell, const CurveShape& shape, int first, int last,
                                   bool outer) const {
  const Curve& curve = curves_[cell.chord];
  const double x0 = tree_.lattice().x_px(cell.x), y0 = tree_.lattice().y_px(cell.y),
               side = tree_.lattice().side_px(cell.level);
  Polygon region;
  region.add(outer ? shape.b : shape.a);
  for (int corner = first; corner <= last; ++corner)
    region.add({x0 + kCornerX[corner % 4] * side, y0 + kCornerY[corner % 4] * side});
  region.add(outer ? shape.a : shape.b);
  if (cell.kind == CellKind::chord && curve.corner) {
    region.add(curve.origin + (0.5 * (curve.low + curve.high)) * curve.normal);
  } else if (cell.kind == CellKind::chord) {
    Point2 knots[3];
    arc_knots(shape.a, shape.b, shape.sagitta, knots);
    for (int i = 0; i < 3; ++i) region.add(knots[outer ? i : 2 - i]);
  }
  return region;
}

/// Length swept per unit of motion of each end along its side: an arc whose middle was predicted from its
/// ends moves with them as a whole, at right angles to itself. Half of the area is this cell's and the cell
/// beyond errs the same way, hence the factor 1/2 of its variance instead of 1/4.
void BorderModel::sweep(const Cell& cell, const CurveShape& shape, double swept[2]) const {
  const Curve& curve = curves_[cell.chord];
  const Point2 d = shape.b - shape.a;
  double sine = 0.0, cosine = 1.0, stretch = 1.0;
  if (cell.kind == CellKind::chord && !curve.corner && shape.chord > 0.0) {
    const double t = 2.0 * shape.sagitta / shape.chord;  // tangent of a quarter of the arc's angle
    cosine = (1.0 - t * t) / (1.0 + t * t);
    sine = 2.0 * t / (1.0 + t * t);
    stretch = atan_over_argument(t) * (1.0 + t * t);  // half of the arc's angle over its sine
  }
  // The tangent at the end is the chord turned towards the bulge.
  for (int end = 0; end < 2; ++end, sine = -sine) {
    const Point2 tangent{d.x * cosine - d.y * sine, d.x * sine + d.y * cosine};
    swept[end] = stretch * std::abs(brackets_[curve.bracket[end]].vertical ? tangent.x : tangent.y);
  }
}

void BorderModel::sweep_at_most(const Cell& cell, const CurveShape& shape, double swept[2]) const {
  sweep(cell, shape, swept);
  const Curve& curve = curves_[cell.chord];
  const double widths[2] = {brackets_[curve.bracket[0]].width(), brackets_[curve.bracket[1]].width()};
  constexpr double kShort = 0.1;
  if (shape.chord > kShort * std::max(widths[0], widths[1])) return;
  for (int end = 0; end < 2; ++end) swept[end] = std::max(swept[end], 0.5 * widths[1 - end]);
}

double BorderModel::area_beyond(const Cell& cell, const CurveShape& shape) const {
  const Curve& curve = curves_[cell.chord];
  double area = 0.0, swept[2];
  sweep(cell, shape, swept);
  for (int t = 0; t < 2; ++t) {
    // Going round, `inner` begins behind the first end and stops at the second; sides 2 and 3 are measured backwards.
    const bool backwards = curve.side[t] >= 2;
    const double sign = (t == 1) != backwards ? 1.0 : -1.0;
    area += sign * 0.5 * swept[t] * brackets_[curve.bracket[t]].excess();
  }
  return area;
}

double BorderModel::area_variance(const Cell& cell, const CurveShape& shape) const {
  const Curve& curve = curves_[cell.chord];
  const Point2 d = shape.b - shape.a;
  double variance = 0.0, swept[2];
  sweep_at_most(cell, shape, swept);
  for (int t = 0; t < 2; ++t) {
    const double width = brackets_[curve.bracket[t]].width();
    variance += 0.5 * swept[t] * swept[t] * width * width / 12.0;
  }
  // The area under an arc is 2/3 chord * height, under a corner 1/2.
  const double lens =
      (curve.corner ? 0.5 * std::abs(cross(d, curve.normal)) : 2.0 / 3.0 * shape.chord) * curve.middle_width;
  // A leg that bends by its band's width in the middle moves half of leg * width.
  const double leg = 0.25 * shape.chord * curve.leg_width;
  return variance + lens * lens / 12.0 + 2.0 * leg * leg / 12.0;
}

void BorderModel::crossings(const Junction& junction, Point2 crossing[3]) const {
  for (int i = 0; i < 3; ++i) crossing[i] = brackets_.end_point(junction.bracket[i]);
}

Polygon BorderModel::sector_region(const Cell& cell, int sector) const {
  const Junction& junction = junctions_[cell.chord];
  const double x0 = tree_.lattice().x_px(cell.x), y0 = tree_.lattice().y_px(cell.y),
               side = tree_.lattice().side_px(cell.level);
  const int next = (sector + 1) % 3, last = junction.side[next] + (next == 0 ? 4 : 0);
  Polygon region;
  region.add(brackets_.end_point(junction.bracket[sector]));
  for (int corner = junction.side[sector] + 1; corner <= last; ++corner)
    region.add({x0 + kCornerX[corner % 4] * side, y0 + kCornerY[corner % 4] * side});
  region.add(brackets_.end_point(junction.bracket[next]));
  region.add(junction.at);
  return region;
}

double BorderModel::border_variance(const Cell& cell, int border) const {
  const Junction& junction = junctions_[cell.chord];
  Point2 crossing[3];
  crossings(junction, crossing);
  const Bracket& bracket = brackets_[junction.bracket[border]];
  const Point2 leg = junction.at - crossing[border];
  const double swept = std::abs(bracket.vertical ? leg.x : leg.y) * bracket.width();
  const double lens = 2.0 / 3.0 * length(leg) * junction.leg_width[border];
  const double moved = kJunctionClaim * junction.width;
  return (0.5 * swept * swept + lens * lens + exchanged_by_motion(crossing, border) * moved * moved) / 12.0;
}

std::uint32_t BorderModel::label_in(const Cell& cell, FocalPoint point) const {
  if (cell.kind == CellKind::uniform) return cell.corner[0];
  if (cell.kind == CellKind::complex || cell.kind == CellKind::fresh) return kNoLabel;
  if (cell.kind == CellKind::junction) {
    const Junction& junction = junctions_[cell.chord];
    int sector = 0;
    while (sector < 2 && !sector_region(cell, sector).contains({point.x_px, point.y_px})) ++sector;
    return junction.sector[sector];
  }
  const Curve& curve = curves_[cell.chord];
  return inner_region(cell, shape_of(cell)).contains({point.x_px, point.y_px}) ? curve.inner : curve.outer;
}

}  // namespace ifov::sampling
