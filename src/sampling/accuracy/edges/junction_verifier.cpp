#include "sampling/accuracy/edges/junction_verifier.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/point_queries.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/complex_cells.h"
#include "sampling/accuracy/edges/junction_predictor.h"

namespace ifov::sampling {

namespace {

/// Rounds of rays after which a junction counts as none.
constexpr int kMostRounds = 30;

}  // namespace

void JunctionVerifier::verify(std::vector<std::uint32_t>& cells) {
  checks_.clear();
  for (std::uint32_t cell : cells) {
    if (tree_[cell].kind != CellKind::junction || pixels_.abandoned(tree_[cell].pixel)) continue;
    checks_.emplace_back().cell = cell;
    predictor_.predict(checks_.back());
  }
  cells.clear();
  active_.resize(checks_.size());
  for (std::uint32_t i = 0; i < active_.size(); ++i) active_[i] = i;
  while (!active_.empty()) {
    std::vector<FocalPoint>& points = queries_.points();
    for (std::uint32_t i : active_) {
      checks_[i].first_point = points.size();
      checks_[i].add_points(points);
    }
    const std::vector<std::uint32_t>& seen = queries_.ask();
    std::size_t still = 0;
    for (std::uint32_t i : active_) {
      weigh_answers(checks_[i], seen.data() + checks_[i].first_point);
      if (checks_[i].stage != JunctionCheck::Stage::done) active_[still++] = i;
    }
    active_.resize(still);
  }
}

void JunctionVerifier::weigh_answers(JunctionCheck& check, const std::uint32_t* seen) {
  if (check.stage == JunctionCheck::Stage::confirm) {
    if (std::equal(seen, seen + 3, check.sector)) {
      check.width = check.tolerance;
      check_legs(check);
      return;
    }
    // The nearest point known to be in each sector.
    const Cell& cell = tree_[check.cell];
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
        offer({tree_.lattice().x_px(cell.x + kCornerX[j] * side),
               tree_.lattice().y_px(cell.y + kCornerY[j] * side)},
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
      check.opposite =
          into_cell(tree_.lattice(), tree_[check.cell], middle + 0.5 * (middle - check.seen_in[third]));
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

void JunctionVerifier::check_legs(JunctionCheck& check) {
  check.stage = JunctionCheck::Stage::legs;
  bool any = false;
  for (int i = 0; i < 3; ++i) any |= check.leg_tolerance[i] > 0.0;
  if (!any) accept(check);
}

/// More than three straight borders: smaller cells.
void JunctionVerifier::refuse(JunctionCheck& check) {
  check.stage = JunctionCheck::Stage::done;
  pixels_.note_suspect(tree_[check.cell].pixel);
  complex_.settle(check.cell);
}

void JunctionVerifier::accept(JunctionCheck& check) {
  check.stage = JunctionCheck::Stage::done;
  Junction& junction = model_.junction_of(tree_[check.cell]);
  junction.at = check.at;
  junction.width = check.width;
  for (int i = 0; i < 3; ++i)
    junction.leg_width[i] = check.leg_tolerance[i] > 0.0
                                ? check.leg_tolerance[i]
                                : kUnverifiedLeg * length(check.at - check.crossing[i]);
  junction.located = true;
  pixels_.stir(tree_[check.cell].pixel);
}

}  // namespace ifov::sampling
