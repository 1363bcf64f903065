#include <algorithm>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/mapped_surface.h"
#include "sampling/accuracy/basis/no_label.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/radiance/control_variates.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/hash.h"

// What is foretold, as means over strata.

namespace ifov::sampling {

namespace {

/// Grids that means are taken over have so many cells a side, at first and at most.
constexpr int kCoarsestMeans = 16, kFinestMeans = 128;
/// Share of the allowed variance that such means may take over a whole pixel, and that they may take at most where the finest grid
/// does not do; over a part of it in proportion, so that they take no more together.
constexpr double kMeansShare = 0.08, kMostMeansShare = 0.2;

constexpr std::uint64_t kControlKey = 0x636f6e74726f6c;

}  // namespace

void ControlVariates::attach(SourcePixels& pixels, const BorderModel& model, const NearbySpread& nearby,
                             const LabelSpread& spread, const InverseSquares& allowed) const {
  if (!any()) return;
  for (SourcePixel& pixel : pixels.others()) {
    if (pixel.cluttered || pixel.model.outputs.empty()) continue;
    for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
      Stratum& stratum = pixel.strata[s];
      if (surface(pixel.source, stratum.label) == nullptr || stratum.count() > 0) continue;
      const double area = pixel.model.area[s];
      const std::span<const double> inverse = allowed(pixel.source);
      double needed = 0.0;
      for (std::size_t c = 0; c < columns_; ++c)
        if (fits_[stratum.label].on[c] != 0)
          needed =
              std::max(needed, area * area * spread.local(stratum.label, static_cast<int>(c)) * inverse[c]);
      if (needed <= kWorthValues) continue;
      if (integrate(pixel, s, model, inverse, stratum))
        stratum.deviation = nearby.deviation(pixel, stratum.label);
    }
  }
}

/// Mean of c over a stratum, from a jittered grid as fine as the error allowed asks for; false where none would do.
bool ControlVariates::integrate(const SourcePixel& pixel, std::size_t s, const BorderModel& model,
                                std::span<const double> inverse, Stratum& out) const {
  const PixelRect& domain = lattice_.domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double area = pixel.model.area[s];
  const MappedSurface& known = *surface(pixel.source, out.label);
  std::vector<FocalPoint> points;
  std::vector<int> ends;
  std::vector<float> rows;
  for (int side = kCoarsestMeans; side <= kFinestMeans; side *= 2) {
    BlockSums sums(stride_);
    const std::uint64_t grid_key = hash(seed_, kControlKey, px, py, table_.label(out.label), side);
    for (int j = 0; j < side; j += 2) {
      points.clear();
      ends.clear();
      for (int i = 0; i < side; i += 2) {
        for (int quarter = 0; quarter < 4; ++quarter) {
          const int a = i + quarter % 2, b = j + quarter / 2;
          const std::uint64_t cell = hash(grid_key, a, b);
          const FocalPoint at{px + (a + unit_double(cell)) / side, py + (b + unit_double(mix(cell))) / side};
          const std::uint32_t label = model.label_at(at);
          if (label == out.label || label == kNoLabel) points.push_back(place(at));
        }
        ends.push_back(static_cast<int>(points.size()));
      }
      rows.resize(points.size() * stride_);
      if (!points.empty()) foretell(known, out.label, points, rows);
      for (std::size_t block = 0, first = 0; block < ends.size(); ++block) {
        const float* block_rows[4];
        const std::size_t last = static_cast<std::size_t>(ends[block]);
        for (std::size_t i = first; i < last; ++i) block_rows[i - first] = &rows[i * stride_];
        if (last > first) sums.add_block({block_rows, last - first});
        first = last;
      }
    }
    if (sums.blocks() < kCoarsestMeans) continue;
    double share = 0.0;
    for (std::size_t c = 0; c < columns_; ++c)
      share = std::max(share, area * area * sums.squares(static_cast<int>(c)) /
                                  (sums.blocks() * sums.count()) * inverse[c]);
    if (share > (side < kFinestMeans ? kMeansShare : kMostMeansShare) * area) continue;
    StratumControl& control = out.control;
    control.mean.resize(columns_);
    control.variance.resize(columns_);
    control.spread.resize(columns_);
    control.freedom = sums.blocks();
    for (std::size_t c = 0; c < columns_; ++c) {
      const int column = static_cast<int>(c);
      control.mean[c] = sums.mean(column);
      control.variance[c] = sums.squares(column) / (sums.blocks() * sums.count());
      control.spread[c] = sums.spread(column);
    }
    return true;
  }
  return false;
}

}  // namespace ifov::sampling
