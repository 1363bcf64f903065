// Replicated nets of paths, in strata whose paths make the variance.
#include <algorithm>
#include <numeric>

#include "sampling/accuracy/radiance.h"
#include "sampling/sequence.h"

namespace ifov::sampling {

namespace {

/// Points of a sequence looked at for each value of a stratum, before the net is left incomplete.
constexpr double kAttemptsPerValue = 4.0;

constexpr std::uint64_t kStratumNetKey = 0x736e657473;

}  // namespace

void Radiance::plan_stratum_nets(std::size_t p, std::size_t s, std::uint32_t count) {
  Pixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  Nets& nets = stratum.nets;
  if (nets.size == 0) {
    // The first values chose the size of the nets; an estimate that left them in would favour their luck.
    stratum.samples.clear();
    stratum.rounds.clear();
    stratum.strays = 0.0;
    stratum.stray_sum.clear();
    stratum.stray_squares.clear();
    nets.drawn.assign(kStratumReplicates, 0);
    nets.paths.assign(kStratumReplicates, 0);
    nets.accepted.assign(kStratumReplicates, 0);
    nets.sum.assign(kStratumReplicates * stride_, 0.0);
  }
  nets.size = count;
  planned_nets_.push_back({p, s});
}

/// Calls request(replicate, path request) for every value that a stratum's nets still lack.
template <class Request>
void Radiance::request_net(std::size_t p, std::size_t s, const Request& request) {
  Pixel& pixel = pixels_[p];
  Stratum& stratum = pixel.strata[s];
  Nets& nets = stratum.nets;
  const PixelRect& domain = tracer_.lattice().domain();
  const int px = domain.x0 + pixel.source % domain.width(), py = domain.y0 + pixel.source / domain.width();
  const double attempts = kAttemptsPerValue * (nets.size / std::max(pixel.model.area[s], 1e-6) + 1.0);
  for (std::size_t r = 0; r < kStratumReplicates; ++r) {
    const std::uint64_t key = hash(seed_, kStratumNetKey, px, py, table_.label(stratum.label), r);
    while (nets.paths[r] < nets.size && nets.drawn[r] < attempts) {
      const Point2 u = sequence_point(key, nets.drawn[r]++, 0);
      const Point2 at{px + u.x, py + u.y};
      const std::uint32_t model = tracer_.model_label({at.x, at.y});
      if (model != stratum.label && model != EdgeTracer::kNoLabel) continue;
      // Paths count on their own: pairs of dimensions are scrambled apart, so a net of paths stays whole
      // whatever points the stratum's shape refuses.
      request(r, PathRequest{{at.x, at.y}, key, nets.paths[r]++});
    }
  }
}

void Radiance::trace_nets() {
  constexpr std::size_t kBatch = 4096;
  std::vector<PathRequest> requests;
  struct Asker {
    Stratum* stratum;
    std::size_t replicate;
  };
  std::vector<Asker> askers;
  std::vector<std::uint32_t> labels;
  std::vector<float> values;
  const auto trace_batch = [&] {
    labels.clear();
    values.resize(requests.size() * stride_);
    ledger_.values(requests, labels, values);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      Stratum& stratum = *askers[i].stratum;
      const float* value = &values[i * stride_];
      if (labels[i] != stratum.label && !belongs(stratum, requests[i].point, labels[i], value)) continue;
      ++stratum.nets.accepted[askers[i].replicate];
      double* sum = &stratum.nets.sum[askers[i].replicate * stride_];
      for (std::size_t c = 0; c < stride_; ++c) sum[c] += value[c];
    }
    requests.clear();
    askers.clear();
  };
  for (const auto& [p, s] : planned_nets_)
    request_net(p, s, [&, stratum = &pixels_[p].strata[s]](std::size_t r, const PathRequest& request) {
      requests.push_back(request);
      askers.push_back({stratum, r});
      if (requests.size() == kBatch) trace_batch();
    });
  if (!requests.empty()) trace_batch();
  planned_nets_.clear();
}

void Radiance::net_moments(const Nets& nets, std::span<const int> columns, StratumMoments& out) const {
  const std::size_t n = columns.size();
  std::vector<double> squares(n, 0.0);
  double replicates = 0.0, count = 0.0;
  for (std::size_t r = 0; r < kStratumReplicates; ++r) {
    if (nets.accepted[r] == 0) continue;
    replicates += 1.0;
    count += nets.accepted[r];
    for (std::size_t c = 0; c < n; ++c) {
      const double d = nets.sum[r * stride_ + columns[c]] / nets.accepted[r] - out.mean[c];
      out.mean[c] += d / replicates;
      squares[c] += d * (nets.sum[r * stride_ + columns[c]] / nets.accepted[r] - out.mean[c]);
    }
  }
  out.sampled = replicates > 0.0;
  out.freedom = std::max(1.0, replicates - 1.0);
  out.share = 1.0 / std::max(1.0, count);
  // As the variance of one of `count` independent values, which is what allocation compares.
  for (std::size_t c = 0; c < n; ++c)
    out.variance[c] = squares[c] / (std::max(1.0, replicates - 1.0) * std::max(1.0, replicates)) * count;
}

std::size_t Radiance::Stratum::count() const {
  if (nets.size > 0) return std::accumulate(nets.accepted.begin(), nets.accepted.end(), std::size_t{0});
  double count = 0.0;
  for (const BlockSums& grid : rounds) count += grid.count();
  return static_cast<std::size_t>(count);
}

}  // namespace ifov::sampling
