#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "honesty/plain_reference.h"
#include "sampling/tile.h"

namespace ifov::benchmarks {

/// How the intervals of one channel of one scene compare with the truth, over pixels and seeds.
struct ChannelHonesty {
  std::int64_t count = 0;
  double coverage = 0.0;     ///< share of intervals that hold the reference, misses included
  double beyond_four = 0.0;  ///< share with |z| > 4
  /// Mean half-width over the RMS error (the reference's own variance removed).
  double half_width_to_rms = 0.0;
  double bias = 0.0;  ///< of the image mean, over its standard error
  double mean_half_width = 0.0;
  double rms_error = 0.0;
  double geometric_sigma = 0.0;          ///< root mean variance that the sampler states for where edges lie,
  double path_sigma = 0.0;               ///< and for paths
  double reference_to_half_width = 0.0;  ///< root mean square error of the reference over the mean half-width
  /// Intervals that miss by more than a feature below the detection size could.
  std::int64_t small_misses = 0;

  /// What the intervals must keep; empty where they do, else in words which they break.
  std::string fault() const;
};

/// Collects the results of one scene, seed by seed.
class IntervalStatistics {
 public:
  /// `pixels` are those of the tile that are judged; `reference` has their true means in the same order.
  IntervalStatistics(std::vector<PixelIndex> pixels, PlainMeans reference);

  void add(const sampling::TileResult& result);

  std::vector<ChannelHonesty> summary() const;

 private:
  struct Sums {
    std::int64_t count = 0, covered = 0, beyond_four = 0, small_misses = 0, zeros = 0;
    double half_width = 0.0, squared_error = 0.0, reference_variance = 0.0, geometry = 0.0, path = 0.0;
    std::vector<double> image_error;  ///< mean over the pixels, by seed
  };
  std::vector<PixelIndex> pixels_;
  PlainMeans reference_;
  std::vector<Sums> sums_;
};

}  // namespace ifov::benchmarks
