// What a tile's result says: means, intervals, abundances, counts, the detection statement.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/tile_work.h"

namespace ifov::sampling {

/// Of the sums over all columns.
void TileWork::finish(const LeafIntegrator& integrator, const std::vector<int>& outputs) {
  const std::size_t n = static_cast<std::size_t>(columns_);
  std::vector<double> limit(n), half(n);
  for (int o : outputs) {
    const OutputSums::Row sum = sums_[o];
    double worst = 0.0, widest = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t i = static_cast<std::size_t>(o) * n + c;
      half[c] = half_width(sum, c, outputs_[o].look);
      widest = std::max(widest, half[c]);
      result_.mean[i] = static_cast<float>(sum.mean[c]);
      result_.variance_geometry[i] = static_cast<float>(sum.geometry[c]);
      result_.variance_path[i] = static_cast<float>(sum.path[c].variance());
      result_.half_width[i] = static_cast<float>(half[c]);
    }
    if (widest > 0.0) {
      problem_.tolerance->limits(sums_.means(o), limit);
      for (std::size_t c = 0; c < n; ++c) worst = std::max(worst, half[c] / limit[c]);
    }
    result_.worst_ratio[o] = static_cast<float>(worst);
    result_.converged[o] = worst <= 1.0 + 1e-6;
  }
  for (const Radiance::Pixel& pixel : radiance_->pixels())
    for (const ClutterRound& round : pixel.rounds)
      clutter_rounds_[pixel.source].push_back(static_cast<std::uint32_t>(round.count()));

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
            const auto at =
                std::find_if(seen.begin(), seen.end(), [m = material](const auto& e) { return e.first == m; });
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

namespace {

/// The smallest area fraction that independent stratified rounds of these sizes find with probability 0.95: a
/// compact feature smaller than a stratum is missed by a round of n with probability 1 - n a.
double missable(const std::vector<double>& rounds) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double a = 0.5 * (low + high);
    double missed = 1.0;
    for (double n : rounds) missed *= std::max(0.0, 1.0 - n * a);
    (missed > 0.05 ? low : high) = a;
  }
  return high;
}

}  // namespace

void TileWork::report() {
  const PixelRect &d = lattice_.domain(), &t = problem_.tile;
  // Neighbours were mostly looked at alike.
  int known_looks = -1;
  float known_fraction = 1.0f;
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
    const int looks = prober_.clean_rounds(p);
    const auto& clutter = clutter_rounds_[p];
    if (looks != known_looks || clutter.size() > 0) {
      known_looks = clutter.size() > 0 ? -1 : looks;
      std::vector<double> rounds{static_cast<double>(options_.lattice) * options_.lattice};
      for (int r = 0; r < looks; ++r)
        rounds.push_back(static_cast<double>(options_.probes_per_side) * options_.probes_per_side);
      for (const std::uint32_t count : clutter) rounds.push_back(count);
      known_fraction = static_cast<float>(missable(rounds));
    }
    result_.missable_fraction[o] = known_fraction;
  }
  result_.seed_samples = ledger_.seed_rays();
  result_.probe_samples = ledger_.probe_rays();
  result_.rays = ledger_.field().counts();
  if (problem_.before != nullptr) add_counts_before();
  if (problem_.keep_memory) keep_memory();
}

}  // namespace ifov::sampling
