#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edge_tracer.h"

namespace ifov::sampling {

namespace {

constexpr int kCornerX[4] = {0, 1, 1, 0}, kCornerY[4] = {0, 0, 1, 1};

/// Area between curve and chord that a refused curve may hide, as a share of chord^2.
constexpr double kRefusedShare = 0.12;
/// Share of the allowed standard error below which a curve that fails verification is not worth more rays.
constexpr double kLooseCurve = 0.05;
/// The same in narrow features, where a refused curve may be the near end of a long one.
constexpr double kLooseNarrowCurve = 0.02;
/// Width of the error of a middle that was predicted but not verified, as a share of the chord. Where the
/// tolerance can bear it, no ray is spent.
constexpr double kUnverifiedWidth = 0.25;
/// Only borders that go on gently on both sides may stay unverified: sagitta over chord, by either neighbour.
constexpr double kGentleBend = 0.1;
/// Likewise for what an arc loses at its pixel's rim.
constexpr double kBulge = 0.02;
/// A corner is looked for between these multiples of the predicted distance from the chord.
constexpr double kCornerNear = 0.4, kCornerFar = 1.5;

/// Curvature of a border from that found towards its two ends: their mean where they tell of one smooth
/// curve, the smaller one where a corner on one side makes them differ, none where they bend opposite ways.
double limited_mean(const double curvature[2], const double weight[2]) {
  if (weight[0] == 0.0) return curvature[1];
  if (weight[1] == 0.0) return curvature[0];
  if (curvature[0] * curvature[1] <= 0.0) return 0.0;
  const double small = std::min(std::abs(curvature[0]), std::abs(curvature[1]));
  const double large = std::max(std::abs(curvature[0]), std::abs(curvature[1]));
  if (large > 2.0 * small) return std::copysign(small, curvature[0]);
  return (weight[0] * curvature[0] + weight[1] * curvature[1]) / (weight[0] + weight[1]);
}

double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

void add_point(std::vector<FocalPoint>& points, Point2 p) { points.push_back({p.x, p.y}); }

}  // namespace

/// One tentative curve on its way through verification. Its middle is looked for on a line through the
/// chord's middle; beyond the curve on that line the label is `far`, before it `near`.
struct EdgeTracer::Check {
  enum class Stage { middle, far_side, bisect, legs, done };
  std::uint32_t cell = 0;
  Stage stage = Stage::middle;
  Ends ends;
  Point2 centre, normal;
  double chord = 0.0, least = 0.0, most = 0.0, tolerance = 0.0, predicted = 0.0;
  double low = 0.0, high = 0.0, blur = 0.0;
  std::uint32_t far = 0, near = 0;
  bool smooth = false, beyond_wrong = false, has_apex = false, corner = false, confirmed = false;
  Point2 apex;
  std::size_t first_point = 0;

  double middle() const { return 0.5 * (low + high); }

  /// From an arc to two legs that meet at the apex.
  void try_corner() {
    const Point2 to_apex = apex - centre;
    const double height = length(to_apex);
    if (dot(to_apex, normal) < 0.0) std::swap(far, near);
    normal = (1.0 / height) * to_apex;
    predicted = height;
    least = kCornerNear * height;
    most = kCornerFar * height;
    corner = true;
    has_apex = false;
    confirmed = false;
    stage = Stage::middle;
  }

  /// Next to the curve at a quarter of the way from each end, on either side: far, near, far, near.
  void add_leg_points(std::vector<FocalPoint>& points) const {
    for (const Point2 end : {ends.a, ends.b}) {
      Point2 foot, across;
      double margin = tolerance;
      if (corner) {
        const Point2 tip = centre + middle() * normal, leg = tip - end;
        const double reach = length(leg);
        foot = 0.5 * (tip + end);
        across = reach > 0.0 ? Point2{-leg.y / reach, leg.x / reach} : normal;
        if (dot(across, normal) < 0.0) across = -1.0 * across;
        margin = std::max(margin, blur);
      } else {
        foot = 0.5 * (centre + end) + (0.75 * middle()) * normal;
        across = normal;
        margin = std::max(margin, 0.15 * std::abs(middle()));
      }
      add_point(points, foot + margin * across);
      add_point(points, foot - margin * across);
    }
  }
};

void EdgeTracer::predict(Check& check) {
  const Cell& cell = cells_[check.cell];
  const Curve& curve = curves_[cell.chord];
  check.ends = ends(curve);
  const Point2 a = check.ends.a, b = check.ends.b, d = b - a;
  check.chord = length(d);
  check.centre = 0.5 * (a + b);
  if (check.chord < 1e-9) {
    accept(check);
    return;
  }
  check.normal = {-d.y / check.chord, d.x / check.chord};
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y), side = lattice_.side_px(cell.level);
  const int corner = (curve.side[0] + 1) % 4;
  const Point2 inner_corner{x0 + kCornerX[corner] * side, y0 + kCornerY[corner] * side};
  const bool inner_far = dot(inner_corner - a, check.normal) > 0.0;
  check.far = inner_far ? curve.inner : curve.outer;
  check.near = inner_far ? curve.outer : curve.inner;

