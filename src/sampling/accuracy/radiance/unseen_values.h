#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace ifov::sampling {

class Field;
class LabelSpread;
class LabelTable;
class Prober;
class StandoutValues;
struct SourcePixel;
struct Stratum;

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
  double mean_of(std::uint32_t label, int column) const;
  /// The square of how far rare values of the stratum's label (of a cluttered pixel's materials) lie from the others in the pixels around, beyond what `count` of its own
  /// would show if they differed by nothing else.
  virtual double rare_beside(const SourcePixel& pixel, const Stratum& stratum, int column,
                             double count) const;
  /// The square of how far from the mean of a cluttered pixel's values lies what rays, strays or standouts have met there, and none
  /// of its values; 0: nothing.
  virtual double known_farther(const SourcePixel& pixel, int column) const;

  /// The square of how far from `mean` a label's values may lie: its mean's distance, or, of an uneven label, that of the rarer of
  /// two values that would make its mean and variance, of the darkest value of its material on its object in the tile, and of the
  /// brightest mean of a label there. A place in the penumbra of a wire sees most of the Sun, and few paths from it are in the
  /// dark, but these are as dark as any. (The brightest value there may be a mirror's light, which is elsewhere.)
  virtual double farthest_of(std::uint32_t label, int column, double mean) const;

 private:
  /// Of a label's material on its object, on the lattice: the lowest value and the highest mean of a label, by column.
  struct Range {
    std::vector<double> low, high;
  };
  const Range& range_of(std::uint32_t label) const;
  bool knows_more_than_values(const SourcePixel& pixel) const;

  const LabelSpread& spread_;
  const Prober& prober_;
  const StandoutValues& standouts_;
  const LabelTable& table_;
  const Field& field_;
  mutable std::map<std::pair<std::uint32_t, std::uint32_t>, Range>
      ranges_;  // by material and object, once asked for
};

}  // namespace ifov::sampling
