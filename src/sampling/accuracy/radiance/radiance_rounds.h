#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

class BorderModel;
class ControlVariates;
class LabelTable;
class RayLedger;
class StrayValues;
struct KeptValues;
struct SourcePixel;
struct Stratum;

/// Rounds of values at jittered points, uniform inside each stratum, one more in a stratum at a time.
class RadianceRounds {
 public:
  /// `kept` takes up the values for a footprint that weighs those of a pixel unlike; null: their sums are enough.
  RadianceRounds(std::vector<SourcePixel>& pixels, const BorderModel& model, const StrayValues& strays,
                 const LabelTable& table, RayLedger& ledger, const ControlVariates& controls,
                 KeptValues* kept, std::uint64_t seed);

  /// Sequences of paths in a round. Each has one value in every block of 2 x 2 cells.
  static constexpr std::uint32_t kReplicates = 4;

  /// Plans a round of about `count` values in a stratum.
  void plan(std::size_t pixel, std::size_t stratum, double count);
  /// Traces what was planned.
  void trace();

 private:
  struct Planned {
    std::size_t pixel, stratum;
    std::uint32_t block;
    std::uint8_t replicate;
    bool twin;  ///< a second path at the point of the value before
    bool same_block(const Planned& other) const {
      return pixel == other.pixel && stratum == other.stratum && block == other.block;
    }
  };
  struct PlannedRound {
    std::size_t pixel, stratum;
    double count;
  };
  void request_round(const PlannedRound& round);
  void trace_requests();
  void plan_paths(Stratum& stratum, std::uint64_t key, std::size_t first);
  void plan_twins(std::size_t first);
  void add_block(std::size_t first, std::size_t last, std::span<const std::uint32_t> labels,
                 const float* values);

  std::vector<SourcePixel>& pixels_;
  const BorderModel& model_;
  const StrayValues& strays_;
  const LabelTable& table_;
  RayLedger& ledger_;
  const ControlVariates& controls_;
  KeptValues* kept_;
  std::uint64_t seed_;
  std::size_t stride_;
  // Requests are made as they are traced: those of all values planned together may not fit into memory.
  std::vector<PlannedRound> planned_rounds_;
  std::vector<Planned> planned_;
  std::vector<PathRequest> requests_;
  std::vector<float> rests_;  // of a block
};

}  // namespace ifov::sampling
