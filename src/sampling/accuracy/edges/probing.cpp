#include "sampling/accuracy/edges/probing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/options.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/contradictions.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/hash.h"
#include "sampling/random.h"

namespace ifov::sampling {

namespace {

/// However narrow what was met, no more rays than this are wanted for what may lie beside it.
constexpr int kMostWanted = 1000;
/// Likewise where it was followed from beside, which may be no more than a corner.
constexpr int kMostWantedBeside = 256;
/// Rays that are wanted over the inverse of the width that was met: what is as narrow and crosses the pixel is missed by
/// them with a probability of exp(-4).
constexpr double kSurety = 4.0;
/// What the lattice has met is no wonder unless it is narrower than this share of the lattice's spacing.
constexpr double kNarrow = 0.25;
/// Rounds of probes are no finer than this.
constexpr int kFinestRound = 16;
/// Points that are asked along a pixel's side, at most, and how far from it they lie, at most.
constexpr int kMostAlongSide = 32, kMostAlongRim = 6;
constexpr double kIntoPixel_px = 0.05;
constexpr std::uint64_t kSideKey = 0x73696465;
/// Allowed standard errors that what is too small to follow may sum up to, before the pixel is left.
constexpr double kDismissed = 0.1;

}  // namespace

Prober::Prober(EdgeTracer& tracer, RayLedger& ledger, const AccuracyOptions& options, std::uint64_t seed)
    : tracer_(tracer), ledger_(ledger), options_(options), seed_(seed) {
  const auto pixels = static_cast<std::size_t>(tracer.lattice().domain().count());
  grids_.resize(pixels);
  dismissed_.assign(pixels, 0.0);
  asked_.assign(pixels, 0);
  met_.resize(pixels);
  wanted_.assign(pixels, 0);
  unsettled_.assign(pixels, 0);
}

/// The model is refined until it agrees with what was seen at all of the points. Tells which ones contradicted it.
std::vector<std::uint8_t> Prober::reconcile(const std::vector<FocalPoint>& points,
                                            const std::vector<std::uint32_t>& labels) {
  std::vector<std::uint8_t> contradicted(points.size(), 0);
  std::vector<std::uint32_t> in_question(points.size());
  std::iota(in_question.begin(), in_question.end(), 0u);
  for (int level = 0; level <= 2 * kMaxLevel; ++level) {
    tracer_.pixels().forget_changes();
    bool any = false;
    for (std::uint32_t i : in_question)
      if (tracer_.contradict(points[i], labels[i])) contradicted[i] = any = true;
    if (!any) break;
    tracer_.settle();
    // Where the model is the same it still agrees.
    in_question.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (tracer_.pixels().changed(static_cast<std::uint32_t>(tracer_.lattice().pixel_at(points[i]))))
        in_question.push_back(i);
  }
  return contradicted;
}

void Prober::want_around(int pixel, int rays) {
  const PixelRect& domain = tracer_.lattice().domain();
  const int x = pixel % domain.width(), y = pixel / domain.width();
  for (int j = std::max(0, y - 1); j <= std::min(domain.height() - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(domain.width() - 1, x + 1); ++i) {
      int& wanted = wanted_[j * domain.width() + i];
      wanted = std::max(wanted, rays);
    }
}

void Prober::note(const std::vector<FocalPoint>& points, const std::vector<std::uint32_t>& labels) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    SmallVector<Met, 2>& met = met_[tracer_.lattice().pixel_at(points[i])];
    const auto at = std::find_if(met.begin(), met.end(), [&](const Met& m) { return m.label == labels[i]; });
    if (at != met.end())
      ++at->count;
    else
      met.push_back({labels[i], 1});
  }
}

/// More like what was met unannounced may lie beside it, and wants as many rays as are sure to meet it. What is too
/// small to follow adds up.
void Prober::take_in(const std::vector<FocalPoint>& points, const std::vector<std::uint32_t>& labels,
                     const std::vector<std::uint8_t>& contradicted) {
  note(points, labels);
  const int least = options_.probes_per_side * options_.probes_per_side;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int pixel = tracer_.lattice().pixel_at(points[i]);
    ++asked_[pixel];
    dismissed_[pixel] += tracer_.contradictions().dismissed(points[i], labels[i]);
    if (contradicted[i])
      want_around(
          pixel, std::clamp(static_cast<int>(kSurety / tracer_.leaf_side_px(points[i])), least, kMostWanted));
  }
}

