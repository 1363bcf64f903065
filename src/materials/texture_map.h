#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/curve_matcher.h"
#include "materials/numbered_map.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// An image as z-scores, and what its histogram looks like.
struct ImageScores {
  std::vector<float> scores;  ///< (number - mean) / standard deviation; 0 in cells without a number
  double mean = 0.0, deviation = 0.0;
  double lowest = 0.0, highest = 0.0;
  std::size_t unknown = 0;  ///< cells without a number
  /// Shares of cells that pile up at the lowest and the highest number, where that looks like clipping: more than
  /// kClipped of them, and more than twice as many as at the neighbouring number; else 0.
  double clipped_low = 0.0, clipped_high = 0.0;
  static constexpr double kClipped = 0.005;
};

/// Throws InputError where all cells are alike or none has a number.
ImageScores score_image(std::span<const float> values, std::optional<double> nodata);

/// Mean of each curve in each spectral range: the features that CurveMatcher takes, [curve * ranges + range].
struct SpectralRange {
  double from_um = 0.0, to_um = 0.0;
};
std::vector<double> range_means(std::span<const radiometry::Spectrum> curves,
                                std::span<const SpectralRange> ranges);

/// Picks the curve of a material from images of it: one image for each spectral range, bright where the material
/// reflects more.
class TextureMap {
 public:
  class Image final : public NumberedMap {
   public:
    /// Throws InputError where the grid does not fit the scores.
    Image(MapGrid grid, std::vector<float> scores);
    float number(std::size_t cell) const override { return scores_[cell]; }

   private:
    std::vector<float> scores_;
  };
  /// As many images as the matcher has ranges. `seed` decides between
  /// curves that match equally well.
  TextureMap(std::vector<Image> images, CurveMatcher matcher, std::uint64_t seed);

  CurveMix at(const MapPosition& position) const;
  std::size_t curve_count() const { return matcher_.curve_count(); }
  const std::vector<Image>& images() const { return images_; }
  const CurveMatcher& matcher() const { return matcher_; }

 private:
  std::vector<Image> images_;
  CurveMatcher matcher_;
  std::uint64_t seed_;
};

}  // namespace ifov::materials
