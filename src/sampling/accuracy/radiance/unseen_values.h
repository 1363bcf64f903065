#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "sampling/accuracy/basis/label_table.h"

namespace ifov::sampling {

class Field;
class LabelSpread;
class Prober;
class StandoutValues;
struct SourcePixel;

/// What values have not met: the variance of their mean by values that differ from all of them, as those nearby show.
class UnseenValues {
 public:
  UnseenValues(const LabelSpread& spread, const Prober& prober, const StandoutValues& standouts,
               const LabelTable& table, const Field& field)
      : spread_(spread), prober_(prober), standouts_(standouts), table_(table), field_(field) {}

  virtual ~UnseenValues() = default;

  /// Variance of the mean of a stratum's values by what they have not met; of a cluttered pixel's where it is one.
  virtual double variance(const SourcePixel& pixel, std::size_t stratum, int column) const;

 protected:
  double mean_of(std::uint32_t label, int column) const { return table_.mean(label)[column]; }
  /// The square of how far from the mean of a cluttered pixel's values lies what rays, strays or standouts have met there, and none
  /// of its values; 0: nothing.
  virtual double known_farther(const SourcePixel& pixel, int column) const;

  /// The square of how far from `mean` a label's values may lie: its mean's distance, or, of an uneven label, that of any value of its
  /// material in the tile. A place in the penumbra of a wire sees most of the Sun, and few paths from it are in the dark, but these
  /// are as dark as any.
  virtual double farthest_of(std::uint32_t label, int column, double mean) const;

 private:
  /// Lowest and highest values of a material on the lattice, by column.
  struct Range {
    std::vector<double> low, high;
  };
  const Range& range_of(std::uint32_t material) const;
  bool knows_more_than_values(const SourcePixel& pixel) const;

  const LabelSpread& spread_;
  const Prober& prober_;
  const StandoutValues& standouts_;
  const LabelTable& table_;
  const Field& field_;
  mutable std::map<std::uint32_t, Range> ranges_;  // by material, once asked for
};

}  // namespace ifov::sampling
