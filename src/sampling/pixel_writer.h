#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "sampling/tile.h"

namespace ifov::sampling {

/// What a classical sampler found out about one pixel, before it is turned into intervals.
struct PixelEstimate {
  std::vector<double> mean, variance_geometry, variance_path;  ///< per column; NaN where nothing is known
  struct Share {
    double fraction = 0.0, variance = 0.0;
  };
  std::map<std::uint32_t, Share> materials;
  double quantile = 0.0;  ///< half-widths in standard errors, at the problem's confidence
  bool spent = false;     ///< all samples that the pixel may take are
};

/// Confidence of the problem's tolerance, 0.95 without one.
double confidence_of(const TileProblem& problem);

/// Writes one pixel (row-major in the tile): half-widths, the verdict against the tolerance, abundances, and
/// the compact feature that would have been found with probability 0.95: a point misses one of area a with
/// probability 1 - a, n of them with at most (1 - a)^n. Pixels must come in order, their sample counts
/// already set.
void write_pixel(const PixelEstimate& estimate, const TileProblem& problem, std::size_t pixel,
                 TileResult& result);

}  // namespace ifov::sampling