  double curvature[2] = {0.0, 0.0}, weights[2] = {0.0, 0.0};
  Point2 beyond[2];
  int neighbours = 0;
  for (int end = 0; end < 2; ++end) {
    if (!neighbour_end(curve, end, beyond[end])) continue;
    const double reach = length(beyond[end] - (end == 0 ? a : b));
    if (reach <= 3.0 * brackets_[curve.bracket[end]].width()) continue;
    curvature[end] = end == 0 ? menger_curvature(beyond[0], a, b) : menger_curvature(a, b, beyond[1]);
    weights[end] = std::min(reach, check.chord);
    ++neighbours;
  }
  const double blur = 0.5 * (brackets_[curve.bracket[0]].width() + brackets_[curve.bracket[1]].width());
  check.blur = blur;
  check.tolerance =
      std::clamp(curve.wanted_middle > 0.0 ? curve.wanted_middle : blur, 1e-7, check.chord / 6.0);
  check.predicted = sagitta_of_curvature(limited_mean(curvature, weights), check.chord);
  check.most = kLargestSagitta * check.chord;
  check.least = -check.most;

  // The neighbours' chords, extended into this cell, meet at the apex of a corner.
  if (curve.corner) {
    check.apex = curve.origin + (0.5 * (curve.low + curve.high)) * curve.normal;
    check.has_apex = true;
  } else if (neighbours == 2) {
    const Point2 u = a - beyond[0], v = b - beyond[1];
    const double turn = cross(u, v);
    if (std::abs(turn) > 1e-3 * length(u) * length(v)) {
      const double s = cross(d, v) / turn, t = cross(d, u) / turn;
      check.apex = a + s * u;
      const bool inside =
          check.apex.x >= x0 && check.apex.x <= x0 + side && check.apex.y >= y0 && check.apex.y <= y0 + side;
      check.has_apex = s > 0.0 && t > 0.0 && inside &&
                       std::abs(dot(check.apex - check.centre, check.normal)) > 2.0 * check.tolerance;
    }
  }
  const double unverified_width = kUnverifiedWidth * check.chord;
  const double bend = std::max(std::abs(curvature[0]), std::abs(curvature[1])) * check.chord / 8.0;
  if (unverified_width <= curve.wanted_middle && neighbours > 0 && bend < kGentleBend &&
      !narrow_corner(cell)) {
    check.predicted = std::clamp(check.predicted, check.least, check.most);
    check.low = check.predicted - 0.5 * unverified_width;
    check.high = check.predicted + 0.5 * unverified_width;
    accept(check);
    return;
  }
  if (curve.corner || (std::abs(check.predicted) > check.most && check.has_apex)) {
    check.try_corner();
    return;
  }
  if (std::abs(check.predicted) > check.most) {
    const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
    const double worth = kLooseCurve * std::sqrt(allowed_variance_[cell.pixel]);
    if (cell.level < kMaxLevel && kRefusedShare * check.chord * check.chord * contrast > worth) {
      check.stage = Check::Stage::done;
      split(check.cell);
      return;
    }
    check.predicted = std::clamp(check.predicted, check.least, check.most);
  }
  const double disagreement = std::abs(curvature[0] - curvature[1]) * check.chord * check.chord / 8.0;
  check.smooth = neighbours == 2 && disagreement <= std::max(1.5 * std::max(check.tolerance, blur),
                                                             0.35 * std::abs(check.predicted));
}

void EdgeTracer::verify() {
  std::vector<Check> checks;
  std::vector<std::uint32_t> open;
  open.swap(tentative_);
  for (std::uint32_t cell : open) {
    if (cells_[cell].kind != CellKind::tentative || abandoned_[cells_[cell].pixel]) continue;
    Check check;
    check.cell = cell;
    predict(check);
    if (check.stage != Check::Stage::done) checks.push_back(check);
  }
  std::vector<std::uint32_t> labels;
  while (!checks.empty()) {
    for (Check& check : checks) {
      check.first_point = points_.size();
      const auto on_line = [&](double t) { add_point(points_, check.centre + t * check.normal); };
      switch (check.stage) {
        case Check::Stage::middle:
          on_line(check.predicted + check.tolerance);
          on_line(check.predicted - check.tolerance);
          break;
        case Check::Stage::far_side:
          on_line(check.beyond_wrong ? check.high : check.low);
          break;
        case Check::Stage::bisect:
          on_line(check.middle());
          break;
        case Check::Stage::legs:
          check.add_leg_points(points_);
          break;
        case Check::Stage::done:
          break;
      }
    }
    ask(labels);
    for (Check& check : checks) weigh_answers(check, &labels[check.first_point]);
    std::erase_if(checks, [](const Check& check) { return check.stage == Check::Stage::done; });
  }
}

