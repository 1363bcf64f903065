#pragma once

#include <string>
#include <vector>

#include "io/products/bil_cube.h"
#include "io/products/run_record.h"

namespace ifov::io {

/// SHA-256 of a file that is still being made.
std::string checksum(const PartFile& file, std::uint64_t bytes);

/// Figures of each channel, summed line after line, so that they do not depend on the order of the tiles.
/// `half_width` may be null: its figures are then not a number.
std::vector<ChannelStatistics> channel_statistics(const RasterView& radiance, const RasterView* half_width);

}  // namespace ifov::io
