#pragma once

#include <filesystem>
#include <string>

namespace ifov::benchmarks {

/// Renders the forest (1024 x 1024 pixels, one ray through the centre of each, direct Sun and shadow) with
/// 210 and 1 bands and 2 and 1 threads, alternately, and returns as JSON the median times in seconds and the
/// largest relative error of some thousand pixels against radiances worked out one ray at a time from the
/// surface that it meets.
std::string time_single_rays(const std::filesystem::path& folder);

}  // namespace ifov::benchmarks
