#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ifov::atmosphere {
class SensorAtmosphere;
}
namespace ifov::io {
class EnviReader;
}
namespace ifov::render {
struct ImageInfo;
}

namespace ifov::session {

/// What became of a cube's values; channels are counted by index.
struct RetrievalCounts {
  std::uint64_t values = 0, negative = 0, missing = 0;  ///< missing: the cube holds no value there
  std::vector<std::uint64_t> negative_by_channel;
  std::vector<std::size_t> left_out;  ///< channels that see no reflected sunlight: not a number
};

/// Line by line from `cube` (radiance), with half-widths from `half_widths` (null: none are known of the cube), into two ENVI
/// files. `image` is that of the document with this name, `air` its atmosphere. Intervals hold what the radiance's do and,
/// where those hold nothing of it, the air's. InputError, with the file's name, where the cube's bands are not the image's
/// channels or not radiance, and where no channel sees reflected sunlight.
RetrievalCounts retrieve(const render::ImageInfo& image, const std::string& document,
                         const atmosphere::SensorAtmosphere& air, const io::EnviReader& cube,
                         const io::EnviReader* half_widths, const std::string& reflectance_path,
                         const std::string& half_width_path);

}  // namespace ifov::session
