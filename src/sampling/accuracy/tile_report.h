#pragma once

#include <cstdint>
#include <vector>

#include "sampling/accuracy/detection.h"

namespace ifov::sampling {

class LabelTable;
class Lattice;
class LeafIntegrator;
class OutputIntervals;
class Prober;
class Radiance;
class RandomLook;
class RayLedger;
struct SourcePixel;
struct TileResult;

/// Writes what a tile's result says: means and intervals, abundances, counts, the detection statement.
class TileReport {
 public:
  /// `most_samples`: that a pixel may spend.
  TileReport(const Prober& prober, RayLedger& ledger, const LabelTable& table, std::uint32_t most_samples,
             TileResult& result);

  /// Of a group of source pixels, once the sums over all columns are gathered.
  void add_group(const Radiance& radiance, const LeafIntegrator& integrator, const std::vector<int>& outputs,
                 OutputIntervals& intervals);
  /// Counts, and what could have been missed.
  void finish(const Lattice& lattice, const RandomLook& look);

 private:
  void add_intervals(const std::vector<int>& outputs, OutputIntervals& intervals);
  void add_reasons(const Radiance& radiance);
  void note_random_rays(const SourcePixel& pixel);

  const Prober& prober_;
  RayLedger& ledger_;
  const LabelTable& table_;
  std::uint32_t most_samples_;
  TileResult& result_;
  std::vector<RandomRays> random_rays_;  // per source pixel: values at random points
};

}  // namespace ifov::sampling
