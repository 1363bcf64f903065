// What a tile's result says: means, intervals, abundances, counts, the detection statement.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/tile_work.h"

namespace ifov::sampling {

namespace {

/// What cannot make this share of the error that is asked for is not followed; so where a tile holds more than one label no
/// half-width is less.
constexpr double kNotFollowed = 0.1;

}  // namespace

/// Of the sums over all columns.
void TileWork::finish(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = static_cast<std::size_t>(columns_);
  std::vector<double> limit(n), half(n);
  const bool several = table_.several();
  for (int o : outputs) {
    const OutputSums::Row sum = sums_[o];
    double worst = 0.0, widest = 0.0;
    problem_.tolerance->limits(sums_.means(o), limit);
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t i = static_cast<std::size_t>(o) * n + c;
      half[c] = half_width(sum, c, outputs_[o].look);
      double geometry = sum.geometry[c];
      if (several && std::isfinite(limit[c]) && half[c] < kNotFollowed * limit[c]) {
        half[c] = kNotFollowed * limit[c];
        const double least = half[c] / stopping_.normal();
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
  // Rounds grow, nets double: a pixel that has spent half of its samples found no room for a next step.
  for (const Radiance::Pixel& pixel : radiance_->pixels()) {
    if (ledger_.spent(pixel.source) >= options_.max_samples_per_pixel / 2)
      for (int o : pixel.model.outputs)
        if (result_.reasons[o] == bit(Reason::error)) result_.reasons[o] = bit(Reason::samples);
    // Clutter is sampled; elsewhere what went on turning up is not in the model.
    if (prober_.unsettled(pixel.source) && !pixel.cluttered)
      for (int o : pixel.model.outputs) result_.set(o, Reason::structure);
    note_looks(pixel);
  }

  struct Share {
    std::uint32_t material;
    double fraction = 0.0, variance = 0.0;
  };
  std::vector<SmallVector<Share, 2>> shares(outputs_.size());
  const auto share_of_material = [&](int output, std::uint32_t material) -> Share& {
    for (Share& s : shares[output])
      if (s.material == material) return s;
    return shares[output].push_back(Share{material});
  };
  const auto share_of = [&](int output, std::uint32_t label) -> Share& {
    return share_of_material(output, ledger_.field().material_of(table_.label(label)));
  };
  for (const Radiance::PlainPixel& pixel : radiance_->plain_pixels())
    share_of(pixel.output, pixel.label).fraction += pixel.weight;
  for (const Radiance::Pixel& pixel : radiance_->pixels()) {
    const PixelModel& model = pixel.model;
    for (std::size_t o = 0; o < model.outputs.size(); ++o) {
      const int output = model.outputs[o];
      if (pixel.cluttered) {
        const double w = integrator.whole_weight(pixel.source, output), count = pixel.clutter_count();
        std::vector<std::pair<std::uint32_t, double>> seen;
        for (const ClutterRound& round : pixel.rounds)
          for (const auto& [material, hits] : round.materials()) {
            const auto at = std::find_if(seen.begin(), seen.end(),
                                         [m = material](const auto& e) { return e.first == m; });
            if (at == seen.end())
              seen.push_back({material, hits});
            else
              at->second += hits;
          }
        for (const auto& [material, hits] : seen) {
          Share& share = share_of_material(output, material);
          const double f = hits / count;
          share.fraction += w * f;
          share.variance += w * w * f * (1.0 - f) / count;
        }
        continue;
      }
      for (std::size_t r = 0; r < model.labels.size(); ++r)
        if (model.weight_of(r, o) > 0.0) share_of(output, model.labels[r]).fraction += model.weight_of(r, o);
      for (std::size_t b = 0; b < model.borders.size(); ++b) {
        const PixelModel::Border& border = model.borders[b];
        if (&share_of(output, border.inner) == &share_of(output, border.outer)) continue;
        const double variance = model.border_variance_of(b, o);
        share_of(output, border.inner).variance += variance;
        share_of(output, border.outer).variance += variance;
      }
      for (std::size_t l = 0; l < model.loose.size(); ++l) {
        const double w = model.loose_weight_of(l, o);
        for (std::uint32_t corner : model.loose[l].corner)
          share_of(output, corner).variance += 0.25 * w * w / 12.0;
      }
    }
  }
  for (int o : outputs) {
    std::sort(shares[o].begin(), shares[o].end(),
              [](const Share& a, const Share& b) { return a.material < b.material; });
    for (const Share& s : shares[o])
      result_.abundances.push_back({static_cast<std::uint32_t>(o), s.material, static_cast<float>(s.fraction),
                                    static_cast<float>(stopping_.normal() * std::sqrt(s.variance))});
  }
}

/// Values are random points too: those of clutter stand in grids over the whole pixel, those of strata in grids over a
/// part of it each.
void TileWork::note_looks(const Radiance::Pixel& pixel) {
  RandomLooks& looks = looks_[pixel.source];
  if (pixel.cluttered) {
    for (const ClutterRound& round : pixel.rounds) looks.grids.push_back(round.side());
    return;
  }
  double fewest = INFINITY;
  for (std::size_t s = 0; s < pixel.strata.size(); ++s)
    if (pixel.model.area[s] > 0.0)
      fewest = std::min(fewest, static_cast<double>(pixel.strata[s].count()) / pixel.model.area[s]);
  if (std::isfinite(fewest)) looks.independent = std::floor(fewest);
}

void TileWork::report() {
  const PixelRect &d = lattice_.domain(), &t = problem_.tile;
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
    RandomLooks looks = looks_[p];
    if (was_looked_at(p)) looks.grids.push_back(options_.looks_per_side);
    looks.grids.insert(looks.grids.end(), prober_.grids(p).begin(), prober_.grids(p).end());
    result_.missable_fraction[o] = detection.missable_fraction(looks);
  }
  result_.seed_samples = ledger_.seed_rays();
  result_.probe_samples = ledger_.probe_rays();
  result_.rays = ledger_.field().counts();
  if (problem_.before != nullptr) add_counts_before();
  if (problem_.keep_memory) keep_memory();
}

}  // namespace ifov::sampling
