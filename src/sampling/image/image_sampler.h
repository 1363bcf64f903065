#pragma once

#include <cstdint>

#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// Values where they lower the error of the image most: the root mean square over its pixels, by column, is what is asked for. Each
/// pixel draws a pilot, its plan follows from that and from what was found of the whole image before (ImagePlan), and the rest is
/// drawn once: no looks, no stopping. Light that comes straight is sampled at more points than what comes by way of others.
/// docs/theory/image_sampling.md derives it.
class ImageSampler final : public PixelSampler {
 public:
  explicit ImageSampler(std::uint32_t most_samples) : most_samples_(most_samples) {}

  /// Errors: std::invalid_argument without a footprint or a survey; Cancelled.
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override { return 0; }
  bool takes_many_values() const override { return true; }
  /// Errors: std::invalid_argument without a tolerance or a footprint; Cancelled.
  std::unique_ptr<const ImageSurvey> survey(const SurveyRequest& request) const override;

 private:
  std::uint32_t most_samples_;  ///< in a pixel beside its pilot
};

}  // namespace ifov::sampling
