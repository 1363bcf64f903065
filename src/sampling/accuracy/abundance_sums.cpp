#include "sampling/accuracy/abundance_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/small_vector.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/accuracy/weights/leaf_integrator.h"
#include "sampling/tile.h"

namespace ifov::sampling {

std::vector<Abundance> abundances_of(const Radiance& radiance, const LeafIntegrator& integrator,
                                     const LabelTable& table, const Field& field,
                                     std::span<const int> outputs, std::size_t count, double normal) {
  constexpr std::size_t kReference = 0;  // the group of columns whose footprint shares hold for
  struct Share {
    std::uint32_t material;
    double fraction = 0.0, variance = 0.0;
  };
  std::vector<SmallVector<Share, 2>> shares(count);
  const auto share_of_material = [&](int output, std::uint32_t material) -> Share& {
    for (Share& s : shares[output])
      if (s.material == material) return s;
    return shares[output].push_back(Share{material});
  };
  const auto share_of = [&](int output, std::uint32_t label) -> Share& {
    return share_of_material(output, field.material_of(table.label(label)));
  };
  for (const PlainPixel& pixel : radiance.pixels().plain())
    share_of(pixel.output, pixel.label).fraction += pixel.weight;
  for (const SourcePixel& pixel : radiance.pixels().others()) {
    const PixelModel& model = pixel.model;
    for (std::size_t o = 0; o < model.outputs.size(); ++o) {
      const int output = model.outputs[o];
      if (model.groups > 1 && integrator.whole_weight(pixel.source, output, kReference) == 0.0) continue;
      if (pixel.cluttered) {
        const double w = integrator.whole_weight(pixel.source, output, kReference),
                     values = pixel.clutter_count();
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
          const double f = hits / values;
          share.fraction += w * f;
          share.variance += w * w * f * (1.0 - f) / values;
        }
        continue;
      }
      for (std::size_t r = 0; r < model.labels.size(); ++r)
        if (model.weight_of(r, o, kReference) > 0.0)
          share_of(output, model.labels[r]).fraction += model.weight_of(r, o, kReference);
      for (std::size_t b = 0; b < model.borders.size(); ++b) {
        const PixelModel::Border& border = model.borders[b];
        if (&share_of(output, border.inner) == &share_of(output, border.outer)) continue;
        const double variance = model.border_variance_of(b, o, kReference);
        share_of(output, border.inner).variance += variance;
        share_of(output, border.outer).variance += variance;
      }
      for (std::size_t l = 0; l < model.loose.size(); ++l) {
        const double w = model.loose_weight_of(l, o, kReference);
        for (std::uint32_t corner : model.loose[l].corner)
          share_of(output, corner).variance += 0.25 * w * w / 12.0;
      }
    }
  }
  std::vector<Abundance> found;
  for (int o : outputs) {
    std::sort(shares[o].begin(), shares[o].end(),
              [](const Share& a, const Share& b) { return a.material < b.material; });
    for (const Share& s : shares[o])
      found.push_back({static_cast<std::uint32_t>(o), s.material, static_cast<float>(s.fraction),
                       static_cast<float>(normal * std::sqrt(s.variance))});
  }
  return found;
}

}  // namespace ifov::sampling
