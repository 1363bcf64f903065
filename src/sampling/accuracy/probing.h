#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/edge_tracer.h"

namespace ifov::sampling {

/// Looks where the lattice did not: at the centres of known small objects, and at jittered points of every
/// pixel that tracing found to hold finer structure than the lattice announces, until a round finds nothing
/// new.
class Prober {
 public:
  Prober(EdgeTracer& tracer, RayLedger& ledger, const AccuracyOptions& options, std::uint64_t seed)
      : tracer_(tracer), ledger_(ledger), options_(options), seed_(seed) {
    clean_rounds_.assign(static_cast<std::size_t>(tracer.lattice().domain().count()), 0);
  }

  /// Looks at the seeds whose objects no ray has met yet.
  void follow_seeds(std::span<const FocalPoint> seeds, std::span<const std::uint32_t> objects);
  /// `worth`: the pixels of the domain where a find would matter.
  void probe_until_clean(const std::vector<std::uint8_t>& worth);

  /// Rounds of probes_per_side^2 points in which nothing contradicted the model of the pixel.
  int clean_rounds(int pixel) const { return clean_rounds_[pixel]; }

 private:
  std::vector<std::uint8_t> look(const std::vector<FocalPoint>& points, Purpose purpose);

  EdgeTracer& tracer_;
  RayLedger& ledger_;
  const AccuracyOptions& options_;
  std::uint64_t seed_;
  std::vector<int> clean_rounds_;
};

}  // namespace ifov::sampling
