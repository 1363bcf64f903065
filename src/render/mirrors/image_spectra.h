#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/mirrors/focal_lights.h"

namespace ifov::render {

/// What is kept of an image in one pixel and one replicate: all of it has one radiance, which some of its points tell.
struct ImageSpectrum {
  std::vector<FocalLights::Light> told_by;  ///< at most kPaths points, with their areas
  std::vector<FocalLights::Light> lights;   ///< points that lie close together count as one at their centre
  static constexpr std::size_t kPaths = 16;
};

/// Of points at which an image was seen.
std::vector<ImageSpectrum> image_spectra(std::span<const FocalLights::Light> seen, std::uint64_t key);

}  // namespace ifov::render
