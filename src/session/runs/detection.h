#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/envi/envi_header.h"
#include "io/products/part_file.h"
#include "radiometry/channel.h"

namespace ifov {
class CancelToken;
}
namespace ifov::io {
struct ChannelDocument;
struct DocumentSources;
class EnviReader;
}  // namespace ifov::io

namespace ifov::session {

/// Channels of a sensor, and the standard deviation of its noise in each, W m-2 sr-1 um-1.
struct NoisyChannels {
  std::vector<radiometry::Channel> channels;
  std::vector<double> noise;
};

/// InputError where no channel tells any noise above 0.
NoisyChannels noisy_channels(const io::DocumentSources& sources,
                             std::span<const io::ChannelDocument> written);

/// InputError where a cube's bands are not these channels: as many, centres within a thousandth. `told_by`: who tells the noise.
void require_same_channels(const io::EnviReader& radiance, const NoisyChannels& channels,
                           const std::string& told_by);

/// A cube of radiance with one realization of the noise, NAME.img and NAME.img.hdr, whole or not at all.
class NoisyCube {
 public:
  /// Keeps references to the reader and the channels.
  NoisyCube(const io::EnviReader& radiance, const NoisyChannels& channels, std::uint64_t seed,
            const std::filesystem::path& to);
  /// Removes what was not published.
  ~NoisyCube();
  NoisyCube(const NoisyCube&) = delete;
  NoisyCube& operator=(const NoisyCube&) = delete;

  void write(int threads, const CancelToken* cancel);
  /// Waits until all is on the disk, and gives it its name.
  void publish();

 private:
  const io::EnviReader& radiance_;
  const NoisyChannels& channels_;
  std::uint64_t seed_;
  io::EnviHeader header_;
  io::PartFile cube_, header_file_;
  bool published_ = false;
};

}  // namespace ifov::session
