#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edge_tracer.h"

namespace ifov::sampling {

namespace {

constexpr int kCornerX[4] = {0, 1, 1, 0}, kCornerY[4] = {0, 0, 1, 1};

/// Area between curve and chord that a refused curve may hide, as a share of chord^2.
constexpr double kRefusedShare = 0.12;
/// Share of the allowed standard error below which a curve that fails verification is not worth more rays.
constexpr double kLooseCurve = 0.2;

}  // namespace

/// One tentative curve on its way through verification.
struct EdgeTracer::Check {
  enum class Stage { middle, far_side, bisect, quarters, done };
  std::uint32_t cell = 0;
  Stage stage = Stage::middle;
  Ends ends;
  Point2 centre, normal;
  double chord = 0.0, reach = 0.0, tolerance = 0.0, predicted = 0.0, sagitta = 0.0;
  double low = 0.0, high = 0.0;
  std::uint32_t left = 0, right = 0;  // labels on the side of the normal and on the other
  bool smooth = false, up_wrong = false;
  std::size_t first_point = 0;
};

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

void EdgeTracer::predict(Check& check) {
  const Cell& cell = cells_[check.cell];
  const Curve& curve = curves_[cell.chord];
  check.ends = ends(curve);
  const Point2 a = check.ends.a, b = check.ends.b, d = b - a;
  check.chord = length(d);
  check.centre = 0.5 * (a + b);
  const double floor_px = 1e-9;
  if (check.chord < floor_px) {
    check.stage = Check::Stage::done;
    return;
  }
  check.normal = {-d.y / check.chord, d.x / check.chord};
  const double side = lattice_.side_px(cell.level);
  const int corner = (curve.side[0] + 1) % 4;
  const Point2 inner_corner{lattice_.x_px(cell.x) + kCornerX[corner] * side,
                            lattice_.y_px(cell.y) + kCornerY[corner] * side};
  const Point2 to_corner = inner_corner - a;
  const bool inner_left = to_corner.x * check.normal.x + to_corner.y * check.normal.y > 0.0;
  check.left = inner_left ? curve.inner : curve.outer;
  check.right = inner_left ? curve.outer : curve.inner;

  double curvature[2] = {0.0, 0.0}, weighted = 0.0, weight = 0.0;
  int neighbours = 0;
  for (int end = 0; end < 2; ++end) {
    Point2 beyond;
    if (!neighbour_end(curve, end, beyond)) continue;
    const double reach = length(beyond - (end == 0 ? a : b));
    const double blur = brackets_[curve.bracket[end]].width();
    if (reach <= 3.0 * blur) continue;
    curvature[end] = end == 0 ? menger_curvature(beyond, a, b) : menger_curvature(a, b, beyond);
    const double w = std::min(reach, check.chord);
    weighted += w * curvature[end];
    weight += w;
    ++neighbours;
  }
  check.predicted = weight > 0.0 ? sagitta_of_curvature(weighted / weight, check.chord) : 0.0;
  check.reach = kLargestSagitta * check.chord;
  const double blur = 0.5 * (brackets_[curve.bracket[0]].width() + brackets_[curve.bracket[1]].width());
  check.tolerance =
      std::clamp(curve.wanted_middle > 0.0 ? curve.wanted_middle : blur, 1e-7, check.chord / 6.0);

  const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
  const double worth = kLooseCurve * std::sqrt(allowed_variance_[cell.pixel]);
  if (std::abs(check.predicted) > check.reach && weight > 0.0) {
    if (cell.level < kMaxLevel && kRefusedShare * check.chord * check.chord * contrast > worth) {
      split(check.cell);
      check.stage = Check::Stage::done;
      return;
    }
    check.predicted = std::clamp(check.predicted, -check.reach, check.reach);
  }
  const double disagreement = std::abs(curvature[0] - curvature[1]) * check.chord * check.chord / 8.0;
  check.smooth = neighbours == 2 && disagreement <= std::max(1.5 * std::max(check.tolerance, blur),
                                                             0.35 * std::abs(check.predicted));
}

namespace {

void add_on_normal(std::vector<FocalPoint>& points, Point2 centre, Point2 normal, double t) {
  const Point2 p = centre + t * normal;
  points.push_back({p.x, p.y});
}

}  // namespace

void EdgeTracer::verify() {
  std::vector<Check> checks;
  for (std::uint32_t cell : tentative_) {
    if (cells_[cell].kind != CellKind::tentative || abandoned_[cells_[cell].pixel]) continue;
    Check check;
    check.cell = cell;
    checks.push_back(check);
  }
  tentative_.clear();
  for (Check& check : checks) {
    if (cells_[check.cell].kind != CellKind::tentative) continue;
    predict(check);
    if (check.stage == Check::Stage::done && cells_[check.cell].kind == CellKind::tentative) accept(check);
  }

  const auto refuse = [&](Check& check, double sagitta) {
    const Cell cell = cells_[check.cell];
    const Curve& curve = curves_[cell.chord];
    suspect_[cell.pixel] = 1;
    const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
    const double hidden = kRefusedShare * check.chord * check.chord;
    const double worth = kLooseCurve * std::sqrt(allowed_variance_[cell.pixel]);
    const bool must_follow = lattice_.side_px(cell.level) > options_.thinnest_px && isolated_corner(cell);
    check.stage = Check::Stage::done;
    if (cell.level < kMaxLevel && (must_follow || hidden * contrast > worth)) {
      split(check.cell);
      return;
    }
    check.sagitta = sagitta;
    check.low = check.high = sagitta;
    curves_[cell.chord].loose_area = hidden;
    accept(check);
  };

  std::vector<std::uint32_t> labels;
  for (;;) {
    bool any = false;
    for (Check& check : checks) {
      if (cells_[check.cell].kind != CellKind::tentative) check.stage = Check::Stage::done;
      check.first_point = points_.size();
      switch (check.stage) {
        case Check::Stage::middle:
          add_on_normal(points_, check.centre, check.normal, check.predicted + check.tolerance);
          add_on_normal(points_, check.centre, check.normal, check.predicted - check.tolerance);
          break;
        case Check::Stage::far_side:
          add_on_normal(points_, check.centre, check.normal, check.up_wrong ? check.high : check.low);
          break;
        case Check::Stage::bisect:
          add_on_normal(points_, check.centre, check.normal, 0.5 * (check.low + check.high));
          break;
        case Check::Stage::quarters:
          for (double f : {-0.25, 0.25}) {
            const Point2 foot = check.centre + (f * check.chord) * Point2{check.normal.y, -check.normal.x};
            const double height = 0.75 * check.sagitta;
            const double margin = std::max(check.tolerance, 0.15 * std::abs(check.sagitta));
            add_on_normal(points_, foot, check.normal, height + margin);
            add_on_normal(points_, foot, check.normal, height - margin);
          }
          break;
        case Check::Stage::done:
          continue;
      }
      any = true;
    }
    if (!any) break;
    ask(labels);

    for (Check& check : checks) {
      if (check.stage == Check::Stage::done) continue;
      const std::uint32_t* seen = &labels[check.first_point];
      const auto finish_middle = [&] {
        check.sagitta = 0.5 * (check.low + check.high);
        check.stage = Check::Stage::quarters;
      };
      switch (check.stage) {
        case Check::Stage::middle: {
          const bool up = seen[0] == check.left, down = seen[1] == check.right;
          check.low = check.predicted - check.tolerance;
          check.high = check.predicted + check.tolerance;
          if (up && down) {
            curves_[cells_[check.cell].chord].predicted = true;
            finish_middle();
            if (check.smooth || check.chord <= 6.0 * check.tolerance) accept(check);
          } else if (up == down || (!up && seen[0] != check.right) || (!down && seen[1] != check.left)) {
            refuse(check, check.predicted);
          } else {
            check.up_wrong = !up;
            check.stage = Check::Stage::far_side;
            if (check.up_wrong) {
              check.low = check.high;
              check.high = std::max(check.reach, check.low + 2.0 * check.tolerance);
            } else {
              check.high = check.low;
              check.low = std::min(-check.reach, check.high - 2.0 * check.tolerance);
            }
          }
          break;
        }
        case Check::Stage::far_side:
          if (seen[0] != (check.up_wrong ? check.left : check.right))
            refuse(check, check.up_wrong ? check.high : check.low);
          else
            check.stage = Check::Stage::bisect;
          break;
        case Check::Stage::bisect:
          (seen[0] == check.left ? check.high : check.low) = 0.5 * (check.low + check.high);
          if (check.high - check.low <= check.tolerance) {
            finish_middle();
            if (std::abs(check.sagitta) > 1.001 * check.reach)
              refuse(check, check.sagitta);
            else if (check.chord <= 6.0 * check.tolerance)
              accept(check);
          }
          break;
        case Check::Stage::quarters:
          if (seen[0] == check.left && seen[1] == check.right && seen[2] == check.left &&
              seen[3] == check.right)
            accept(check);
          else
            refuse(check, check.sagitta);
          break;
        case Check::Stage::done:
          break;
      }
    }
  }
}

void EdgeTracer::accept(Check& check) {
  check.stage = Check::Stage::done;
  Cell& cell = cells_[check.cell];
  Curve& curve = curves_[cell.chord];
  curve.origin = check.centre;
  curve.normal = check.normal;
  curve.low = check.low;
  curve.high = check.high;
  curve.middle_width = curve.predicted ? 0.5 * (check.high - check.low) : check.high - check.low;

  // An arc that leaves its cell through a side with equal ends would be counted in two cells: it may do so
  // only within its own pixel.
  Point2 knots[3];
  arc_knots(check.ends.a, check.ends.b, 0.5 * (check.low + check.high), knots);
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y), side = lattice_.side_px(cell.level);
  double outside = 0.0;
  for (const Point2& knot : knots)
    if (static_cast<std::uint32_t>(lattice_.pixel_at({knot.x, knot.y})) != cell.pixel)
      outside = std::max({outside, x0 - knot.x, knot.x - x0 - side, y0 - knot.y, knot.y - y0 - side});
  const double loss = 0.5 * outside * check.chord;
  if (loss > 0.0) {
    const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
    if (cell.level < kMaxLevel &&
        loss * contrast > 0.25 * kLooseCurve * std::sqrt(allowed_variance_[cell.pixel])) {
      split(check.cell);
      return;
    }
    curve.loose_area = std::max(curve.loose_area, loss);
  }
  cell.kind = CellKind::chord;
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
  if (cell.kind == CellKind::chord) {
    Point2 knots[3];
    arc_knots(e.a, e.b, sagitta(curve, e), knots);
    for (int i = 2; i >= 0; --i) region.add(knots[i]);
  }
  return region;
}

double EdgeTracer::area_variance(const Cell& cell) const {
  const Curve& curve = curves_[cell.chord];
  const Ends e = ends(curve);
  const Point2 d = e.b - e.a;
  double variance = curve.loose_area * curve.loose_area;
  for (int t = 0; t < 2; ++t) {
    // A crossing that moves along its side sweeps sin(angle between side and chord) of the motion; half of
    // the swept area is this cell's, and the cell beyond errs the same way, hence 1/2 instead of 1/4.
    const Bracket& b = brackets_[curve.bracket[t]];
    const double swept = b.vertical ? d.x : d.y;
    variance += 0.5 * swept * swept * b.width() * b.width() / 12.0;
  }
  const double lens = 2.0 / 3.0 * length(d) * curve.middle_width;
  return variance + lens * lens / 12.0;
}

}  // namespace ifov::sampling