void EdgeTracer::weigh_answers(Check& check, const std::uint32_t* seen) {
  switch (check.stage) {
    case Check::Stage::middle: {
      const bool beyond = seen[0] == check.far, before = seen[1] == check.near;
      check.low = check.predicted - check.tolerance;
      check.high = check.predicted + check.tolerance;
      if (beyond && before) {
        check.confirmed = true;
        check.stage = Check::Stage::legs;
        if (!check.corner && (check.smooth || check.chord <= 6.0 * check.tolerance)) accept(check);
      } else if (beyond == before || (!beyond && seen[0] != check.near) ||
                 (!before && seen[1] != check.far)) {
        refuse(check);
      } else {
        check.beyond_wrong = !beyond;
        check.stage = Check::Stage::far_side;
        if (check.beyond_wrong) {
          check.low = check.high;
          check.high = std::max(check.most, check.low + 2.0 * check.tolerance);
        } else {
          check.high = check.low;
          check.low = std::min(check.least, check.high - 2.0 * check.tolerance);
        }
      }
      return;
    }
    case Check::Stage::far_side:
      if (seen[0] == (check.beyond_wrong ? check.far : check.near))
        check.stage = Check::Stage::bisect;
      else
        refuse(check);
      return;
    case Check::Stage::bisect:
      (seen[0] == check.far ? check.high : check.low) = check.middle();
      if (check.high - check.low > check.tolerance) return;
      check.stage = Check::Stage::legs;
      if (check.middle() > 1.001 * check.most || check.middle() < 1.001 * check.least)
        refuse(check);
      else if (!check.corner && check.chord <= 6.0 * check.tolerance)
        accept(check);
      return;
    case Check::Stage::legs:
      if (seen[0] == check.far && seen[1] == check.near && seen[2] == check.far && seen[3] == check.near)
        accept(check);
      else
        refuse(check);
      return;
    case Check::Stage::done:
      return;
  }
}

/// The curve is not where it was looked for: a corner instead of an arc, then smaller cells, unless what may
/// be hidden matters little.
void EdgeTracer::refuse(Check& check) {
  if (check.has_apex) {
    check.try_corner();
    return;
  }
  const Cell cell = cells_[check.cell];
  Curve& curve = curves_[cell.chord];
  suspect_[cell.pixel] = 1;
  const double hidden = kRefusedShare * check.chord * check.chord;
  const bool narrow = narrow_corner(cell);
  const double share = narrow ? kLooseNarrowCurve : kLooseCurve;
  if (cell.level < kMaxLevel && hidden * contrast_(cell.pixel, curve.inner, curve.outer) >
                                    share * std::sqrt(allowed_variance_[cell.pixel])) {
    check.stage = Check::Stage::done;
    split(check.cell);
    return;
  }
  check.low = check.high = 0.0;
  check.corner = false;
  curve.loose_area = hidden;
  accept(check);
}

void EdgeTracer::accept(Check& check) {
  check.stage = Check::Stage::done;
  Cell& cell = cells_[check.cell];
  Curve& curve = curves_[cell.chord];
  curve.corner = check.corner;
  curve.origin = check.centre;
  curve.normal = check.normal;
  curve.low = check.low;
  curve.high = check.high;
  curve.middle_width = (check.confirmed ? 0.5 : 1.0) * (check.high - check.low);
  curve.leg_width = check.corner ? 2.0 * std::max(check.tolerance, check.blur) : 0.0;
  cell.kind = CellKind::chord;
  stirred_[cell.pixel] = 1;
  if (check.corner) return;

  // An arc that leaves its cell through a side with equal ends would be counted in two cells: it may do so
  // only within its own pixel.
  Point2 knots[3];
  arc_knots(check.ends.a, check.ends.b, check.middle(), knots);
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y), side = lattice_.side_px(cell.level);
  double outside = 0.0;
  for (const Point2& knot : knots)
    if (static_cast<std::uint32_t>(lattice_.pixel_at({knot.x, knot.y})) != cell.pixel)
      outside = std::max({outside, x0 - knot.x, knot.x - x0 - side, y0 - knot.y, knot.y - y0 - side});
  if (outside == 0.0) return;
  const double loss = 0.5 * outside * check.chord;
  const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
  if (cell.level < kMaxLevel && loss * contrast > kBulge * std::sqrt(allowed_variance_[cell.pixel]))
    split(check.cell);
  else
    curve.loose_area = std::max(curve.loose_area, loss);
}

}  // namespace ifov::sampling
