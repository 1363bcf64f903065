#pragma once

#include <cstdint>
#include <vector>

#include "studies/common/image_store.h"

namespace ifov::studies {

/// A material counts in a pixel from this share of its area.
inline constexpr double kCountedShare = 1e-3;

/// How many materials an image finds in its pixels.
struct MaterialCounts {
  double counted = 0.0;  ///< mean number a pixel, of materials that fill at least kCountedShare
  double raw = 0.0;      ///< of all that were found at all
};
MaterialCounts count_materials(const ImageStore& image);

/// Abundances of an image against those of a reference, over all materials that either finds in a pixel.
struct AbundanceErrors {
  double rms = 0.0;  ///< root of the mean over pixels of the sum of squared errors
  double largest = 0.0;
  double missed = 0.0;  ///< counted materials of the reference that the image does not find, a pixel
  /// Share of the materials in mixed pixels whose interval holds the reference's fraction give or take the
  /// reference's own uncertainty; NaN where the image states no intervals.
  double coverage = 0.0;
};
/// `reference_uncertainty`: half-width of the reference's fractions.
AbundanceErrors compare_abundances(const ImageStore& image, const ImageStore& reference,
                                   double reference_uncertainty);

}  // namespace ifov::studies
