#include "sampling/accuracy/edges/curve_verifier.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/point_queries.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/curve_predictor.h"
#include "sampling/accuracy/edges/narrow_features.h"

namespace ifov::sampling {

namespace {

/// Share of the allowed standard error that a refused curve may hide in a narrow feature, where it may be the
/// near end of a long one.
constexpr double kLooseNarrowCurve = 0.02;
/// Likewise for what an arc loses at its pixel's rim.
constexpr double kBulge = 0.02;
/// Corners of features that are narrower than this, in px, are not told from arcs: rods have many such borders, and a corner in each
/// is no longer than they are wide.
constexpr double kWideForCorners = 0.15;

}  // namespace

void CurveVerifier::verify(std::vector<std::uint32_t>& cells) {
  checks_.clear();
  checks_.reserve(cells.size());
  for (std::uint32_t cell : cells) {
    if (tree_[cell].kind != CellKind::tentative || pixels_.abandoned(tree_[cell].pixel)) continue;
    CurveCheck& check = checks_.emplace_back();
    check.cell = cell;
  }
  cells.clear();
  active_.clear();
  for (std::uint32_t i = 0; i < checks_.size(); ++i) {
    begin(checks_[i]);
    if (checks_[i].stage != CurveCheck::Stage::done) active_.push_back(i);
  }
  while (!active_.empty()) {
    std::vector<FocalPoint>& points = queries_.points();
    for (std::uint32_t i : active_) {
      checks_[i].first_point = points.size();
      checks_[i].add_points(points);
    }
    const std::vector<std::uint32_t>& seen = queries_.ask();
    std::size_t still = 0;
    for (std::uint32_t i : active_) {
      weigh_answers(checks_[i], &seen[checks_[i].first_point]);
      if (checks_[i].stage != CurveCheck::Stage::done) active_[still++] = i;
    }
    active_.resize(still);
  }
}

void CurveVerifier::begin(CurveCheck& check) {
  const Curve& curve = model_.curve_of(tree_[check.cell]);
  check.may_have_corners = queries_.may_have_corners(curve.inner, curve.outer) &&
                           features_.width_at(tree_[check.cell]) > kWideForCorners;
  switch (predictor_.predict(check)) {
    case CurvePredictor::Verdict::look: break;
    case CurvePredictor::Verdict::accept: accept(check); break;
    case CurvePredictor::Verdict::split:
      check.stage = CurveCheck::Stage::done;
      tree_.split(check.cell);
      break;
  }
}

void CurveVerifier::weigh_answers(CurveCheck& check, const std::uint32_t* seen) {
  switch (check.stage) {
    case CurveCheck::Stage::middle: {
      const bool beyond = seen[0] == check.far, before = seen[1] == check.near;
      check.low = check.predicted - check.tolerance;
      check.high = check.predicted + check.tolerance;
      if (beyond && before) {
        check.confirmed = true;
        follow(check);
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
      // Halves of twice the tolerance are not to depend on rounding.
      if (check.high - check.low > 1.000001 * check.tolerance) return;
      check.measured = true;
      if (check.middle() > 1.001 * check.most || check.middle() < 1.001 * check.least)
        refuse(check);
      else
        follow(check);
      return;
    case CurveCheck::Stage::arc_or_corner:
      if (check.corners_seen(seen) == 0) {
        if (check.note_arc())
          follow_arc(check);
        else
          check.stage = CurveCheck::Stage::legs;
      } else if (check.corners_seen(seen) == 1) {
        check.stage = CurveCheck::Stage::legs;
      } else if (!check.knows_height()) {
        check.tolerance = std::min(check.tolerance, kKnownHeight * std::abs(check.middle()));
        check.confirmed = false;  // it is searched for from here on
        check.stage = CurveCheck::Stage::bisect;
      } else {
        check.apex = check.centre + check.middle() * check.normal;
        check.try_corner();
      }
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

/// Its middle is known: whether it is bent as it is taken to be.
void CurveVerifier::follow(CurveCheck& check) {
  if (check.may_be_corner())
    check.stage = CurveCheck::Stage::arc_or_corner;
  else
    follow_arc(check);
}

void CurveVerifier::follow_arc(CurveCheck& check) {
  check.stage = CurveCheck::Stage::legs;
  const double height = std::abs(check.middle());
  if (!check.corner && height > kSteep * check.chord) {
    const Cell& cell = tree_[check.cell];
    const Curve& curve = model_.curve_of(cell);
    const double enclosed =
                     2.0 / 3.0 * check.chord * height * contrast_(cell.pixel, curve.inner, curve.outer),
                 skew = std::sqrt(kLooseSkew * pixels_.allowed_deviation(cell.pixel) / (kOfSkew * enclosed));
    const bool of_circle = check.confirmed && kSkewOfCurvatures * check.unevenness <= skew;
    if (skew < kUsualSkew && !of_circle) {
      check.most_skew = skew;
      return;
    }
  }
  if (check.corner_matters) return;
  if (!check.corner && ((check.confirmed && check.smooth) || check.chord <= 6.0 * check.tolerance))
    accept(check);
}

/// The curve is not where it was looked for: a corner instead of an arc, then smaller cells, unless what may
/// be hidden matters little.
void CurveVerifier::refuse(CurveCheck& check) {
  if (check.has_apex) {
    check.try_corner();
    return;
  }
  const Cell cell = tree_[check.cell];
  Curve& curve = model_.curve_of(cell);
  pixels_.note_suspect(cell.pixel);
  const double hidden = kRefusedShare * check.chord * check.chord;
  const bool narrow = features_.has_corner_of(cell);
  const double share = narrow ? kLooseNarrowCurve : kLooseCurve;
  if (cell.level < kMaxLevel && hidden * contrast_(cell.pixel, curve.inner, curve.outer) >
                                    share * pixels_.allowed_deviation(cell.pixel)) {
    check.stage = CurveCheck::Stage::done;
    tree_.split(check.cell);
    return;
  }
  check.low = check.high = 0.0;
  check.corner = false;
  check.measured = true;
  curve.loose_area = hidden;
  accept(check);
}

void CurveVerifier::accept(CurveCheck& check) {
  check.stage = CurveCheck::Stage::done;
  Cell& cell = tree_[check.cell];
  Curve& curve = model_.curve_of(cell);
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
  pixels_.stir(cell.pixel);
  if (check.corner) return;

  // An arc that leaves its cell through a side with equal ends would be counted in two cells: it may do so
  // only within its own pixel.
  if (!may_leave_pixel(check, cell.pixel)) return;
  Point2 knots[3];
  arc_knots(check.ends.a, check.ends.b, check.middle(), knots);
  const double x0 = tree_.lattice().x_px(cell.x), y0 = tree_.lattice().y_px(cell.y),
               side = tree_.lattice().side_px(cell.level);
  double outside = 0.0;
  for (const Point2& knot : knots)
    if (static_cast<std::uint32_t>(tree_.lattice().pixel_at({knot.x, knot.y})) != cell.pixel)
      outside = std::max({outside, x0 - knot.x, knot.x - x0 - side, y0 - knot.y, knot.y - y0 - side});
  if (outside == 0.0) return;
  const double loss = 0.5 * outside * check.chord;
  const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
  if (cell.level < kMaxLevel && loss * contrast > kBulge * pixels_.allowed_deviation(cell.pixel))
    tree_.split(check.cell);
  else
    curve.loose_area = std::max(curve.loose_area, loss);
}

/// False where the arc, its sagitta half as large again (more than its knots are ever scaled by), stays
/// inside.
bool CurveVerifier::may_leave_pixel(const CurveCheck& check, std::uint32_t pixel) const {
  const PixelRect& domain = tree_.lattice().domain();
  const double x0 = domain.x0 + static_cast<int>(pixel) % domain.width();
  const double y0 = domain.y0 + static_cast<int>(pixel) / domain.width();
  const Point2 reach = (1.5 * check.middle()) * check.normal;
  for (const Point2 p : {check.ends.a + reach, check.ends.b + reach, check.ends.a, check.ends.b})
    if (p.x <= x0 || p.x >= x0 + 1.0 || p.y <= y0 || p.y >= y0 + 1.0) return true;
  return false;
}

}  // namespace ifov::sampling
