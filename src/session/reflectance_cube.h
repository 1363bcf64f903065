#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ifov {
class CancelToken;
}
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

struct RetrievalInput {
  const render::ImageInfo& image;               ///< of the document
  std::string document;                         ///< its name
  const io::EnviReader& cube;                   ///< of radiance
  const io::EnviReader* half_widths = nullptr;  ///< of the cube; null: none are known
};

/// From a cube into two ENVI files. Intervals hold what the radiance's do and, where those hold nothing of it, the air's.
/// InputError, with the file's name, where the cube's bands are not the image's channels or not radiance, and where no channel sees
/// reflected sunlight. The same bytes for any number of threads (0: all cores).
RetrievalCounts retrieve(const RetrievalInput& from, const atmosphere::SensorAtmosphere& air,
                         const std::string& reflectance_path, const std::string& half_width_path, int threads,
                         const CancelToken* cancel);

}  // namespace ifov::session
