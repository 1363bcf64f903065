#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/products/image_region.h"
#include "render/tolerance/atmosphere_half_width.h"
#include "sampling/means/region_interval.h"
#include "sampling/reason_words.h"

namespace ifov::io {

/// Means of a run's products over a region.
struct RegionMeans {
  std::uint64_t pixels = 0, converged = 0;
  sampling::ReasonCounts reasons{};  ///< of those that are not converged
  struct Channel {
    std::uint64_t pixels = 0;             ///< that hold a value
    double mean = 0.0, half_width = 0.0;  ///< not a number where nothing is known
  };
  std::vector<Channel> channels;
};

/// From the cubes <stem>_radiance.img and so on. Errors as of EnviReader.
/// `joint` is of the confidence of the run's intervals; `air` by channel, where the atmosphere knew its error; may be empty.
RegionMeans region_means(const std::filesystem::path& stem, const ImageRegion& region,
                         const sampling::RegionRule& rule, const sampling::BoundedError& joint,
                         const std::vector<std::optional<render::AtmosphereHalfWidth>>& air = {});

}  // namespace ifov::io
