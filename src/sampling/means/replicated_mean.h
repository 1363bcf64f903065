#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/hash.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/random.h"
#include "sampling/sequence.h"

namespace ifov::sampling {

/// A mean over the unit square with its interval.
struct ReplicatedMean {
  double mean = 0.0, standard_error = 0.0, half_width = 0.0;
  std::uint64_t samples = 0;  ///< all that were taken
};

/// Of a function(span of points, span of as many values from 0 to 1), by replicates of scrambled nets (Owen 1997): the spread of as many independent means of
/// nets is the error. Begins with few points and takes eight times as many, other ones, until the half-width is at most `limit` or
/// there would be more than `most`; the last means count alone, and the chance to be wrong is shared out over all looks. What nets
/// of so many points cannot resolve is in the half-width: a part of the square as large as three of their cells where all values are the
/// same, else one.
template <class Function>
ReplicatedMean replicated_mean(std::uint64_t key, double confidence, double limit, std::uint64_t most,
                               const Function& function) {
  constexpr int kReplicates = 16, kLooks = 4;
  constexpr std::uint64_t kFirst = 64, kFactor = 8;  // points of a replicate
  const double quantile = two_sided_student(1.0 - (1.0 - confidence) / kLooks, kReplicates - 1);
  ReplicatedMean result;
  std::uint64_t taken = 0, count = kFirst;
  for (int look = 0; look < kLooks; ++look, count *= kFactor) {
    std::vector<Point2> points(count);
    std::vector<double> values(count);
    std::array<double, kReplicates> means{};
    double low = 1.0, high = 0.0;
    for (int r = 0; r < kReplicates; ++r) {
      for (std::uint64_t k = 0; k < count; ++k)
        points[k] = sequence_point(hash(key, look, r), static_cast<std::uint32_t>(k), 0);
      function(points, values);
      double& mean = means[static_cast<std::size_t>(r)];
      for (const double value : values)
        mean += value, low = std::min(low, value), high = std::max(high, value);
      mean /= static_cast<double>(count);
    }
    double sum = 0.0, squares = 0.0;
    for (const double mean : means) sum += mean;
    result.mean = sum / kReplicates;
    for (const double mean : means) squares += (mean - result.mean) * (mean - result.mean);
    result.standard_error = std::sqrt(squares / (kReplicates * (kReplicates - 1.0)));
    const double cell = 1.0 / static_cast<double>(kReplicates * count);
    result.half_width = quantile * result.standard_error + (low == high ? 3.0 : 1.0) * cell;
    taken += kReplicates * count;
    result.samples = taken;
    if (result.half_width <= limit || kReplicates * count * kFactor > most) break;
  }
  return result;
}

}  // namespace ifov::sampling