void Prober::probe_around(const std::vector<FocalPoint>& known,
                          const std::vector<std::uint32_t>& known_labels,
                          const std::vector<FocalPoint>& others) {
  std::vector<FocalPoint> points = others;
  std::vector<std::uint32_t> labels;
  if (!points.empty()) tracer_.ask_at(points, labels, Purpose::probe);
  points.insert(points.end(), known.begin(), known.end());
  labels.insert(labels.end(), known_labels.begin(), known_labels.end());
  take_in(points, labels, reconcile(points, labels));
}

void Prober::follow_pilot_rays(std::span<const FocalPoint> seeds, std::span<const std::uint32_t> objects) {
  const std::vector<std::uint32_t> met =
      objects.empty() ? std::vector<std::uint32_t>{} : ledger_.objects_met();
  const PixelRect& domain = tracer_.lattice().domain();
  std::vector<FocalPoint> points;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const FocalPoint p = seeds[i];
    if (p.x_px < domain.x0 || p.x_px >= domain.x1 || p.y_px < domain.y0 || p.y_px >= domain.y1) continue;
    const bool known = !objects.empty() && objects[i] != Field::kNoObject &&
                       std::binary_search(met.begin(), met.end(), objects[i]);
    if (!known) points.push_back(p);
  }
  if (points.empty()) return;
  std::vector<std::uint32_t> labels;
  tracer_.ask_at(points, labels, Purpose::pilot);
  take_in_expected(points, labels);
}

void Prober::take_in_expected(const std::vector<FocalPoint>& points,
                              const std::vector<std::uint32_t>& labels) {
  TracedPixels::Signs signs = tracer_.pixels().signs();
  note(points, labels);
  reconcile(points, labels);
  tracer_.pixels().set_signs(std::move(signs));
}

std::vector<FocalPoint> Prober::probe_between(std::vector<Between> sides) {
  Finds found = look_between(std::move(sides));
  take_in_expected(found.points, found.labels);
  return std::move(found.points);
}

Prober::Finds Prober::look_between(std::vector<Between> sides) {
  Finds found;
  std::vector<FocalPoint> points;
  std::vector<std::uint32_t> labels;
  std::vector<Between> halves;
  while (!sides.empty()) {
    points.clear();
    for (const Between& side : sides)
      points.push_back({0.5 * (side.from.x_px + side.to.x_px), 0.5 * (side.from.y_px + side.to.y_px)});
    tracer_.ask_at(points, labels, Purpose::probe);
    halves.clear();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Between& side = sides[i];
      const double half = 0.5 * (side.to.x_px - side.from.x_px + side.to.y_px - side.from.y_px);
      const auto pixel = static_cast<std::uint32_t>(tracer_.lattice().pixel_at(points[i]));
      const Label met = ledger_.own_label(i);
      if (met != side.first && met != side.last &&
          tracer_.contradictions().matters(pixel, side.as, labels[i])) {
        found.points.push_back(points[i]);
        found.labels.push_back(labels[i]);
        // Another like it may lie where the ends of a side announce one border, and three cross it.
        int& wanted = wanted_[pixel];
        wanted = std::max(wanted, std::min(static_cast<int>(kSurety / half), kMostWantedBeside));
      }
      if (half <= options_.thinnest_px || tracer_.pixels().abandoned(pixel)) continue;
      // Another label leaves two places where something may lie between.
      if (met != side.first) halves.push_back({side.from, points[i], side.first, met, side.as});
      if (met != side.last) halves.push_back({points[i], side.to, met, side.last, side.as});
    }
    sides.swap(halves);
  }
  return found;
}

