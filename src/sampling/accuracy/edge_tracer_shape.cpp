#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edge_tracer.h"

namespace ifov::sampling {

namespace {

constexpr int kCornerX[4] = {0, 1, 1, 0}, kCornerY[4] = {0, 0, 1, 1};
/// Share of the allowed standard error below which a whole cell may be wrong.
constexpr double kNegligible = 0.1;

}  // namespace

Point2 EdgeTracer::end_point(std::uint32_t bracket) const {
  const Bracket& b = brackets_[bracket];
  const FocalPoint p = b.at(lattice_, b.centre());
  return {p.x_px, p.y_px};
}

EdgeTracer::Ends EdgeTracer::ends(const Curve& curve) const {
  return {end_point(curve.bracket[0]), end_point(curve.bracket[1])};
}

bool EdgeTracer::neighbour_end(const Curve& curve, int end, Point2& point) const {
  const std::uint32_t shared = curve.bracket[end];
  for (std::uint32_t entry : brackets_[shared].cells) {
    if (entry == 0 || entry - 1 == curve.cell) continue;
    const Cell& cell = cells_[entry - 1];
    if (cell.kind != CellKind::tentative && cell.kind != CellKind::chord) continue;
    const Curve& next = curves_[cell.chord];
    point = end_point(next.bracket[next.bracket[0] == shared ? 1 : 0]);
    return true;
  }
  return false;
}

double EdgeTracer::sagitta(const Curve& curve, const Ends& e) const {
  const Point2 d = e.b - e.a;
  const double chord = length(d);
  if (chord == 0.0) return 0.0;
  const Point2 middle = curve.origin + (0.5 * (curve.low + curve.high)) * curve.normal;
  const Point2 from_chord = middle - 0.5 * (e.a + e.b);
  const double s = (-d.y * from_chord.x + d.x * from_chord.y) / chord;
  return std::clamp(s, -0.5 * chord, 0.5 * chord);
}

Polygon EdgeTracer::inner_region(const Cell& cell) const {
  const Curve& curve = curves_[cell.chord];
  const Ends e = ends(curve);
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y), side = lattice_.side_px(cell.level);
  Polygon region;
  region.add(e.a);
  for (int corner = curve.side[0] + 1; corner <= curve.side[1]; ++corner)
    region.add({x0 + kCornerX[corner] * side, y0 + kCornerY[corner] * side});
  region.add(e.b);
  if (cell.kind == CellKind::chord && curve.corner) {
    region.add(curve.origin + (0.5 * (curve.low + curve.high)) * curve.normal);
  } else if (cell.kind == CellKind::chord) {
    Point2 knots[3];
    arc_knots(e.a, e.b, sagitta(curve, e), knots);
    for (int i = 2; i >= 0; --i) region.add(knots[i]);
  }
  return region;
}

/// Whether a contradiction is one that the intervals already allow for: beside a border, no farther than it
/// is uncertain, or in a cell too small to matter.
bool EdgeTracer::within_tolerance(const Cell& cell, FocalPoint point, std::uint32_t model,
                                  std::uint32_t seen, double slack_px) const {
  const double side = lattice_.side_px(cell.level);
  const double error = side * side * contrast_(cell.pixel, model, seen) / std::sqrt(12.0);
  if (error < kNegligible * std::sqrt(allowed_variance_[cell.pixel])) return true;
  if (cell.kind != CellKind::chord) return false;
  const Curve& curve = curves_[cell.chord];
  if (seen != curve.inner && seen != curve.outer) return false;
  const double width =
      std::max({brackets_[curve.bracket[0]].width(), brackets_[curve.bracket[1]].width(),
                2.0 * curve.middle_width, curve.leg_width}) +
      slack_px;
  const Polygon region = inner_region(cell);
  const int first = curve.side[1] - curve.side[0] + 1;  // from the end of the curve back to its start
  for (int i = first; i < region.count; ++i) {
    const Point2 p = region.vertex[i], d = region.vertex[(i + 1) % region.count] - p;
    const Point2 to{point.x_px - p.x, point.y_px - p.y};
    const double square = d.x * d.x + d.y * d.y;
    const double t = square > 0.0 ? std::clamp((to.x * d.x + to.y * d.y) / square, 0.0, 1.0) : 0.0;
    if (length(to - t * d) <= width) return true;
  }
  return false;
}

/// Length swept per unit of motion of an end along its side: an arc whose middle was predicted from its ends
/// moves with them as a whole, at right angles to itself. Half of the area is this cell's and the cell beyond
/// errs the same way, hence the factor 1/2 of its variance instead of 1/4.
double EdgeTracer::sweep(const Cell& cell, const Ends& e, int end) const {
  const Curve& curve = curves_[cell.chord];
  const Point2 d = e.b - e.a;
  const double c = length(d);
  double half_angle = 0.0;
  if (cell.kind == CellKind::chord && !curve.corner && c > 0.0) {
    const double s = sagitta(curve, e);
    half_angle = (end == 0 ? 1.0 : -1.0) * 2.0 * std::atan(2.0 * s / c);
  }
  // The tangent at the end is the chord turned towards the bulge.
  const double cosine = std::cos(half_angle), sine = std::sin(half_angle);
  const Point2 tangent{d.x * cosine - d.y * sine, d.x * sine + d.y * cosine};
  const double stretch = half_angle == 0.0 ? 1.0 : half_angle / sine;
  return stretch * std::abs(brackets_[curve.bracket[end]].vertical ? tangent.x : tangent.y);
}

double EdgeTracer::area_variance(const Cell& cell) const {
  const Curve& curve = curves_[cell.chord];
  const Ends e = ends(curve);
  const Point2 d = e.b - e.a;
  double variance = 0.0;
  for (int t = 0; t < 2; ++t) {
    const double swept = sweep(cell, e, t), width = brackets_[curve.bracket[t]].width();
    variance += 0.5 * swept * swept * width * width / 12.0;
  }
  // The area under an arc is 2/3 chord * height, under a corner 1/2.
  const double lens =
      (curve.corner ? 0.5 * std::abs(cross(d, curve.normal)) : 2.0 / 3.0 * length(d)) * curve.middle_width;
  // A leg that bends by its band's width in the middle moves half of leg * width.
  const double leg = 0.25 * length(d) * curve.leg_width;
  return variance + lens * lens / 12.0 + 2.0 * leg * leg / 12.0;
}

}  // namespace ifov::sampling
