#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed standard error that a refused curve may hide in a narrow feature, where it may be the
/// near end of a long one.
constexpr double kLooseNarrowCurve = 0.02;
/// Likewise for what an arc loses at its pixel's rim.
constexpr double kBulge = 0.02;

}  // namespace

void EdgeTracer::verify() {
  checks_.clear();
  checks_.reserve(tentative_.size());
  for (std::uint32_t cell : tentative_) {
    if (cells_[cell].kind != CellKind::tentative || abandoned_[cells_[cell].pixel]) continue;
    CurveCheck& check = checks_.emplace_back();
    check.cell = cell;
  }
  tentative_.clear();
  active_.clear();
  for (std::uint32_t i = 0; i < checks_.size(); ++i) {
    predict(checks_[i]);
    if (checks_[i].stage != CurveCheck::Stage::done) active_.push_back(i);
  }
  while (!active_.empty()) {
    for (std::uint32_t i : active_) {
      checks_[i].first_point = points_.size();
      checks_[i].add_points(points_);
    }
    ask(seen_);
    std::size_t still = 0;
    for (std::uint32_t i : active_) {
      weigh_answers(checks_[i], &seen_[checks_[i].first_point]);
      if (checks_[i].stage != CurveCheck::Stage::done) active_[still++] = i;
    }
    active_.resize(still);
  }
}

void EdgeTracer::weigh_answers(CurveCheck& check, const std::uint32_t* seen) {
  switch (check.stage) {
    case CurveCheck::Stage::middle: {
      const bool beyond = seen[0] == check.far, before = seen[1] == check.near;
      check.low = check.predicted - check.tolerance;
      check.high = check.predicted + check.tolerance;
      if (beyond && before) {
        check.confirmed = true;
        check.stage = CurveCheck::Stage::legs;
        if (!check.corner && (check.smooth || check.chord <= 6.0 * check.tolerance)) accept(check);
      } else if (beyond == before || (!beyond && seen[0] != check.near) ||
                 (!before && seen[1] != check.far)) {
        refuse(check);
      } else {
        check.beyond_wrong = !beyond;
        check.stage = CurveCheck::Stage::far_side;
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
    case CurveCheck::Stage::far_side:
      if (seen[0] == (check.beyond_wrong ? check.far : check.near))
        check.stage = CurveCheck::Stage::bisect;
      else
        refuse(check);
      return;
    case CurveCheck::Stage::bisect:
      (seen[0] == check.far ? check.high : check.low) = check.middle();
      if (check.high - check.low > check.tolerance) return;
      check.measured = true;
      check.stage = CurveCheck::Stage::legs;
      if (check.middle() > 1.001 * check.most || check.middle() < 1.001 * check.least)
        refuse(check);
      else if (!check.corner && check.chord <= 6.0 * check.tolerance)
        accept(check);
      return;
    case CurveCheck::Stage::legs:
      if (seen[0] == check.far && seen[1] == check.near && seen[2] == check.far && seen[3] == check.near)
        accept(check);
      else
        refuse(check);
      return;
    case CurveCheck::Stage::done: return;
  }
}

/// The curve is not where it was looked for: a corner instead of an arc, then smaller cells, unless what may
/// be hidden matters little.
void EdgeTracer::refuse(CurveCheck& check) {
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
    check.stage = CurveCheck::Stage::done;
    split(check.cell);
    return;
  }
  check.low = check.high = 0.0;
  check.corner = false;
  check.measured = true;
  curve.loose_area = hidden;
  accept(check);
}

void EdgeTracer::accept(CurveCheck& check) {
  check.stage = CurveCheck::Stage::done;
  Cell& cell = cells_[check.cell];
  Curve& curve = curves_[cell.chord];
  curve.corner = check.corner;
  curve.origin = check.centre;
  curve.normal = check.normal;
  curve.low = check.low;
  curve.high = check.high;
  curve.bend = check.middle();
  curve.measured = check.measured;
  curve.middle_width = (check.confirmed ? check.smooth ? 0.4 : 0.5 : 1.0) * (check.high - check.low);
  curve.leg_width = check.corner ? 2.0 * std::max(check.tolerance, check.blur) : 0.0;
  cell.kind = CellKind::chord;
  stir(cell.pixel);
  if (check.corner) return;

  // An arc that leaves its cell through a side with equal ends would be counted in two cells: it may do so
  // only within its own pixel.
  if (!may_leave_pixel(check, cell.pixel)) return;
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

/// False where the arc, its sagitta half as large again (more than its knots are ever scaled by), stays
/// inside.
bool EdgeTracer::may_leave_pixel(const CurveCheck& check, std::uint32_t pixel) const {
  const PixelRect& domain = lattice_.domain();
  const double x0 = domain.x0 + static_cast<int>(pixel) % domain.width();
  const double y0 = domain.y0 + static_cast<int>(pixel) / domain.width();
  const Point2 reach = (1.5 * check.middle()) * check.normal;
  for (const Point2 p : {check.ends.a + reach, check.ends.b + reach, check.ends.a, check.ends.b})
    if (p.x <= x0 || p.x >= x0 + 1.0 || p.y <= y0 || p.y >= y0 + 1.0) return true;
  return false;
}

}  // namespace ifov::sampling
