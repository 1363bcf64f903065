#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "sampling/image/spread_places.h"

namespace ifov::sampling {

/// Pixels of a block of the image, and how much each of them tells of another: by what they show and how far apart they are. Pixels
/// of other blocks tell nothing, so that a pixel's value depends on its block alone, whatever tile it is in.
class LikePixels {
 public:
  /// Blocks are squares of so many pixels, the first at the image's corner.
  static constexpr int kSide = 8;

  /// `shares`: of materials, by pixel.
  LikePixels(std::span<const Place> places, std::span<const std::map<std::uint32_t, double>> shares);
  std::size_t size() const { return size_; }

  /// One number a pixel: a weighted mean over the others. `otherwise` by pixel counts as one more that is just like it.
  std::vector<double> smoothed(std::span<const double> values, std::span<const double> otherwise) const;

  /// Means that vary little among like pixels, shrunk to what the others and a prediction say (Fay and Herriot 1979), column by column:
  /// `means` and their `variances` by pixel and column in rows of `stride`, both of which are replaced; the latter by the mean
  /// squared error that the former then have.
  struct Shrinkage {
    std::size_t columns = 0, stride = 0;
    std::span<const float> predicted;  ///< by pixel and column
    std::span<const double> between;   ///< by column: how much like pixels differ, as far as is known before
    double trust = 1.0;  ///< times the variance between like pixels that is found; below 1 too much is pooled
    std::span<const std::size_t> leaders =
        {};  ///< Field::leader() by column, whose shares are taken; empty: of itself
  };
  void shrink(const Shrinkage& how, std::span<float> means, std::span<float> variances) const;

 private:
  std::size_t size_;
  std::vector<float> likeness_;  // of what two pixels show
  std::vector<float> weight_;    // of one pixel for another, 0 for itself
};

}  // namespace ifov::sampling
