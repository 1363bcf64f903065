#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

class Contrast;
class LabelTable;
class RayLedger;

/// First values of labels, so that their contrast to others is known: one of each, and several of those whose values differ
/// by their nature, with their spread: a single value in a penumbra tells of light or of shadow, and either may be what
/// lies beside it. Where several of one place agree, more are taken about it.
class LabelValues {
 public:
  LabelValues(RayLedger& ledger, LabelTable& table, Contrast& contrast, std::uint64_t seed)
      : ledger_(ledger), table_(table), contrast_(contrast), seed_(seed) {}

  /// Of `labels`, each where it was met, and of those that their values meet first.
  void take(std::span<const std::uint32_t> labels, std::span<const FocalPoint> points);

  static constexpr std::uint32_t kOfUneven = 8;  ///< values of a label that is uneven

 private:
  class Spread;
  /// What uneven labels of a material have shown.
  struct Agreement {
    std::uint32_t sought = 0, agreed = 0;
    bool differs = false;
    bool done() const;
  };
  struct Wanted {
    std::uint32_t label;
    FocalPoint point;
  };
  void take(const std::vector<Wanted>& wanted, std::vector<Wanted>& next);
  void ask(const std::vector<Wanted>& wanted, bool all, std::vector<Spread>& spread,
           std::vector<Wanted>& next);

  RayLedger& ledger_;
  LabelTable& table_;
  Contrast& contrast_;
  std::uint64_t seed_;
  std::map<std::uint32_t, Agreement> agreement_;  // by material
  std::vector<PathRequest> requests_;
  std::vector<std::size_t> owners_;  // of each request, in the list of those wanted
  std::vector<std::uint32_t> met_;
  std::vector<float> values_;
};

}  // namespace ifov::sampling
