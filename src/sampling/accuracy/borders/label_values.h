#pragma once

#include <cstdint>
#include <span>

#include "sampling/field.h"

namespace ifov::sampling {

class Contrast;
class LabelTable;
class RayLedger;

/// First values of labels, so that their contrast to others is known: one of each, and several of those whose values differ
/// by their nature, with their spread: a single value in a penumbra tells of light or of shadow, and either may be what
/// lies beside it.
class LabelValues {
 public:
  LabelValues(RayLedger& ledger, LabelTable& table, Contrast& contrast, std::uint64_t seed)
      : ledger_(ledger), table_(table), contrast_(contrast), seed_(seed) {}

  /// Of `labels`, each where it was met.
  void take(std::span<const std::uint32_t> labels, std::span<const FocalPoint> points);

  static constexpr std::uint32_t kOfUneven = 8;  ///< values of a label that is uneven

 private:
  RayLedger& ledger_;
  LabelTable& table_;
  Contrast& contrast_;
  std::uint64_t seed_;
};

}  // namespace ifov::sampling
