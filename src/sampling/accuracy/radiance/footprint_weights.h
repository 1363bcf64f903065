#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sampling/random.h"

namespace ifov::sampling {

class PixelFootprint;
struct KeptValues;
struct Stratum;
struct StratumMoments;

/// Of a stratum whose values weigh by a footprint, per asked column.
struct WeighedMoments {
  std::vector<double> mean;
  /// Variance of `mean` in units of StratumMoments::variance, were all paths drawn apart.
  double share = 1.0;
  double weighing = 0.0;  ///< values that weigh a tenth of the heaviest place's weight or more; at least 1
  std::vector<double> variance;  ///< of `mean`, as the replicates of the paths' sequences differ
  double freedom = 0.0;          ///< degrees of freedom behind `variance`; 0: values are too few for it
};

/// Moments of a stratum's kept values as the footprint about `centre` weighs them, in the asked columns at the positions `own`;
/// leaves the mean as it is where they weigh nothing. `moments`: of the values that weigh alike.
void weigh_by_footprint(const Stratum& stratum, const KeptValues& kept, const PixelFootprint& footprint,
                        Point2 centre, std::span<const int> columns, std::span<const std::size_t> own,
                        const StratumMoments& moments, WeighedMoments& out);

}  // namespace ifov::sampling
