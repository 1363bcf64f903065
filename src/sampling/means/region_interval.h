#pragma once

#include <cstdint>

namespace ifov::sampling {

class BoundedError;
class PixelFootprint;

/// What is needed beside pixels' intervals to know that of a mean over pixels (docs/theory/accuracy_sampler.md, "Means
/// over regions").
struct RegionRule {
  /// Variance of a sum of pixels over the sum of their variances, at most: pixels share borders, and what a footprint
  /// sees of its neighbours.
  double shared = 1.0;
  /// The parts of each half-width that may be the same in all pixels: of what borders and of what paths make of it.
  double common_borders = 1.0, common_paths = 1.0;

  /// Of the accuracy sampler, for pixels that respond over `footprint_px` (response_area_px()).
  static RegionRule of_accuracy(double footprint_px);
  /// For errors that nothing is known of, such as those of points on a regular grid: they may be the same in all pixels.
  static RegionRule all_common() { return {1.0, 1.0, 1.0}; }
};

/// 1 over the integral of the squared response, in pixels, and at least 1: how many pixels share what one sees.
double response_area_px(const PixelFootprint& footprint);

/// The mean of one channel over a region and its interval, from those of the pixels.
class RegionSum {
 public:
  /// `half_width` is the pixel's without `bound`, which is the same in all pixels for sure (the air's own error), `border_share`
  /// the borders' share of its variance. A pixel without a finite value is left away.
  void add(double value, double half_width, double border_share, double bound = 0.0);

  std::uint64_t pixels() const { return pixels_; }
  double mean() const;
  /// At the confidence of the pixels' intervals; that of the pixel for one pixel, and never more than the mean of all. Not a
  /// number where a pixel has none. `joint` is of that confidence.
  double half_width(const RegionRule& rule, const BoundedError& joint) const;

 private:
  std::uint64_t pixels_ = 0;
  double values_ = 0.0, widths_ = 0.0, squares_ = 0.0, borders_ = 0.0, paths_ = 0.0, bounds_ = 0.0;
};

}  // namespace ifov::sampling