/// Labels of the pixel's vertices on the lattice and of its looks and probes, and how often each was met.
std::vector<Prober::Met> Prober::seen_in(int pixel) const {
  const Lattice& lattice = tracer_.lattice();
  std::vector<Met> seen(met_[pixel].begin(), met_[pixel].end());
  const int k = lattice.cells_per_pixel();
  const Cell& first = tracer_.tree()[lattice.first_cell(pixel)];
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::uint32_t label =
          tracer_.tree().label_if_known(first.x + i * Lattice::side(0), first.y + j * Lattice::side(0));
      const auto at = std::find_if(seen.begin(), seen.end(), [&](const Met& m) { return m.label == label; });
      if (at != seen.end())
        ++at->count;
      else
        seen.push_back({label, 1});
    }
  return seen;
}

/// Points of a traced pixel along its side towards one of clutter, as close as what the clutter holds and the pixel has not
/// met is wide, and as tips of what either holds that would matter; along another side, as tips whose borders may have corners.
void Prober::points_along_side(int pixel, int dx, int dy, const std::vector<Met>& beyond, bool clutter,
                               std::vector<FocalPoint>& points) const {
  const PixelRect& domain = tracer_.lattice().domain();
  const std::vector<Met> seen = seen_in(pixel);
  std::uint32_t all = 0, least = ~std::uint32_t{0};
  for (const Met& met : beyond) {
    all += met.count;
    if (std::none_of(seen.begin(), seen.end(), [&](const Met& m) { return m.label == met.label; }))
      least = std::min(least, met.count);
  }
  double tip = INFINITY;
  for (const Met& met : beyond)
    for (const Met& own : seen)
      if (clutter || tracer_.may_have_corners(met.label, own.label))
        tip = std::min(tip, tracer_.contradictions().tip_that_matters(static_cast<std::uint32_t>(pixel),
                                                                      met.label, own.label));
  int count = 0;
  if (clutter && least != ~std::uint32_t{0}) count = static_cast<int>((all + least - 1) / least);
  // Wider ones show on the lattice.
  if (tip < tracer_.lattice().side_px(0)) count = std::max(count, static_cast<int>(std::ceil(1.0 / tip)));
  count = std::min(count, clutter ? kMostAlongSide : kMostAlongRim);
  const int x = domain.x0 + pixel % domain.width(), y = domain.y0 + pixel / domain.width();
  const std::uint64_t key = hash(seed_, kSideKey, x, y, 3 * dy + dx);
  for (int i = 0; i < count; ++i) {
    const double along = (i + unit_double(key)) / count, into = kIntoPixel_px * unit_double(hash(key, i));
    const auto at = [&](int d) { return d < 0 ? into : d > 0 ? 1.0 - into : along; };
    points.push_back({x + at(dx), y + at(dy)});
  }
}

/// Nor is anything followed in from beyond the image: by what the pixels along its rim hold.
void Prober::look_along_rim(const std::vector<std::uint8_t>& worth) {
  const PixelRect& domain = tracer_.lattice().domain();
  const int width = domain.width(), height = domain.height();
  const auto inside = [&](int x, int y) { return x >= 0 && y >= 0 && x < width && y < height; };
  std::vector<FocalPoint> points;
  for (int p = 0; p < domain.count(); ++p) {
    if (!worth[p] || tracer_.pixels().abandoned(static_cast<std::uint32_t>(p))) continue;
    const int x = p % width, y = p / width;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      if (inside(x + dx, y + dy)) continue;
      std::vector<Met> beside;
      for (const int side : {-1, 1})
        if (inside(x + side * dy, y + side * dx)) {
          const std::vector<Met> seen = seen_in(p + side * (dx * width + dy));
          beside.insert(beside.end(), seen.begin(), seen.end());
        }
      points_along_side(p, dx, dy, beside, false, points);
    }
  }
  if (points.empty()) return;
  std::vector<std::uint32_t> labels;
  tracer_.ask_at(points, labels, Purpose::probe);
  take_in(points, labels, reconcile(points, labels));
}

