// Cells in which three labels meet: one point, three straight borders.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// The rays that confirm a junction are this far from its borders at least and at most, as shares of the
/// cell's side.
constexpr double kNearest = 1e-4, kFarthest = 0.2;
/// Standard deviation of a junction about the middle of its crossings, in sides of the cell.
constexpr double kAboutMiddle = 0.15;
/// Rounds of rays after which a junction counts as none.
constexpr int kMostRounds = 30;
/// Rays that confirm a leg's middle are this share of its bracket's width from it at least.
constexpr double kLegBlur = 0.75;
/// A junction is kept this far from the cell's sides, as a share of them.
constexpr double kRim = 0.02;
/// Width of the error of the middle of a straight leg that was not verified, as a share of the leg.
constexpr double kUnverifiedLeg = 0.15;
/// Only legs that go on what the neighbours show stay unverified: sagitta over leg.
constexpr double kGentleLeg = 0.05;

}  // namespace

void EdgeTracer::make_junction(std::uint32_t index, const int crossed[3]) {
  Junction junction;
  junction.cell = index;
  const Cell cell = cells_[index];
  for (int i = 0; i < 3; ++i) {
    junction.side[i] = static_cast<std::uint8_t>(crossed[i]);
    junction.sector[i] = cell.corner[(crossed[i] + 1) % 4];
    junction.bracket[i] = bracket_on(cell, crossed[i]);
    end_in(junction.bracket[i], index);
  }
  cells_[index].chord = static_cast<std::uint32_t>(junctions_.size());
  cells_[index].kind = CellKind::junction;
  junctions_.push_back(junction);
}

void EdgeTracer::crossings(const Junction& junction, Point2 crossing[3]) const {
  for (int i = 0; i < 3; ++i) crossing[i] = end_point(junction.bracket[i]);
}

Point2 EdgeTracer::into_cell(const Cell& cell, Point2 p) const {
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y), side = lattice_.side_px(cell.level);
  return {std::clamp(p.x, x0 + kRim * side, x0 + (1.0 - kRim) * side),
          std::clamp(p.y, y0 + kRim * side, y0 + (1.0 - kRim) * side)};
}

/// Where it should be, and the first rays' places.
void EdgeTracer::predict(JunctionCheck& check) {
  const Cell& cell = cells_[check.cell];
  const Junction& junction = junctions_[cell.chord];
  const double side = lattice_.side_px(cell.level);
  crossings(junction, check.crossing);
  for (int i = 0; i < 3; ++i) check.sector[i] = junction.sector[i];
  ExpectedLine lines[3];
  int known = 0;
  const Point2 middle = (1.0 / 3.0) * (check.crossing[0] + check.crossing[1] + check.crossing[2]);
  Point2 beyond[3];
  bool continued[3];
  for (int i = 0; i < 3; ++i) {
    const double blur = brackets_[junction.bracket[i]].width();
    continued[i] = neighbour_end(junction.bracket[i], check.cell, beyond[i]);
    const Point2 d = check.crossing[i] - beyond[i];
    const double reach = length(d);
    if (!continued[i] || reach <= 2.0 * blur) continue;
    const double t = length(middle - check.crossing[i]) / reach;
    lines[known++] = {check.crossing[i], (1.0 / reach) * d,
                      blur * blur / 12.0 * (1.0 + 2.0 * t + 2.0 * t * t) + 1e-18};
  }
  const double about = kAboutMiddle * side;
  check.at =
      junction.located ? junction.at : into_cell(cell, meeting_point(middle, about * about, lines, known));
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
  for (Point2& p : check.seen_in) p = into_cell(cell, p);
}

/// How far beside a leg's middle rays are to confirm it: beyond the blur of the crossing, across the leg.
double EdgeTracer::leg_tolerance(const Junction& junction, int border, Point2 leg) const {
  const Bracket& bracket = brackets_[junction.bracket[border]];
  const double reach = length(leg), across = std::abs(bracket.vertical ? leg.x : leg.y);
  return std::max(junction.wanted, reach > 0.0 ? kLegBlur * bracket.width() * across / reach : 0.0);
}

/// Whether a junction that was located once is to be located better.
bool EdgeTracer::too_vague(const Junction& junction) const {
  if (!junction.located) return false;
  bool vague = junction.width > 1.05 * junction.wanted;
  for (int i = 0; i < 3; ++i) {
    const Point2 leg = junction.at - end_point(junction.bracket[i]);
    vague |= junction.leg_width[i] > 1.05 * std::max(leg_tolerance(junction, i, leg), kNearest * length(leg));
  }
  return vague;
}

void EdgeTracer::verify_junctions() {
  junction_checks_.clear();
  for (std::uint32_t cell : open_junctions_) {
    if (cells_[cell].kind != CellKind::junction || abandoned_[cells_[cell].pixel]) continue;
    junction_checks_.emplace_back().cell = cell;
    predict(junction_checks_.back());
  }
  open_junctions_.clear();
  active_.resize(junction_checks_.size());
  for (std::uint32_t i = 0; i < active_.size(); ++i) active_[i] = i;
  while (!active_.empty()) {
    for (std::uint32_t i : active_) {
      junction_checks_[i].first_point = points_.size();
      junction_checks_[i].add_points(points_);
    }
    ask(seen_);
    std::size_t still = 0;
    for (std::uint32_t i : active_) {
      weigh_answers(junction_checks_[i], seen_);
      if (junction_checks_[i].stage != JunctionCheck::Stage::done) active_[still++] = i;
    }
    active_.resize(still);
  }
}

