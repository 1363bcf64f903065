// Precision: how the variance that a pixel may keep is shared between what no model follows, crossings, and
// middles.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// How a pixel's allowed variance is shared: cells and curves that no model follows, crossings, middles of
/// curves.
constexpr double kLooseShare = 0.3, kCrossingShare = 0.55;
/// A bracket is halved at most this often at a time.
constexpr int kMostHalvings = 30;

}  // namespace

/// Makes crossings precise enough for every pixel's allowed variance, sets how precisely the middles of
/// curves must be verified, and splits what spoils the variance without being a curve. Pixels in which
/// nothing changed since are left out.
void EdgeTracer::sharpen() {
  if (allowed_may_differ_) {
    for (std::size_t p = 0; p < allowed_variance_.size(); ++p)
      if (allowed_variance_[p] != sharpened_for_[p]) stirred_[p] = 1;
    sharpened_for_ = allowed_variance_;
    allowed_may_differ_ = false;
  }
  due_.swap(stirred_);
  std::fill(stirred_.begin(), stirred_.end(), std::uint8_t{0});
  active_.clear();
  middles_.clear();
  for (auto p = std::find(due_.begin(), due_.end(), std::uint8_t{1}); p != due_.end();
       p = std::find(p + 1, due_.end(), std::uint8_t{1})) {
    const auto pixel = static_cast<std::uint32_t>(p - due_.begin());
    if (!abandoned_[pixel] && edge_lists_[pixel].first != kNone) sharpen_pixel(pixel);
  }
  halve_brackets();
  for (std::size_t first = 0, last; first < middles_.size(); first = last) {
    for (last = first; last < middles_.size() && middles_[last].pixel == middles_[first].pixel;) ++last;
    share_middles(first, last);
  }
}

void EdgeTracer::sharpen_pixel(std::uint32_t pixel) {
  collect_terms(pixel);
  const double allowed = allowed_variance_[pixel];
  const double left_loose = loose_.empty() ? 0.0 : split_largest_loose(pixel);
  want_halvings(kCrossingShare * std::max(0.0, allowed - std::min(left_loose, kLooseShare * allowed)));
}

/// What each cell and curve of a pixel adds to its variance.
void EdgeTracer::collect_terms(std::uint32_t pixel) {
  crossings_.clear();
  loose_.clear();
  crossing_of_.resize(brackets_.size());
  EdgeCellList& list = edge_lists_[pixel];
  std::uint32_t* link = &list.first;
  list.last = kNone;
  while (*link != kNone) {
    EdgeCell& entry = edge_cells_[*link];
    const std::uint32_t index = entry.cell;
    const Cell& cell = cells_[index];
    if (cell.kind == CellKind::split) {
      *link = entry.next;
      continue;
    }
    list.last = *link;
    link = &entry.next;
    if (cell.kind == CellKind::complex) {
      const double side = lattice_.side_px(cell.level);
      const double error = side * side * contrast_.among(cell.pixel, cell.corner);
      loose_.push_back({index, error * error / 12.0, has_two_labels(cell)});
      continue;
    }
    if (cell.kind == CellKind::junction) {
      collect_junction_terms(index);
      continue;
    }
    const Curve& curve = curves_[cell.chord];
    const CurveShape shape = shape_of(cell);
    const Point2 d = shape.b - shape.a;
    const double contrast = contrast_(pixel, curve.inner, curve.outer), square = contrast * contrast;
    double swept[2];
    sweep(cell, shape, swept);
    for (int t = 0; t < 2; ++t) add_crossing(curve.bracket[t], 0.5 * swept[t] * swept[t] * square / 12.0);
    middles_.push_back({pixel, index, 4.0 / 9.0 * (d.x * d.x + d.y * d.y) * square / 12.0});
    if (curve.loose_area > 0.0) loose_.push_back({index, curve.loose_area * curve.loose_area * square, true});
  }
}

void EdgeTracer::add_crossing(std::uint32_t bracket, double gain) {
  std::uint32_t& place = crossing_of_[bracket];
  if (place < crossings_.size() && crossings_[place].bracket == bracket) {
    crossings_[place].variance += gain;
  } else {
    place = static_cast<std::uint32_t>(crossings_.size());
    crossings_.push_back({bracket, gain});
  }
}

void EdgeTracer::collect_junction_terms(std::uint32_t index) {
  const Cell& cell = cells_[index];
  const Junction& junction = junctions_[cell.chord];
  Point2 crossing[3];
  crossings(junction, crossing);
  const Point2 at = junction.located ? junction.at : (1.0 / 3.0) * (crossing[0] + crossing[1] + crossing[2]);
  double gain = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double contrast = contrast_(cell.pixel, junction.sector[(i + 2) % 3], junction.sector[i]);
    const double square = contrast * contrast;
    const Point2 leg = at - crossing[i];
    const double swept = brackets_[junction.bracket[i]].vertical ? leg.x : leg.y;
    add_crossing(junction.bracket[i], 0.5 * swept * swept * square / 12.0);
    const double moved = kJunctionClaim * kJunctionClaim * exchanged_by_motion(crossing, i);
    gain += (4.0 / 9.0 * dot(leg, leg) + moved) * square / 12.0;
  }
  middles_.push_back({cell.pixel, index, gain});
}

