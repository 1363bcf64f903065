#include <algorithm>
#include <cmath>
#include <queue>

#include "sampling/accuracy/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// How a pixel's allowed variance is shared: cells and curves that no model follows, crossings, middles of
/// curves.
constexpr double kLooseShare = 0.3, kCrossingShare = 0.55;
/// Passes of sharpening before the tracer leaves a pixel as it is.
constexpr int kMaxPasses = 24;

/// One bracket as it enters one pixel's variance: gain * width^2.
struct CrossingTerm {
  std::uint32_t pixel, bracket;
  double gain;
};
struct MiddleTerm {
  std::uint32_t pixel, cell;
  double gain;
};
struct LooseTerm {
  std::uint32_t pixel, cell;
  double variance;
  bool coherent;
};

template <class Term>
std::size_t end_of_pixel(const std::vector<Term>& terms, std::size_t first) {
  std::size_t last = first;
  while (last < terms.size() && terms[last].pixel == terms[first].pixel) ++last;
  return last;
}

}  // namespace

void EdgeTracer::settle() {
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    grow();
    sharpen();
    if (!new_cells_.empty()) continue;
    if (tentative_.empty()) return;
    verify();
  }
  grow();
  verify();
}

/// What the lattice did not announce may turn out while tracing: a pixel that has cost this much is clutter.
void EdgeTracer::give_up_clutter() {
  if (!options_.clutter_switch) return;
  for (std::uint32_t p = 0; p < abandoned_.size(); ++p)
    if (ledger_.label_rays(static_cast<int>(p)) > budget_[p]) abandoned_[p] = 1;
}

