#pragma once

#include <memory>

#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// Another sampler, whose errors are measured (Audit): half-widths hold the true value as often as they should by what was found, and
/// the error of the image is told.
class AuditedSampler final : public PixelSampler {
 public:
  /// Errors: std::invalid_argument where fewer than 20 pixels are to be audited.
  AuditedSampler(std::unique_ptr<PixelSampler> sampler, int pixels);
  void sample(const TileProblem& problem, Field& field, TileResult& result) const override;
  int halo_px() const override { return sampler_->halo_px(); }
  int block_px() const override { return sampler_->block_px(); }
  /// Pixels are measured with what is known of them, whether or not the sampler asks for it.
  bool asks_for_bright_places() const override { return true; }
  std::unique_ptr<const ImageSurvey> survey(const SurveyRequest& request) const override;

 private:
  std::unique_ptr<PixelSampler> sampler_;
  int pixels_;
};

}  // namespace ifov::sampling
