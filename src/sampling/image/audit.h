#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sampling/image/survey.h"

namespace ifov::sampling {

class PixelSampler;

/// How wrong a sampler is, whatever it says of itself: some pixels of the image are sampled as they will be in it, and measured
/// again by two independent halves of many values. Half of these pixels are drawn evenly and half by the variance that is stated, so
/// that pixels which count are looked at.
///
/// With halves a and b of a pixel whose value is x, (x - a) (x - b) has the mean (x - L)^2, however noisy they are. Weighed by one
/// over each pixel's chance they give the mean squared error of the image over that which is stated. What a half-width has to
/// be, in stated standard deviations, is the quantile of |x - (a + b) / 2| among these pixels: split conformal prediction (Lei et al.
/// 2018), by class of pixel, less what the halves' own noise makes of it. Neither looks at how the sampler works.
class Audit final : public ImageSurvey {
 public:
  /// Pixels of one material alone, and others, are told apart: edges and interiors err in unlike ways.
  enum PixelClass : std::size_t { kPure, kMixed, kClasses };
  static constexpr double kPureShare = 0.99;
  /// A class of fewer audited pixels is told by all of them.
  static constexpr std::size_t kLeastOfClass = 40;
  /// Values of each half: in as many cells each way.
  static constexpr int kSide = 14;

  /// `pixels`: to be audited, on average. `inner`: what the sampler's own survey found; may be null. Throws Cancelled.
  static std::unique_ptr<const Audit> make(const PixelSampler& sampler,
                                           std::unique_ptr<const ImageSurvey> inner,
                                           const SurveyRequest& request, int pixels);

  const ImageSurvey* inner() const { return inner_.get(); }
  std::size_t pixels() const { return pixels_; }
  /// Mean squared error over the stated variance, by column; at least its own standard error.
  const std::vector<double>& ratios() const { return ratios_; }
  /// Of the stated standard deviation, by column.
  double multiplier(PixelClass of, std::size_t column) const { return multipliers_[of][column]; }
  /// What is added to every stated variance: where no sample told another from the rest, the precision of a float.
  double least_variance(std::size_t column) const { return least_variance_[column]; }

 private:
  Audit() = default;
  std::unique_ptr<const ImageSurvey> inner_;
  std::size_t pixels_ = 0;
  std::vector<double> ratios_, least_variance_;
  std::array<std::vector<double>, kClasses> multipliers_;
};

/// The class of each pixel of a tile.
std::vector<Audit::PixelClass> classes_of(const TileResult& tile);

}  // namespace ifov::sampling