/// Nothing is followed out of clutter: what it holds is sought in the traced pixels beside it, and beside those that become
/// clutter by that.
void Prober::look_beside_clutter(const std::vector<std::uint8_t>& worth) {
  const PixelRect& domain = tracer_.lattice().domain();
  std::vector<std::uint8_t> left(static_cast<std::size_t>(domain.count()), 0);
  std::vector<FocalPoint> points;
  std::vector<std::uint32_t> labels;
  for (;;) {
    points.clear();
    for (int p = 0; p < domain.count(); ++p) {
      if (left[p] || !tracer_.pixels().abandoned(static_cast<std::uint32_t>(p))) continue;
      left[p] = 1;
      const std::vector<Met> seen = seen_in(p);
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int x = p % domain.width() + dx, y = p / domain.width() + dy, q = y * domain.width() + x;
        if (x < 0 || y < 0 || x >= domain.width() || y >= domain.height() || !worth[q] ||
            tracer_.pixels().abandoned(static_cast<std::uint32_t>(q)))
          continue;
        points_along_side(q, -dx, -dy, seen, true, points);
      }
    }
    if (points.empty()) return;
    tracer_.ask_at(points, labels, Purpose::probe);
    take_in(points, labels, reconcile(points, labels));
  }
}

void Prober::probe_until_clean(const std::vector<std::uint8_t>& worth) {
  const PixelRect& domain = tracer_.lattice().domain();
  const int width = domain.width(), side = options_.probes_per_side;
  if (side <= 0) return;
  const double narrow_px = kNarrow * tracer_.lattice().side_px(0);
  for (int p = 0; p < domain.count(); ++p) {
    if (tracer_.pixels().suspect(static_cast<std::uint32_t>(p))) want_around(p, side * side);
    const double followed = tracer_.narrowest_followed(static_cast<std::uint32_t>(p));
    if (followed < narrow_px)
      wanted_[p] = std::max(wanted_[p], std::min(static_cast<int>(kSurety / followed), kMostWantedBeside));
    const double met = tracer_.narrowest_met(static_cast<std::uint32_t>(p));
    if (met < narrow_px)
      wanted_[p] = std::max(wanted_[p], static_cast<int>(std::min<double>(kSurety / met, kMostWanted)));
  }
  look_along_rim(worth);
  look_beside_clutter(worth);
  std::vector<FocalPoint> points;
  std::vector<std::uint32_t> labels;
  for (int round = 0; round < options_.max_probe_rounds; ++round) {
    points.clear();
    for (int pixel = 0; pixel < domain.count(); ++pixel) {
      if (wanted_[pixel] <= 0 || !worth[pixel] ||
          tracer_.pixels().abandoned(static_cast<std::uint32_t>(pixel)))
        continue;
      // Many rays come in rounds that grow: what the first of them find saves the others.
      const double share = round == 0 ? 0.25 : 1.0;
      const int fine =
          std::clamp(static_cast<int>(std::ceil(std::sqrt(share * wanted_[pixel]))), side, kFinestRound);
      const int x = domain.x0 + pixel % width, y = domain.y0 + pixel / width;
      for (int j = 0; j < fine; ++j)
        for (int i = 0; i < fine; ++i) {
          const std::uint64_t key = hash(seed_, 0x70726f6265, x, y, round, j * fine + i);
          points.push_back({x + (i + unit_double(key)) / fine, y + (j + unit_double(mix(key))) / fine});
        }
      grids_[pixel].push_back(fine);
      wanted_[pixel] -= fine * fine;
    }
    if (points.empty()) break;
    tracer_.ask_at(points, labels, Purpose::probe);
    take_in(points, labels, reconcile(points, labels));
  }
  for (int pixel = 0; pixel < domain.count(); ++pixel) {
    if (!worth[pixel] || tracer_.pixels().abandoned(static_cast<std::uint32_t>(pixel))) continue;
    unsettled_[pixel] = wanted_[pixel] > 0 || dismissed_[pixel] > kDismissed * std::max(1, asked_[pixel]) *
                                                                      tracer_.pixels().allowed_deviation(
                                                                          static_cast<std::uint32_t>(pixel));
  }
}

}  // namespace ifov::sampling
