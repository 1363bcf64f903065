#include "sampling/accuracy/edges/junction_predictor.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/edges/junction_check.h"

namespace ifov::sampling {

namespace {

/// The rays that confirm a junction are this far from its borders at least and at most, as shares of the
/// cell's side.
constexpr double kNearest = 1e-4, kFarthest = 0.2;
/// Standard deviation of a junction about the middle of its crossings, in sides of the cell.
constexpr double kAboutMiddle = 0.15;
/// Rays that confirm a leg's middle are this share of its bracket's width from it at least.
constexpr double kLegBlur = 0.75;
/// A junction is kept this far from the cell's sides, as a share of them.
constexpr double kRim = 0.02;
/// Only legs that go on what the neighbours show stay unverified: sagitta over leg.
constexpr double kGentleLeg = 0.05;

}  // namespace

Point2 into_cell(const Lattice& lattice, const Cell& cell, Point2 p) {
  const double x0 = lattice.x_px(cell.x), y0 = lattice.y_px(cell.y), side = lattice.side_px(cell.level);
  return {std::clamp(p.x, x0 + kRim * side, x0 + (1.0 - kRim) * side),
          std::clamp(p.y, y0 + kRim * side, y0 + (1.0 - kRim) * side)};
}

void JunctionPredictor::predict(JunctionCheck& check) const {
  const Cell& cell = model_.tree()[check.cell];
  const Junction& junction = model_.junction_of(cell);
  const double side = model_.tree().lattice().side_px(cell.level);
  model_.crossings(junction, check.crossing);
  for (int i = 0; i < 3; ++i) check.sector[i] = junction.sector[i];
  ExpectedLine lines[3];
  int known = 0;
  const Point2 middle = (1.0 / 3.0) * (check.crossing[0] + check.crossing[1] + check.crossing[2]);
  Point2 beyond[3];
  bool continued[3];
  for (int i = 0; i < 3; ++i) {
    const double blur = model_.brackets()[junction.bracket[i]].width();
    continued[i] = model_.neighbour_end(junction.bracket[i], check.cell, beyond[i]);
    const Point2 d = check.crossing[i] - beyond[i];
    const double reach = length(d);
    if (!continued[i] || reach <= 2.0 * blur) continue;
    const double t = length(middle - check.crossing[i]) / reach;
    lines[known++] = {check.crossing[i], (1.0 / reach) * d,
                      blur * blur / 12.0 * (1.0 + 2.0 * t + 2.0 * t * t) + 1e-18};
  }
  const double about = kAboutMiddle * side;
  check.at = junction.located ? junction.at
                              : into_cell(model_.tree().lattice(), cell,
                                          meeting_point(middle, about * about, lines, known));
  check.tolerance = std::clamp(junction.wanted, kNearest * side, kFarthest * side);
  for (int i = 0; i < 3; ++i) {
    const Point2 leg = check.at - check.crossing[i], before = check.crossing[i] - beyond[i];
    const double reach = length(leg), sides = length(before) * (reach + length(before));
    const bool gentle = continued[i] && 0.25 * std::abs(cross(before, leg)) < kGentleLeg * sides;
    const double tolerance = leg_tolerance(junction, i, leg);
    check.leg_tolerance[i] =
        (gentle && kUnverifiedLeg * reach <= junction.wanted) || tolerance > reach / 3.0 ? 0.0 : tolerance;
  }
  check.aim();
  for (Point2& p : check.seen_in) p = into_cell(model_.tree().lattice(), cell, p);
}

/// How far beside a leg's middle rays are to confirm it: beyond the blur of the crossing, across the leg.
double JunctionPredictor::leg_tolerance(const Junction& junction, int border, Point2 leg) const {
  const Bracket& bracket = model_.brackets()[junction.bracket[border]];
  const double reach = length(leg), across = std::abs(bracket.vertical ? leg.x : leg.y);
  return std::max(junction.wanted, reach > 0.0 ? kLegBlur * bracket.width() * across / reach : 0.0);
}

bool JunctionPredictor::too_vague(const Junction& junction) const {
  if (!junction.located) return false;
  bool vague = junction.width > 1.05 * junction.wanted;
  for (int i = 0; i < 3; ++i) {
    const Point2 leg = junction.at - model_.brackets().end_point(junction.bracket[i]);
    vague |= junction.leg_width[i] > 1.05 * std::max(leg_tolerance(junction, i, leg), kNearest * length(leg));
  }
  return vague;
}

}  // namespace ifov::sampling
