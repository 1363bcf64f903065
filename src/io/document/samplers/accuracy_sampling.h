#pragma once

#include <cstdint>
#include <optional>

#include "io/document/samplers/error_size.h"
#include "io/document/samplers/sampler_model.h"

namespace ifov::io {

/// Samples until the half-width of every judged interval is within `error`.
struct AccuracySampling final : SamplerSettings {
  static const SamplerModel kModel;

  /// What the error is of: the half-width of each pixel's interval, or the root mean square over the image's pixels.
  enum class Of { pixel, image };
  bool of_image() const { return of == Of::image; }

  ErrorSize error{0.01, ErrorSize::Unit::fraction};
  Of of = Of::pixel;
  std::optional<int> audit;             ///< pixels that are measured once more; of images alone
  bool pooling = false;                 ///< of what comes indirectly, over like neighbours; of images alone
  std::optional<DocumentName> channel;  ///< that is judged; absent: all channels
  double confidence = 0.95;
  bool simultaneous = false;    ///< confidence for all channels of a pixel at once
  std::optional<int> lattice;   ///< detection lattice cells per pixel side; absent: the sampler's choice
  int probes = 9;               ///< probing rays a flagged pixel and round
  bool pilot_rays = true;       ///< one ray per known object smaller than a pixel
  double thinnest_px = 0.0125;  ///< thinnest feature that is tracked
  std::optional<std::int64_t>
      max_samples;  ///< per pixel; absent: kUsualSamples, of single views kSamplesOfView
  static constexpr std::int64_t kUsualSamples = 100000, kSamplesOfView = 100000000;
  double floor = 0.001;  ///< of a white Lambertian surface's radiance: no limit in percent is lower, and in K
                         ///< no pixel is taken to be colder than that radiance
  bool clutter = true;   ///< switch to nested stratified samples where edges are too many
  SourcePosition position;

  std::unique_ptr<sampling::PixelSampler> build() const override {
    return build(max_samples.value_or(kUsualSamples));
  }
  std::unique_ptr<sampling::PixelSampler> build_for_views() const override {
    return build(max_samples.value_or(kSamplesOfView));
  }
  std::string description() const override;
  const DocumentName* channel_looked_at() const override { return channel ? &*channel : nullptr; }
  std::optional<int> audited_pixels() const override { return audit; }

 private:
  std::unique_ptr<sampling::PixelSampler> build(std::int64_t most_samples) const;
};

}  // namespace ifov::io
