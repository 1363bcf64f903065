#pragma once

#include <cstddef>
#include <cstdint>

namespace ifov::sampling {

class Field;
class LabelSpread;
class LabelTable;
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
  /// The square of how far from the mean of a cluttered pixel's values lies what rays, strays or standouts have met there, and none
  /// of its values; 0: nothing.
  virtual double known_farther(const SourcePixel& pixel, int column) const;

 private:
  double farthest_of(std::uint32_t label, int column, double mean) const;
  bool knows_more_than_values(const SourcePixel& pixel) const;

  const LabelSpread& spread_;
  const Prober& prober_;
  const StandoutValues& standouts_;
  const LabelTable& table_;
  const Field& field_;
};

}  // namespace ifov::sampling