/// Makes crossings precise enough for every pixel's allowed variance, sets how precisely the middles of
/// curves must be verified, and splits what spoils the variance without being a curve. Pixels in which
/// nothing changed since are left out.
void EdgeTracer::sharpen() {
  for (std::size_t p = 0; p < allowed_variance_.size(); ++p)
    if (allowed_variance_[p] != sharpened_for_[p]) stirred_[p] = 1;
  sharpened_for_ = allowed_variance_;
  std::vector<std::uint8_t> due(stirred_.size(), 0);
  due.swap(stirred_);
  std::vector<CrossingTerm> crossings;
  std::vector<MiddleTerm> middles;
  std::vector<LooseTerm> loose;
  std::size_t kept = 0;
  for (std::uint32_t index : edge_cells_) {
    const Cell& cell = cells_[index];
    if (cell.kind == CellKind::split) continue;
    edge_cells_[kept++] = index;
    if (abandoned_[cell.pixel] || !due[cell.pixel]) continue;
    if (cell.kind == CellKind::complex) {
      const double side = lattice_.side_px(cell.level);
      const double error = side * side * contrast_.among(cell.pixel, cell.corner);
      loose.push_back({cell.pixel, index, error * error / 12.0, has_two_labels(cell)});
      continue;
    }
    const Curve& curve = curves_[cell.chord];
    const Ends e = ends(curve);
    const Point2 d = e.b - e.a;
    const double contrast = contrast_(cell.pixel, curve.inner, curve.outer), square = contrast * contrast;
    for (int t = 0; t < 2; ++t) {
      const double swept = sweep(cell, e, t);
      crossings.push_back({cell.pixel, curve.bracket[t], 0.5 * swept * swept * square / 12.0});
    }
    middles.push_back({cell.pixel, index, 4.0 / 9.0 * (d.x * d.x + d.y * d.y) * square / 12.0});
    if (curve.loose_area > 0.0)
      loose.push_back({cell.pixel, index, curve.loose_area * curve.loose_area * square, true});
  }
  edge_cells_.resize(kept);
  const auto by_pixel = [](const auto& a, const auto& b) { return a.pixel < b.pixel; };
  std::sort(crossings.begin(), crossings.end(), [](const CrossingTerm& a, const CrossingTerm& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.bracket < b.bracket;
  });
  std::stable_sort(middles.begin(), middles.end(), by_pixel);
  std::stable_sort(loose.begin(), loose.end(), [](const LooseTerm& a, const LooseTerm& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.variance > b.variance;
  });

  // 1. What no model follows: the largest are split until the rest fits.
  // Errors of two-label cells add up (a strip too thin for them errs the same way all along).
  std::vector<double> left_loose(allowed_variance_.size(), 0.0), coherent(allowed_variance_.size(), 0.0);
  for (const LooseTerm& term : loose)
    (term.coherent ? coherent : left_loose)[term.pixel] +=
        term.coherent ? std::sqrt(term.variance) : term.variance;
  for (std::size_t p = 0; p < left_loose.size(); ++p) left_loose[p] += coherent[p] * coherent[p];
  for (const LooseTerm& term : loose) {
    if (left_loose[term.pixel] <= kLooseShare * allowed_variance_[term.pixel]) continue;
    if (cells_[term.cell].level == kMaxLevel) continue;
    const double deviation = std::sqrt(term.variance);
    left_loose[term.pixel] -=
        term.coherent ? deviation * (2.0 * coherent[term.pixel] - deviation) : term.variance;
    if (term.coherent) coherent[term.pixel] -= deviation;
    split(term.cell);
  }

  // 2. Crossings: repeatedly halve the one that counts most.
  std::vector<int>& halvings = halvings_;  // all zero between calls
  halvings.resize(brackets_.size(), 0);
  std::vector<std::uint32_t> active;
  for (std::size_t first = 0; first < crossings.size();) {
    const std::size_t last = end_of_pixel(crossings, first);
    const std::uint32_t pixel = crossings[first].pixel;
    const double target =
        kCrossingShare *
        std::max(0.0, allowed_variance_[pixel] -
                          std::min(left_loose[pixel], kLooseShare * allowed_variance_[pixel]));
    struct Item {
      double variance;
      std::uint32_t bracket;
      int halvings;
      bool operator<(const Item& o) const {
        return variance != o.variance ? variance < o.variance : bracket > o.bracket;
      }
    };
    std::priority_queue<Item> queue;
    double total = 0.0;
    for (std::size_t i = first; i < last;) {
      double gain = 0.0;
      const std::uint32_t bracket = crossings[i].bracket;
      for (; i < last && crossings[i].bracket == bracket; ++i) gain += crossings[i].gain;
      const double width = brackets_[bracket].width(), variance = gain * width * width;
      total += variance;
      queue.push({variance, bracket, 0});
    }
    while (total > target && !queue.empty()) {
      Item item = queue.top();
      queue.pop();
      if (item.halvings == 30) continue;
      total -= 0.75 * item.variance;
      item.variance *= 0.25;
      ++item.halvings;
      if (halvings[item.bracket] == 0) active.push_back(item.bracket);
      halvings[item.bracket] = std::max(halvings[item.bracket], item.halvings);
      queue.push(item);
    }
    first = last;
  }
  std::sort(active.begin(), active.end());
  std::vector<std::uint32_t> labels;
  while (!active.empty()) {
    for (std::uint32_t b : active) points_.push_back(brackets_[b].at(lattice_, brackets_[b].next()));
    ask(labels);
    std::size_t still = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
      Bracket& b = brackets_[active[i]];
      b.take(labels[i]);
      for (std::uint32_t entry : b.cells)
        if (entry != 0) stirred_[cells_[entry - 1].pixel] = 1;
      if (b.third_label) {
        halvings[active[i]] = 0;
        for (std::uint32_t entry : b.cells)
          if (entry != 0 && cells_[entry - 1].kind != CellKind::split) {
            suspect_[cells_[entry - 1].pixel] = 1;
            settle_complex(entry - 1);
          }
      } else if (--halvings[active[i]] > 0) {
        active[still++] = active[i];
      }
    }
    active.resize(still);
  }

  // 3. Middles: an equal share of the rest each.
  for (std::size_t first = 0; first < middles.size();) {
    const std::size_t last = end_of_pixel(middles, first);
    const std::uint32_t pixel = middles[first].pixel;
    const double share = (1.0 - kLooseShare) * (1.0 - kCrossingShare) * allowed_variance_[pixel] /
                         static_cast<double>(last - first);
    for (; first < last; ++first) {
      const MiddleTerm& term = middles[first];
      Cell& cell = cells_[term.cell];
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
}

}  // namespace ifov::sampling
