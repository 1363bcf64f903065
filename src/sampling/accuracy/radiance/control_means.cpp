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
#include "sampling/accuracy/weights/leaf_integrator.h"
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

void ControlVariates::attach(SourcePixels& pixels, const BorderModel& model, const LeafIntegrator& integrator,
                             const NearbySpread& nearby, const LabelSpread& spread,
                             const InverseSquares& allowed) const {
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
      if (integrate(pixel, s, model, integrator, inverse, stratum))
        stratum.deviation = nearby.deviation(pixel, stratum.label);
    }
  }
}

/// A jittered grid over the part of a pixel that belongs to a stratum.
struct ControlVariates::Grid {
  const SourcePixel& pixel;
  const MappedSurface& surface;
  std::uint32_t label;
  const BorderModel& model;
  int side;
};

template <class Block>
void ControlVariates::walk(const Grid& grid, Block block) const {
  const PixelRect& domain = lattice_.domain();
  const int px = domain.x0 + grid.pixel.source % domain.width(),
            py = domain.y0 + grid.pixel.source / domain.width();
  const std::uint64_t key = hash(seed_, kControlKey, px, py, table_.label(grid.label), grid.side);
  std::vector<FocalPoint> points, looked_up;
  std::vector<int> ends;
  std::vector<float> rows;
  for (int j = 0; j < grid.side; j += 2) {
    points.clear();
    looked_up.clear();
    ends.clear();
    for (int i = 0; i < grid.side; i += 2) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        const int a = i + quarter % 2, b = j + quarter / 2;
        const std::uint64_t cell = hash(key, a, b);
        const FocalPoint at{px + (a + unit_double(cell)) / grid.side,
                            py + (b + unit_double(mix(cell))) / grid.side};
        const std::uint32_t label = grid.model.label_at(at);
        if (label != grid.label && label != kNoLabel) continue;
        points.push_back(at);
        looked_up.push_back(place(at));
      }
      ends.push_back(static_cast<int>(points.size()));
    }
    rows.resize(points.size() * stride_);
    if (!points.empty()) foretell(grid.surface, grid.label, looked_up, rows);
    for (std::size_t k = 0, first = 0; k < ends.size(); ++k) {
      const float* block_rows[4];
      const std::size_t last = static_cast<std::size_t>(ends[k]);
      for (std::size_t i = first; i < last; ++i) block_rows[i - first] = &rows[i * stride_];
      if (last > first)
        block(std::span<const FocalPoint>(points).subspan(first, last - first),
              std::span<const float* const>(block_rows, last - first));
      first = last;
    }
  }
}

/// Mean of c over a stratum, from a jittered grid as fine as the error allowed asks for; false where none would do.
bool ControlVariates::integrate(const SourcePixel& pixel, std::size_t s, const BorderModel& model,
                                const LeafIntegrator& integrator, std::span<const double> inverse,
                                Stratum& out) const {
  const double area = pixel.model.area[s];
  for (int side = kCoarsestMeans; side <= kFinestMeans; side *= 2) {
    BlockSums sums(stride_);
    const Grid grid{pixel, *surface(pixel.source, out.label), out.label, model, side};
    walk(grid,
         [&](std::span<const FocalPoint>, std::span<const float* const> rows) { sums.add_block(rows); });
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
    if (!integrator.unit_box()) weigh(grid, integrator, control);
    return true;
  }
  return false;
}

/// The same mean as each output weighs it, sum w c / sum w, and its variance, sum s^2 w^2 / (sum w)^2: s^2 by blocks as in BlockSums.
void ControlVariates::weigh(const Grid& grid, const LeafIntegrator& integrator,
                            StratumControl& control) const {
  const PixelModel& pixel = grid.pixel.model;
  const std::size_t slots = pixel.slots();
  struct Slot {
    double weight = 0.0, squares = 0.0,
           untold = 0.0;  // `untold`: squares of weights in blocks that tell no variance
  };
  std::vector<Slot> of_slot(slots);
  std::vector<double> sums(pixel.outputs.size() * columns_, 0.0), variances(sums.size(), 0.0),
      mean_square(columns_, 0.0);
  double blocks = 0.0;
  std::vector<double> square(columns_);
  walk(grid, [&](std::span<const FocalPoint> points, std::span<const float* const> rows) {
    for (std::size_t c = 0; c < columns_ && rows.size() > 1; ++c) {
      const double step = static_cast<double>(rows[0][c]) - rows[1][c];
      const double twist = rows.size() == 4 ? step - (static_cast<double>(rows[2][c]) - rows[3][c]) : 0.0;
      square[c] = rows.size() == 4 ? 0.25 * twist * twist : 0.5 * step * step;
      mean_square[c] += square[c];
    }
    if (rows.size() > 1) blocks += 1.0;
    for (std::size_t o = 0; o < pixel.outputs.size(); ++o)
      for (std::size_t g = 0; g < pixel.groups; ++g) {
        const Point2 centre = integrator.centre(pixel.outputs[o], g);
        double w[4], all = 0.0, squares = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
          w[i] = integrator.footprint(g).density(points[i].x_px - centre.x, points[i].y_px - centre.y);
          all += w[i];
          squares += w[i] * w[i];
        }
        if (all == 0.0) continue;
        Slot& slot = of_slot[o * pixel.groups + g];
        slot.weight += all;
        slot.squares += squares;
        if (rows.size() == 1) slot.untold += squares;
        for (std::size_t c = 0; c < columns_; ++c) {
          if (integrator.group_of(c) != g) continue;
          double& sum = sums[o * columns_ + c];
          for (std::size_t i = 0; i < rows.size(); ++i) sum += w[i] * static_cast<double>(rows[i][c]);
          if (rows.size() > 1) variances[o * columns_ + c] += square[c] * squares;
        }
      }
  });
  control.weighed_mean.assign(sums.size(), 0.0f);
  control.weighed_variance.assign(sums.size(), 0.0f);
  control.weighed_freedom.assign(pixel.outputs.size(), static_cast<float>(control.freedom));
  for (std::size_t o = 0; o < pixel.outputs.size(); ++o) {
    for (std::size_t c = 0; c < columns_; ++c) {
      const Slot& slot = of_slot[o * pixel.groups + integrator.group_of(c)];
      if (slot.weight == 0.0) continue;
      const std::size_t at = o * columns_ + c;
      const double total = slot.weight * slot.weight,
                   untold = blocks > 0.0 ? slot.untold * mean_square[c] / blocks : 0.0;
      control.weighed_mean[at] = static_cast<float>(sums[at] / slot.weight);
      control.weighed_variance[at] = static_cast<float>((variances[at] + untold) / total);
      // Four values of a block make one degree of freedom.
      control.weighed_freedom[o] = std::min(control.weighed_freedom[o],
                                            static_cast<float>(std::max(1.0, 0.25 * total / slot.squares)));
    }
  }
}

bool ControlVariates::affordable(const ColumnFootprints& footprints, int sources, int columns) {
  if (footprints.whole_pixel()) return true;
  constexpr double kMostBytes = 256e6;
  const double across = 2.0 * footprints.reach() + 1.0;
  return sources * across * across * columns * 2.0 * sizeof(float) <= kMostBytes;
}

}  // namespace ifov::sampling