void EdgeTracer::weigh_answers(JunctionCheck& check, const std::vector<std::uint32_t>& answers) {
  const std::uint32_t* seen = answers.data() + check.first_point;
  if (check.stage == JunctionCheck::Stage::confirm) {
    if (std::equal(seen, seen + 3, check.sector)) {
      check.width = check.tolerance;
      check_legs(check);
      return;
    }
    // The nearest point known to be in each sector.
    const Cell& cell = cells_[check.cell];
    Point2 known[3];
    for (int i = 0; i < 3; ++i) {
      double nearest = INFINITY;
      const auto offer = [&](Point2 p, std::uint32_t label) {
        if (label != check.sector[i] || length(p - check.at) >= nearest) return;
        nearest = length(p - check.at);
        known[i] = p;
      };
      for (int j = 0; j < 3; ++j) offer(check.seen_in[j], seen[j]);
      const std::int32_t side = Lattice::side(cell.level);
      for (int j = 0; j < 4; ++j)
        offer({lattice_.x_px(cell.x + kCornerX[j] * side), lattice_.y_px(cell.y + kCornerY[j] * side)},
              cell.corner[j]);
    }
    for (int j = 0; j < 3; ++j)
      if (std::find(check.sector, check.sector + 3, seen[j]) == check.sector + 3) return refuse(check);
    for (int i = 0; i < 3; ++i) check.seen_in[i] = known[i];
    check.stage = JunctionCheck::Stage::narrow;
  } else if (check.stage == JunctionCheck::Stage::narrow) {
    const int first = check.longest_side(), second = (first + 1) % 3;
    const int third = 3 - first - second;
    const Point2 middle = 0.5 * (check.seen_in[first] + check.seen_in[second]);
    if (seen[0] == check.sector[first]) {
      check.seen_in[first] = middle;
    } else if (seen[0] == check.sector[second]) {
      check.seen_in[second] = middle;
    } else if (seen[0] == check.sector[third]) {
      // The borders meet on the other side of the line between the two.
      check.opposite = into_cell(cells_[check.cell], middle + 0.5 * (middle - check.seen_in[third]));
      check.seen_in[third] = middle;
      check.stage = JunctionCheck::Stage::cross_over;
    } else {
      return refuse(check);
    }
  } else if (check.stage == JunctionCheck::Stage::cross_over) {
    const auto label = std::find(check.sector, check.sector + 3, seen[0]);
    if (label == check.sector + 3) return refuse(check);
    check.seen_in[label - check.sector] = check.opposite;
    check.stage = JunctionCheck::Stage::narrow;
  } else {
    const std::uint32_t* next = seen;
    for (int i = 0; i < 3; ++i) {
      if (check.leg_tolerance[i] == 0.0) continue;
      if (next[0] != check.sector[(i + 2) % 3] || next[1] != check.sector[i]) return refuse(check);
      next += 2;
    }
    return accept(check);
  }
  if (++check.rounds > kMostRounds) return refuse(check);
  check.width = check.triangle_width();
  if (check.stage == JunctionCheck::Stage::cross_over) return;
  if (check.width > std::max(check.tolerance, 1e-6)) return;
  check.at = (1.0 / 3.0) * (check.seen_in[0] + check.seen_in[1] + check.seen_in[2]);
  check_legs(check);
}

void EdgeTracer::check_legs(JunctionCheck& check) {
  check.stage = JunctionCheck::Stage::legs;
  bool any = false;
  for (int i = 0; i < 3; ++i) any |= check.leg_tolerance[i] > 0.0;
  if (!any) accept(check);
}

/// More than three straight borders: smaller cells.
void EdgeTracer::refuse(JunctionCheck& check) {
  check.stage = JunctionCheck::Stage::done;
  suspect_[cells_[check.cell].pixel] = 1;
  settle_complex(check.cell);
}

void EdgeTracer::accept(JunctionCheck& check) {
  check.stage = JunctionCheck::Stage::done;
  Junction& junction = junctions_[cells_[check.cell].chord];
  junction.at = check.at;
  junction.width = check.width;
  for (int i = 0; i < 3; ++i)
    junction.leg_width[i] = check.leg_tolerance[i] > 0.0
                                ? check.leg_tolerance[i]
                                : kUnverifiedLeg * length(check.at - check.crossing[i]);
  junction.located = true;
  stir(cells_[check.cell].pixel);
}

Polygon EdgeTracer::sector_region(const Cell& cell, int sector) const {
  const Junction& junction = junctions_[cell.chord];
  const double x0 = lattice_.x_px(cell.x), y0 = lattice_.y_px(cell.y), side = lattice_.side_px(cell.level);
  const int next = (sector + 1) % 3, last = junction.side[next] + (next == 0 ? 4 : 0);
  Polygon region;
  region.add(end_point(junction.bracket[sector]));
  for (int corner = junction.side[sector] + 1; corner <= last; ++corner)
    region.add({x0 + kCornerX[corner % 4] * side, y0 + kCornerY[corner % 4] * side});
  region.add(end_point(junction.bracket[next]));
  region.add(junction.at);
  return region;
}

double EdgeTracer::border_variance(const Cell& cell, int border) const {
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

}  // namespace ifov::sampling
