#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ifov::cli {

/// Mean radiance of each channel over each region of a run's products and its half-width at the run's confidence, and
/// how many pixels are not converged and why. `path` is a folder with one run record, or the record. InputError on what is
/// neither and on regions that are none (region_means), SystemError on files that cannot be read.
std::string describe_regions(const std::filesystem::path& path, const std::vector<std::string>& regions);

}  // namespace ifov::cli
