#pragma once

#include <cstdint>

#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// Values where they lower the error of the image most: the root mean square over its pixels, by column, is what is asked for. Each
/// pixel draws a pilot, its plan follows from that and from what was found of the whole image before (ImagePlan), and the rest is
/// drawn once: no looks, no stopping. Light that comes straight is sampled at more points than what comes by way of others.
/// What comes by other ways is put together with that of like neighbours, within blocks of 8 x 8 pixels. docs/theory/image_sampling.md
/// derives it.
class ImageSampler final : public PixelSampler {
 public:
  struct Pooling {
    bool on = false;
    double trust = 1.0;  ///< as of LikePixels::Shrinkage: 1 but where a fault is planted
  };
  explicit ImageSampler(std::uint32_t most_samples, Pooling pooling)
      : most_samples_(most_samples), pooling_(pooling) {}
  explicit ImageSampler(std::uint32_t most_samples) : ImageSampler(most_samples, Pooling()) {}

  /// Errors: std::invalid_argument without a footprint or a survey; Cancelled.
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override { return pooling_.on ? 7 : 0; }
  int block_px() const override;
  bool takes_many_values() const override { return true; }
  bool asks_for_bright_places() const override { return true; }
  /// Errors: std::invalid_argument without a tolerance or a footprint; Cancelled.
  std::unique_ptr<const ImageSurvey> survey(const SurveyRequest& request) const override;

 private:
  std::uint32_t most_samples_;  ///< in a pixel beside its pilot
  Pooling pooling_;
};

}  // namespace ifov::sampling
