#pragma once

#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// The user's settings of the paper's adaptive scheme.
struct AdaptiveOptions {
  int sub_elements_x = 3, sub_elements_y = 3;  ///< per pixel
  int max_samples = 100;             ///< per pixel; each sub-element may use floor(max / sub-elements)
  double allowed_difference = 0.02;  ///< between a new sample and the running average, and between
                                     ///< the averages of neighbours
  bool relative = true;        ///< allowed_difference is a share of the running average, else a radiance
  bool rotate_points = false;  ///< shift each sub-element's Halton points by its own random vector (modulo 1)
};

/// Sub-elements that vary, or that differ from any of their 8 neighbours (across pixel borders), are sampled
/// up to their cap with Halton points; the others keep their one sample: DIRSIG's scheme
/// (docs/theory/sampling.md). Judged in the problem's steering channels, in all columns without any.
/// Unrotated points are the same in every sub-element: they fall on the same side of an edge that runs along
/// the lattice all at once, and the intervals know nothing of that. Rotated points are independent from one
/// sub-element to the next, and so are their errors.
class AdaptiveSampler final : public PixelSampler {
 public:
  /// Errors: std::invalid_argument where a count is below 1 or max_samples below the number of sub-elements.
  explicit AdaptiveSampler(const AdaptiveOptions& options);
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override;

 private:
  AdaptiveOptions options_;
};

}  // namespace ifov::sampling
