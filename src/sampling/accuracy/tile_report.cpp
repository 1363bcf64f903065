#include "sampling/accuracy/tile_report.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/abundance_sums.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/edges/probing.h"
#include "sampling/accuracy/output_intervals.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/random_look.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

/// What cannot make this share of the error that is asked for is not followed; so where a tile holds more than one label no
/// half-width is less.
constexpr double kNotFollowed = 0.1;

}  // namespace

TileReport::TileReport(const Prober& prober, RayLedger& ledger, const LabelTable& table,
                       std::uint32_t most_samples, TileResult& result)
    : prober_(prober),
      ledger_(ledger),
      table_(table),
      most_samples_(most_samples),
      result_(result),
      random_rays_(ledger.label_rays().size()) {}

void TileReport::add_group(const Radiance& radiance, const LeafIntegrator& integrator,
                           const std::vector<int>& outputs, OutputIntervals& intervals) {
  add_intervals(outputs, intervals);
  add_reasons(radiance);
  const std::vector<Abundance> held =
      abundances_of(radiance, integrator, table_, ledger_.field(), outputs,
                    static_cast<std::size_t>(result_.tile.count()), intervals.stopping().normal());
  result_.abundances.insert(result_.abundances.end(), held.begin(), held.end());
}

void TileReport::add_intervals(const std::vector<int>& outputs, OutputIntervals& intervals) {
  const std::size_t n = static_cast<std::size_t>(result_.columns);
  std::vector<double> limit(n), half(n);
  const bool several = table_.several();
  for (int o : outputs) {
    const OutputSums::Row sum = intervals.sum(o);
    double worst = 0.0, widest = 0.0;
    intervals.limits(o, intervals.means(o), limit);
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t i = static_cast<std::size_t>(o) * n + c;
      half[c] = intervals.half_width(o, c);
      double geometry = sum.geometry[c];
      if (several && std::isfinite(limit[c]) && half[c] < kNotFollowed * limit[c]) {
        half[c] = kNotFollowed * limit[c];
        const double least = half[c] / intervals.stopping().normal();
        geometry = std::max(geometry, least * least - sum.path[c].variance());
      }
      widest = std::max(widest, half[c]);
      result_.mean[i] = static_cast<float>(sum.mean[c]);
      result_.variance_geometry[i] = static_cast<float>(geometry);
      result_.variance_path[i] = static_cast<float>(sum.path[c].variance());
      result_.half_width[i] = static_cast<float>(half[c]);
    }
    if (widest > 0.0) {
      for (std::size_t c = 0; c < n; ++c) worst = std::max(worst, half[c] / limit[c]);
    }
    result_.worst_ratio[o] = static_cast<float>(worst);
    result_.reasons[o] = worst <= 1.0 + 1e-6 ? 0 : bit(Reason::error);
  }
}

void TileReport::add_reasons(const Radiance& radiance) {
  // Rounds grow, nets double: a pixel that has spent half of its samples found no room for a next step.
  for (const SourcePixel& pixel : radiance.pixels().others()) {
    if (ledger_.spent(pixel.source) >= most_samples_ / 2)
      for (int o : pixel.model.outputs)
        if (result_.reasons[o] == bit(Reason::error)) result_.reasons[o] = bit(Reason::samples);
    // Clutter is sampled; elsewhere what went on turning up is not in the model.
    if (prober_.unsettled(pixel.source) && !pixel.cluttered)
      for (int o : pixel.model.outputs) result_.set(o, Reason::structure);
    note_random_rays(pixel);
  }
}

/// Values are random points too: those of clutter stand in grids over the whole pixel, those of strata in grids over a
/// part of it each.
void TileReport::note_random_rays(const SourcePixel& pixel) {
  RandomRays& rays = random_rays_[pixel.source];
  if (pixel.cluttered) {
    for (const ClutterRound& round : pixel.rounds) rays.grids.push_back(round.sides());
    return;
  }
  double fewest = INFINITY;
  for (std::size_t s = 0; s < pixel.strata.size(); ++s)
    if (pixel.model.area[s] > 0.0)
      fewest = std::min(fewest, static_cast<double>(pixel.strata[s].count()) / pixel.model.area[s]);
  if (std::isfinite(fewest)) rays.independent = std::floor(fewest);
}

void TileReport::finish(const Lattice& lattice, const RandomLook& look) {
  const PixelRect &d = lattice.domain(), &t = result_.tile;
  Detection detection;
  for (int p = 0; p < d.count(); ++p) {
    const int x = d.x0 + p % d.width(), y = d.y0 + p / d.width();
    const std::uint32_t labels = ledger_.traced_labels(p), values = ledger_.traced_values(p);
    if (x < t.x0 || x >= t.x1 || y < t.y0 || y >= t.y1) {
      result_.halo_samples += labels + values;
      continue;
    }
    const std::size_t o = static_cast<std::size_t>((y - t.y0) * t.width() + x - t.x0);
    result_.label_rays[o] = labels;
    result_.radiance_evaluations[o] = values;
    result_.samples[o] = labels + values;
    RandomRays rays = random_rays_[p];
    if (look.covers(p)) rays.grids.push_back(GridSides::square(look.side()));
    for (const int side : prober_.grids(p)) rays.grids.push_back(GridSides::square(side));
    result_.missable_fraction[o] = detection.missable_fraction(rays);
  }
  result_.pilot_samples = ledger_.pilot_rays();
  result_.probe_samples = ledger_.probe_rays();
  result_.rays = ledger_.field().counts();
}

}  // namespace ifov::sampling
