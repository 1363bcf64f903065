#include "sampling/accuracy/radiance/radiance_clutter.h"

#include <algorithm>
#include <cmath>

#include "core/call_scope.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kClutterKey = 0x636c7574;

/// Values of a round.
constexpr double kFewest = 8.0, kMost = 8192.0 * 8192.0;

}  // namespace

RadianceClutter::RadianceClutter(std::vector<SourcePixel>& pixels, const Lattice& lattice, RayLedger& ledger,
                                 bool keep, std::uint64_t seed)
    : pixels_(pixels),
      lattice_(lattice),
      ledger_(ledger),
      keep_(keep),
      seed_(seed),
      stride_(static_cast<std::size_t>(ledger.field().stride())) {}

void RadianceClutter::plan(std::size_t p, double count) {
  std::vector<ClutterRound>& rounds = pixels_[p].rounds;
  rounds.emplace_back(GridSides::even(std::clamp(count, kFewest, kMost), rounds.size() % 2 == 0), stride_,
                      keep_);
  planned_.push_back(p);
}

void RadianceClutter::trace() {
  constexpr std::size_t kBatch = 1024, kBlock = ClutterRound::kBlock;
  std::vector<PathRequest> requests;
  std::vector<ClutterRound*> rounds;  // of each block of the batch
  std::vector<std::uint32_t> materials;
  std::vector<float> values(kBatch * stride_);
  const auto trace_batch = [&] {
    ledger_.values_and_materials(requests, materials,
                                 std::span<float>(values).first(requests.size() * stride_));
    for (std::size_t b = 0; b < rounds.size(); ++b)
      rounds[b]->add_block(&values[b * kBlock * stride_],
                           std::span(materials).subspan(b * kBlock).first<kBlock>(),
                           std::span<const PathRequest>(requests).subspan(b * kBlock).first<kBlock>());
    requests.clear();
    rounds.clear();
  };
  const PixelRect& domain = lattice_.domain();
  for (const std::size_t p : planned_) {
    SourcePixel& pixel = pixels_[p];
    ClutterRound& round = pixel.rounds.back();
    const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
    const std::uint64_t key = hash(seed_, kClutterKey, px, py, pixel.rounds.size());
    // One sequence for all rounds: what one has left out, the next looks at.
    const auto before =
        static_cast<std::uint32_t>(pixel.clutter_count()) - static_cast<std::uint32_t>(round.count());
    const ClutterRound::Paths paths{hash(seed_, kClutterKey, px, py), before};
    for (std::uint32_t b = 0; b < round.blocks(); ++b) {
      round.request(px, py, key, paths, b, requests);
      rounds.push_back(&round);
      if (requests.size() == kBatch) trace_batch();
    }
  }
  if (!requests.empty()) trace_batch();
  planned_.clear();
}

void RadianceClutter::moments(const SourcePixel& pixel, const PixelFootprint* footprint, Point2 centre,
                              std::span<const int> columns, std::vector<ClutterRound::Moment>& moments) {
  moments.assign(columns.size(), {});
  double total = 0.0;
  for (const ClutterRound& round : pixel.rounds) total += round_weight(static_cast<double>(round.count()));
  std::vector<double> weights;
  std::vector<double> weighted(columns.size(), 0.0);
  for (const ClutterRound& round : pixel.rounds) {
    stop_if_cancelled();
    if (footprint != nullptr) weights = round.weigh(*footprint, centre);
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
