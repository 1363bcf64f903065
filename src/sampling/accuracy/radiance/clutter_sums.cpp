#include "sampling/accuracy/radiance/clutter_sums.h"

#include <algorithm>

#include "sampling/accuracy/radiance/radiance_clutter.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/accuracy/weights/clutter_grid.h"
#include "sampling/accuracy/weights/leaf_integrator.h"

namespace ifov::sampling {

namespace {

/// So many sums of a tile are kept, 72 MB; those of further pixels are made anew whenever they are asked for.
constexpr std::size_t kMostKept = std::size_t{3} << 20;

}  // namespace

ClutterSums::Pixel& ClutterSums::room_for(const SourcePixel& pixel, std::size_t columns) {
  const auto number = static_cast<std::size_t>(pixel.source);
  if (pixels_.size() <= number) pixels_.resize(number + 1);
  const std::size_t wanted = pixel.model.outputs.size() * columns, had = pixels_[number].sums.size();
  if (kept_ - had + wanted > kMostKept) {
    passing_ = {};
    return passing_;
  }
  kept_ += wanted - had;
  return pixels_[number];
}

void ClutterSums::take(const SourcePixel& pixel, const LeafIntegrator& integrator,
                       std::span<const int> columns, std::span<const std::vector<std::size_t>> by_group) {
  const auto& outputs = pixel.model.outputs;
  Pixel& known = room_for(pixel, columns.size());
  taken_ = &known;
  if (known.outputs != outputs.size() || known.rounds > pixel.rounds.size() ||
      !std::equal(known.columns.begin(), known.columns.end(), columns.begin(), columns.end())) {
    known = {};
    known.outputs = outputs.size();
    known.columns.assign(columns.begin(), columns.end());
    known.sums.resize(outputs.size() * columns.size());
  }
  for (; known.rounds < pixel.rounds.size(); ++known.rounds) {
    const ClutterRound& round = pixel.rounds[known.rounds];
    const double share = RadianceClutter::round_weight(static_cast<double>(round.count()));
    known.total += share;
    ClutterGrid grid(round, columns);
    for (std::size_t o = 0; o < outputs.size(); ++o)
      for (std::size_t g = 0; g < by_group.size(); ++g) {
        if (by_group[g].empty() || integrator.whole_weight(pixel.source, outputs[o], g) == 0.0) continue;
        const bool any = grid.weigh(integrator.footprint(g), integrator.centre(outputs[o], g));
        for (const std::size_t c : by_group[g]) {
          const ClutterRound::Moment m = any ? grid.moment(c) : round.moment(columns[c]);
          Sum& sum = known.sums[o * columns.size() + c];
          const double part = share * share * m.variance;
          sum.mean += share * m.mean;
          sum.variance += part;
          if (part > 0.0) sum.fourth += part * part / m.freedom;
        }
      }
  }
}

ClutterSums::Sums ClutterSums::of(std::size_t output) const {
  const std::size_t n = taken_->columns.size();
  return {std::span(taken_->sums).subspan(output * n, n), taken_->total};
}

}  // namespace ifov::sampling
