// Cluttered pixels: rounds of jittered grids over the whole of them.
#include <algorithm>
#include <cmath>

#include "sampling/accuracy/radiance.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kClutterKey = 0x636c7574;

/// Sides of a round's grid, in cells.
constexpr int kCoarsest = 4, kFinest = 256;

/// Rounds weigh as the inverse of the variance of a round of n values where borders make it, n^(3/2), by their sizes
/// alone and never by what they found.
double round_weight(double count) { return count * std::sqrt(count); }

}  // namespace

double Radiance::Pixel::clutter_count() const {
  double count = 0.0;
  for (const ClutterRound& round : rounds) count += static_cast<double>(round.count());
  return count;
}

void Radiance::turn_to_clutter(std::size_t p) {
  Pixel& pixel = pixels_[p];
  pixel.cluttered = true;
  pixel.strata.assign(1, {});
  find_deviation(pixel, pixel.strata.front());
}

void Radiance::plan_clutter(std::size_t p, double count) {
  const int half = static_cast<int>(std::ceil(0.5 * std::sqrt(count) - 1e-9));
  pixels_[p].rounds.emplace_back(std::clamp(2 * half, kCoarsest, kFinest), stride_, keep_values_);
  clutter_planned_.push_back(p);
}

void Radiance::trace_clutter() {
  constexpr std::size_t kBatch = 1024;
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> materials;
  std::vector<float> values(kBatch * stride_);
  const auto of_round = [&](std::size_t p) {
    const Pixel& pixel = pixels_[p];
    const PixelRect& domain = tracer_.lattice().domain();
    const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
    pixel.rounds.back().request(px, py, hash(seed_, kClutterKey, px, py, pixel.rounds.size()), requests);
  };
  std::size_t next = 0;      // request
  std::size_t answered = 0;  // blocks of the round that is being filled
  std::size_t filled = 0;    // rounds
  const auto trace_batch = [&](std::size_t count) {
    const std::span<const PathRequest> batch = std::span<const PathRequest>(requests).subspan(next, count);
    ledger_.values_and_materials(batch, materials, std::span<float>(values).first(count * stride_));
    constexpr std::size_t kBlock = ClutterRound::kBlock;
    for (std::size_t i = 0; i < count; i += kBlock) {
      ClutterRound& round = pixels_[clutter_planned_[filled]].rounds.back();
      round.add_block(&values[i * stride_], std::span(materials).subspan(i).first<kBlock>(),
                      batch.subspan(i).first<kBlock>());
      if (++answered * kBlock == round.count()) answered = 0, ++filled;
    }
    next += count;
    if (next == requests.size()) requests.clear(), next = 0;
  };
  for (const std::size_t p : clutter_planned_) {
    of_round(p);
    while (requests.size() - next >= kBatch) trace_batch(kBatch);
  }
  if (!requests.empty()) trace_batch(requests.size() - next);
  clutter_planned_.clear();
}

void Radiance::clutter(const Pixel& pixel, const PixelFootprint* footprint, Point2 centre,
                       std::span<const int> columns, std::vector<ClutterRound::Moment>& moments) const {
  moments.assign(columns.size(), {});
  double total = 0.0;
  for (const ClutterRound& round : pixel.rounds) total += round_weight(static_cast<double>(round.count()));
  std::vector<double> weights, weighted(columns.size(), 0.0);
  for (const ClutterRound& round : pixel.rounds) {
    if (footprint != nullptr) round.weigh(*footprint, centre, weights);
    const double share = round_weight(static_cast<double>(round.count())) / total;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const ClutterRound::Moment m =
          footprint != nullptr ? round.moment(columns[c], weights) : round.moment(columns[c]);
      const double part = share * share * m.variance;
      moments[c].mean += share * m.mean;
      moments[c].variance += part;
      if (part > 0.0) weighted[c] += part * part / m.freedom;
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    moments[c].freedom = weighted[c] > 0.0 ? moments[c].variance * moments[c].variance / weighted[c] : 0.0;
}

}  // namespace ifov::sampling
