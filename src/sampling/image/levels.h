#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

class ColumnFootprints;

/// Values in two levels: what a point sends that was lit straight (direct), and the rest, which comes by what else a path meets.
/// Requests stand group by group (a pixel, say). Those of a group come in fours, of neighbouring strata: the first two side by
/// side, the others below them.
struct LevelRequests {
  std::span<const PathRequest> requests;
  std::span<const std::uint8_t> whole;    ///< by request, 0 where only its direct part is wanted
  std::span<const std::uint32_t> counts;  ///< by group, of its requests: a multiple of 4
  /// [request][group of columns]: what values count for in the columns that have their footprint (FootprintGroups::importance());
  /// empty: all alike. Means are then sums of these over those of their weights.
  std::span<const float> importance = {};
  const ColumnFootprints* footprints = nullptr;  ///< of the columns; not null with importance
};

/// By group and column, in rows of Field::stride() floats.
struct LevelSums {
  std::vector<float> direct,
      rest;  ///< means; of the rest over the requests that are wanted whole, 0 where there are none
  /// Of one value. Direct: about its stratum's mean, from (a - b - c + d) / 2 of each four, which no slope enters. The rest: about
  /// the group's mean; 0 where fewer than two are wanted whole.
  std::vector<float> direct_variance, rest_variance;
  std::vector<Label> labels;  ///< by request
  std::vector<float>
      label_weights;  ///< by request, 1 on average over a group, by the reference's footprint; empty: all 1
};

/// Adds values of one group up, in the precision of `Sum`. Rows are of any length.
template <class Sum>
class LevelAccumulatorIn {
 public:
  explicit LevelAccumulatorIn(std::size_t length);
  void clear();
  void add_direct(const float* row);
  void add_rest(const float* row);
  /// Rows of as many numbers. Variances as of LevelSums.
  void take(float* direct, float* direct_variance, float* rest, float* rest_variance) const;

 private:
  std::size_t length_;
  std::uint32_t direct_count_ = 0, rest_count_ = 0;
  std::vector<Sum> direct_, contrast_, contrast_squares_;
  std::vector<Sum> first_, rest_, rest_squares_;  // of differences from the first
};
extern template class LevelAccumulatorIn<float>;
extern template class LevelAccumulatorIn<double>;
using LevelAccumulator = LevelAccumulatorIn<float>;

}  // namespace ifov::sampling