/// What no model follows: the largest are split until the rest fits. Errors of two-label cells add up (a
/// strip too thin for them errs the same way all along). Returns the variance that is left.
double EdgeTracer::split_largest_loose(std::uint32_t pixel) {
  std::stable_sort(loose_.begin(), loose_.end(),
                   [](const LooseTerm& a, const LooseTerm& b) { return a.variance > b.variance; });
  double left = 0.0, coherent = 0.0;
  for (const LooseTerm& term : loose_)
    (term.coherent ? coherent : left) += term.coherent ? std::sqrt(term.variance) : term.variance;
  left += coherent * coherent;
  for (const LooseTerm& term : loose_) {
    if (left <= kLooseShare * allowed_variance_[pixel]) break;
    if (cells_[term.cell].level == kMaxLevel) continue;
    const double deviation = std::sqrt(term.variance);
    left -= term.coherent ? deviation * (2.0 * coherent - deviation) : term.variance;
    if (term.coherent) coherent -= deviation;
    split(term.cell);
  }
  return left;
}

/// Plans to halve, again and again, the bracket that counts most, until all of a pixel's crossings together
/// are within `target`.
void EdgeTracer::want_halvings(double target) {
  std::sort(crossings_.begin(), crossings_.end(),
            [](const CrossingTerm& a, const CrossingTerm& b) { return a.bracket < b.bracket; });
  double total = 0.0;
  std::size_t count = crossings_.size();
  for (CrossingTerm& term : crossings_) {
    const double width = brackets_[term.bracket].width();
    term.variance = term.variance * width * width;
    total += term.variance;
  }
  if (total <= target) return;
  while (total > target && count > 0) {
    std::size_t most = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (crossings_[i].variance > crossings_[most].variance) most = i;
    CrossingTerm& term = crossings_[most];
    if (term.halvings == kMostHalvings) {
      crossings_.erase(crossings_.begin() + static_cast<std::ptrdiff_t>(most));
      --count;
      continue;
    }
    total -= 0.75 * term.variance;
    term.variance *= 0.25;
    ++term.halvings;
    Bracket& bracket = brackets_[term.bracket];
    if (bracket.halvings == 0) active_.push_back(term.bracket);
    bracket.halvings = std::max(bracket.halvings, term.halvings);
  }
}

/// One ray a round for every bracket that is to be halved.
void EdgeTracer::halve_brackets() {
  std::sort(active_.begin(), active_.end());
  const auto skip_known = [this] {
    std::erase_if(active_, [this](std::uint32_t index) {
      Bracket& b = brackets_[index];
      while (b.halvings > 0 && b.skip_known()) --b.halvings;
      for (std::uint32_t entry : b.cells)
        if (entry != 0) stir(cells_[entry - 1].pixel);
      return b.halvings == 0;
    });
  };
  for (skip_known(); !active_.empty(); skip_known()) {
    look_into_brackets();
    std::size_t still = 0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      Bracket& b = brackets_[active_[i]];
      b.take(seen_[i]);
      for (std::uint32_t entry : b.cells)
        if (entry != 0) stir(cells_[entry - 1].pixel);
      if (b.third_label) {
        b.halvings = 0;
        for (std::uint32_t entry : b.cells)
          if (entry != 0 && cells_[entry - 1].kind != CellKind::split) {
            suspect_[cells_[entry - 1].pixel] = 1;
            settle_complex(entry - 1);
          }
      } else if (--b.halvings > 0) {
        active_[still++] = active_[i];
      }
    }
    active_.resize(still);
  }
}

/// The curves of one pixel may each claim an equal share of what is left for their middles.
void EdgeTracer::share_middles(std::size_t first, std::size_t last) {
  const double share = (1.0 - kLooseShare) * (1.0 - kCrossingShare) *
                       allowed_variance_[middles_[first].pixel] / static_cast<double>(last - first);
  for (; first < last; ++first) {
    const MiddleTerm& term = middles_[first];
    Cell& cell = cells_[term.cell];
    if (cell.kind == CellKind::junction) {
      Junction& junction = junctions_[cell.chord];
      junction.wanted = term.gain > 0.0 ? std::sqrt(share / term.gain) : INFINITY;
      if (too_vague(junction)) open_junctions_.push_back(term.cell);
      continue;
    }
    if (cell.kind != CellKind::tentative && cell.kind != CellKind::chord) continue;
    Curve& curve = curves_[cell.chord];
    const double blur = 0.5 * (brackets_[curve.bracket[0]].width() + brackets_[curve.bracket[1]].width());
    const double wanted = std::max(term.gain > 0.0 ? std::sqrt(share / term.gain) : INFINITY, 0.5 * blur);
    if (cell.kind == CellKind::tentative) {
      curve.wanted_middle = wanted;
    } else if (curve.middle_width > 1.05 * wanted) {
      curve.wanted_middle = wanted;
      cell.kind = CellKind::tentative;
      tentative_.push_back(term.cell);
    }
  }
}

}  // namespace ifov::sampling
