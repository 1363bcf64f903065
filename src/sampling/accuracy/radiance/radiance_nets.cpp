#include "sampling/accuracy/radiance/radiance_nets.h"

#include <algorithm>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/radiance/control_variates.h"
#include "sampling/accuracy/radiance/strata.h"
#include "sampling/accuracy/radiance/stratum_moments.h"
#include "sampling/accuracy/radiance/stray_values.h"
#include "sampling/hash.h"
#include "sampling/sequence.h"

namespace ifov::sampling {

namespace {

/// Points of a sequence looked at for each value of a stratum, before the net is left incomplete.
constexpr double kAttemptsPerValue = 4.0;

constexpr std::uint64_t kStratumNetKey = 0x736e657473;

}  // namespace

RadianceNets::RadianceNets(std::vector<SourcePixel>& pixels, const BorderModel& model,
                           const StrayValues& strays, const LabelTable& table, RayLedger& ledger,
                           const ControlVariates& controls, std::uint64_t seed)
    : pixels_(pixels),
      model_(model),
      strays_(strays),
      table_(table),
      ledger_(ledger),
      controls_(controls),
      seed_(seed),
      stride_(static_cast<std::size_t>(ledger.field().stride())) {}

void RadianceNets::plan(std::size_t p, std::size_t s, std::uint32_t count) {
  SourcePixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  StratumNets& nets = stratum.nets;
  if (nets.size == 0) {
    // The first values chose the size of the nets; an estimate that left them in would favour their luck.
    stratum.samples.clear();
    stratum.rounds.clear();
    stratum.strays = 0.0;
    stratum.stray_sum.clear();
    stratum.stray_squares.clear();
    nets.drawn.assign(kReplicates, 0);
    nets.paths.assign(kReplicates, 0);
    nets.accepted.assign(kReplicates, 0);
    nets.sum.assign(kReplicates * stride_, 0.0);
  }
  nets.size = count;
  planned_.push_back({p, s});
}

/// Calls request(replicate, path request) for every value that a stratum's nets still lack.
template <class Request>
void RadianceNets::request_net(std::size_t p, std::size_t s, const Request& request) {
  SourcePixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  StratumNets& nets = stratum.nets;
  const PixelRect& domain = model_.tree().lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double attempts = kAttemptsPerValue * (nets.size / std::max(pixel.model.area[s], 1e-6) + 1.0);
  for (std::size_t r = 0; r < kReplicates; ++r) {
    const std::uint64_t key = hash(seed_, kStratumNetKey, px, py, table_.label(stratum.label), r);
    while (nets.paths[r] < nets.size && nets.drawn[r] < attempts) {
      const Point2 u = sequence_point(key, nets.drawn[r]++, 0);
      const Point2 at{px + u.x, py + u.y};
      const std::uint32_t model = model_.label_at({at.x, at.y});
      if (model != stratum.label && model != kNoLabel) continue;
      // Paths count on their own: pairs of dimensions are scrambled apart, so a net of paths stays whole
      // whatever points the stratum's shape refuses.
      request(r, PathRequest{{at.x, at.y}, key, nets.paths[r]++});
    }
  }
}

void RadianceNets::trace() {
  constexpr std::size_t kBatch = 4096;
  std::vector<PathRequest> requests;
  struct Asker {
    const SourcePixel* pixel;
    Stratum* stratum;
    std::size_t replicate;
  };
  std::vector<Asker> askers;
  std::vector<std::uint32_t> labels, expected;
  std::vector<float> values, foretold(stride_);
  const auto trace_batch = [&] {
    labels.clear();
    values.resize(requests.size() * stride_);
    ledger_.values_expecting(requests, expected, labels, values);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      Stratum& stratum = *askers[i].stratum;
      const float* value = &values[i * stride_];
      if (labels[i] != stratum.label && !strays_.belongs(stratum, requests[i].point, labels[i], value))
        continue;
      ++stratum.nets.accepted[askers[i].replicate];
      double* sum = &stratum.nets.sum[askers[i].replicate * stride_];
      for (std::size_t c = 0; c < stride_; ++c) sum[c] += value[c];
      if (!stratum.foretold()) continue;
      controls_.foretell(*askers[i].pixel, stratum, {&requests[i].point, 1}, foretold);
      for (std::size_t c = 0; c < stride_; ++c) sum[c] -= foretold[c];
    }
    requests.clear();
    expected.clear();
    askers.clear();
  };
  for (const auto& [p, s] : planned_)
    request_net(
        p, s,
        [&, pixel = &pixels_[p], stratum = &pixels_[p].strata[s]](std::size_t r, const PathRequest& request) {
          requests.push_back(request);
          expected.push_back(stratum->label);
          askers.push_back({pixel, stratum, r});
          if (requests.size() == kBatch) trace_batch();
        });
  if (!requests.empty()) trace_batch();
  planned_.clear();
}

void RadianceNets::moments(const StratumNets& nets, std::span<const int> columns, StratumMoments& out) {
  const std::size_t n = columns.size(), stride = nets.sum.size() / kReplicates;
  std::vector<double> squares(n, 0.0);
  double replicates = 0.0, count = 0.0;
  for (std::size_t r = 0; r < kReplicates; ++r) {
    if (nets.accepted[r] == 0) continue;
    replicates += 1.0;
    count += nets.accepted[r];
    for (std::size_t c = 0; c < n; ++c) {
      const double d = nets.sum[r * stride + columns[c]] / nets.accepted[r] - out.mean[c];
      out.mean[c] += d / replicates;
      squares[c] += d * (nets.sum[r * stride + columns[c]] / nets.accepted[r] - out.mean[c]);
    }
  }
  out.sampled = replicates > 0.0;
  out.freedom = std::max(1.0, replicates - 1.0);
  out.share = 1.0 / std::max(1.0, count);
  // As the variance of one of `count` independent values, which is what allocation compares.
  for (std::size_t c = 0; c < n; ++c)
    out.variance[c] = squares[c] / (std::max(1.0, replicates - 1.0) * std::max(1.0, replicates)) * count;
}

}  // namespace ifov::sampling
