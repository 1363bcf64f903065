#pragma once

#include <optional>

#include "io/document/samplers/error_size.h"
#include "io/document/samplers/sampler_model.h"

namespace ifov::io {

/// One ray through the centre of each pixel.
struct SingleSampling final : SamplerSettings {
  static const SamplerModel kModel;

  std::unique_ptr<sampling::PixelSampler> build() const override;
  std::string description() const override;
  bool knows_errors() const override { return false; }
};

/// Rays through the centres of columns x rows equal cells of each pixel.
struct GridSampling final : SamplerSettings {
  static const SamplerModel kModel;

  GridSampling() = default;
  GridSampling(int across, int down) : columns(across), rows(down) {}

  int columns = 1, rows = 1;
  std::optional<int> audit;  ///< pixels that are measured once more

  std::unique_ptr<sampling::PixelSampler> build() const override;
  std::string description() const override;
  std::optional<int> audited_pixels() const override { return audit; }
};

/// Sub-elements that differ get more samples.
struct AdaptiveSampling final : SamplerSettings {
  static const SamplerModel kModel;

  int sub_columns = 1, sub_rows = 1;
  ErrorSize allowed_difference;         ///< radiance or fraction
  int max_samples = 100;                ///< per pixel
  std::optional<DocumentName> channel;  ///< that is compared; absent: all, the largest difference counts
  std::optional<int> audit;             ///< pixels that are measured once more
  SourcePosition position;

  std::unique_ptr<sampling::PixelSampler> build() const override;
  std::string description() const override;
  const DocumentName* channel_looked_at() const override { return channel ? &*channel : nullptr; }
  std::optional<int> audited_pixels() const override { return audit; }
};

}  // namespace ifov::io
