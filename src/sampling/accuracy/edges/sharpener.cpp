#include "sampling/accuracy/edges/sharpener.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/edge_cells.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/crossing_precision.h"
#include "sampling/accuracy/edges/junction_predictor.h"
#include "sampling/accuracy/edges/open_borders.h"

namespace ifov::sampling {

namespace {

/// How a pixel's allowed variance is shared: cells and curves that no model follows, crossings, middles of
/// curves.
constexpr double kLooseShare = 0.3, kCrossingShare = 0.55;

}  // namespace

void Sharpener::sharpen(OpenBorders& open) {
  pixels_.take_stirred(due_);
  middles_.clear();
  for (auto p = std::find(due_.begin(), due_.end(), std::uint8_t{1}); p != due_.end();
       p = std::find(p + 1, due_.end(), std::uint8_t{1})) {
    const auto pixel = static_cast<std::uint32_t>(p - due_.begin());
    if (!pixels_.abandoned(pixel) && edge_cells_.crossed(pixel)) sharpen_pixel(pixel);
  }
  crossings_.halve();
  for (std::size_t first = 0, last; first < middles_.size(); first = last) {
    for (last = first; last < middles_.size() && middles_[last].pixel == middles_[first].pixel;) ++last;
    share_middles(first, last, open);
  }
}

void Sharpener::sharpen_pixel(std::uint32_t pixel) {
  crossings_.begin_pixel();
  loose_.clear();
  edge_cells_.filter(pixel, [&](std::uint32_t cell) { return collect_terms(pixel, cell); });
  const double allowed = pixels_.allowed_variance(pixel);
  const double left_loose = loose_.empty() ? 0.0 : split_largest_loose(pixel);
  crossings_.want(kCrossingShare * std::max(0.0, allowed - std::min(left_loose, kLooseShare * allowed)));
}

/// What a cell of the pixel adds to its variance; false where its children do.
bool Sharpener::collect_terms(std::uint32_t pixel, std::uint32_t index) {
  const Cell& cell = tree_[index];
  if (cell.kind == CellKind::split) return false;
  if (cell.kind == CellKind::complex) {
    const double side = tree_.lattice().side_px(cell.level);
    const double error = side * side * contrast_.among(cell.pixel, cell.corner);
    loose_.push_back({index, error * error / 12.0, has_two_labels(cell)});
  } else if (cell.kind == CellKind::junction) {
    collect_junction(index);
  } else {
    collect_curve(pixel, index);
  }
  return true;
}

void Sharpener::collect_curve(std::uint32_t pixel, std::uint32_t index) {
  const Cell& cell = tree_[index];
  const Curve& curve = model_.curve_of(cell);
  const CurveShape shape = model_.shape_of(cell);
  const Point2 d = shape.b - shape.a;
  const double contrast = contrast_(pixel, curve.inner, curve.outer), square = contrast * contrast;
  double swept[2];
  model_.sweep_at_most(cell, shape, swept);
  for (int t = 0; t < 2; ++t) crossings_.add(curve.bracket[t], 0.5 * swept[t] * swept[t] * square / 12.0);
  middles_.push_back({pixel, index, 4.0 / 9.0 * (d.x * d.x + d.y * d.y) * square / 12.0});
  if (curve.loose_area > 0.0) loose_.push_back({index, curve.loose_area * curve.loose_area * square, true});
}

void Sharpener::collect_junction(std::uint32_t index) {
  const Cell& cell = tree_[index];
  const Junction& junction = model_.junction_of(cell);
  Point2 crossing[3];
  model_.crossings(junction, crossing);
  const Point2 at = junction.located ? junction.at : (1.0 / 3.0) * (crossing[0] + crossing[1] + crossing[2]);
  double gain = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double contrast = contrast_(cell.pixel, junction.sector[(i + 2) % 3], junction.sector[i]);
    const double square = contrast * contrast;
    const Point2 leg = at - crossing[i];
    const double swept = model_.brackets()[junction.bracket[i]].vertical ? leg.x : leg.y;
    crossings_.add(junction.bracket[i], 0.5 * swept * swept * square / 12.0);
    const double moved = kJunctionClaim * kJunctionClaim * exchanged_by_motion(crossing, i);
    gain += (4.0 / 9.0 * dot(leg, leg) + moved) * square / 12.0;
  }
  middles_.push_back({cell.pixel, index, gain});
}

/// What no model follows: the largest are split until the rest fits. Errors of two-label cells add up (a
/// strip too thin for them errs the same way all along). Returns the variance that is left.
double Sharpener::split_largest_loose(std::uint32_t pixel) {
  std::stable_sort(loose_.begin(), loose_.end(),
                   [](const LooseTerm& a, const LooseTerm& b) { return a.variance > b.variance; });
  double left = 0.0, coherent = 0.0;
  for (const LooseTerm& term : loose_)
    (term.coherent ? coherent : left) += term.coherent ? std::sqrt(term.variance) : term.variance;
  left += coherent * coherent;
  for (const LooseTerm& term : loose_) {
    if (left <= kLooseShare * pixels_.allowed_variance(pixel)) break;
    if (tree_[term.cell].level == kMaxLevel) continue;
    const double deviation = std::sqrt(term.variance);
    left -= term.coherent ? deviation * (2.0 * coherent - deviation) : term.variance;
    if (term.coherent) coherent -= deviation;
    tree_.split(term.cell);
  }
  return left;
}

/// The curves of one pixel may each claim an equal share of what is left for their middles.
void Sharpener::share_middles(std::size_t first, std::size_t last, OpenBorders& open) {
  const double share = (1.0 - kLooseShare) * (1.0 - kCrossingShare) *
                       pixels_.allowed_variance(middles_[first].pixel) / static_cast<double>(last - first);
  for (; first < last; ++first) {
    const MiddleTerm& term = middles_[first];
    Cell& cell = tree_[term.cell];
    if (cell.kind == CellKind::junction) {
      Junction& junction = model_.junction_of(cell);
      junction.wanted = term.gain > 0.0 ? std::sqrt(share / term.gain) : INFINITY;
      if (junctions_.too_vague(junction)) open.junctions.push_back(term.cell);
      continue;
    }
    if (cell.kind != CellKind::tentative && cell.kind != CellKind::chord) continue;
    Curve& curve = model_.curve_of(cell);
    const double wanted =
        std::max(term.gain > 0.0 ? std::sqrt(share / term.gain) : INFINITY, 0.5 * model_.blur(curve));
    if (cell.kind == CellKind::tentative) {
      curve.wanted_middle = wanted;
    } else if (curve.middle_width > 1.05 * wanted) {
      curve.wanted_middle = wanted;
      cell.kind = CellKind::tentative;
      open.curves.push_back(term.cell);
    }
  }
}

}  // namespace ifov::sampling
