#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/image_info.h"
#include "sensor/detector/read_out.h"

namespace ifov {
class CancelToken;
enum class DetectedQuantity;
}  // namespace ifov
namespace ifov::io {
class EnviReader;
struct DocumentSources;
struct SensorDocument;
}  // namespace ifov::io

namespace ifov::session {

class LineCube;

inline constexpr const char* kNoNoise =
    "no channel tells the sensor's noise: give the sensor a 'detector', or channels 'noise' (NEdL), 'noise_temperature' (NEdT) or "
    "'snr'";

/// Channels with the noise that they tell. InputError where none tells any.
std::vector<render::ChannelInfo> noisy_channels(const io::DocumentSources& sources,
                                                const io::SensorDocument& sensor);

/// Of their responses, in an image so many columns wide, for kelvins: added to `image`, which has the channels.
void tell_brightness(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                     render::ImageInfo& image);

/// A cube that one realization is told in.
struct DetectedCube {
  DetectedQuantity quantity;
  std::filesystem::path path;
};

/// InputError, naming a channel, where one does not make the quantity. `document` is whose channels they are.
void require_quantity(DetectedQuantity quantity, std::span<const render::ChannelInfo> channels,
                      const std::string& document);

struct Realization {
  std::vector<std::unique_ptr<LineCube>> cubes;  ///< there once they are published
  std::vector<std::uint64_t> saturated;          ///< pixels, by channel
};

/// What a detector was exposed to.
struct SignalSource {
  const io::EnviReader* radiance;
  std::vector<const io::EnviReader*> before;  ///< frames before, the last one first; none: they were alike
  sensor::ReadOut read_out;
};

/// Of 1/f noise that is held: more channels are drawn after each other.
inline constexpr double kMostDriftBytes = 256e6;

/// One realization of what the channels of an image make of its cube of radiance, in as many cubes as are asked for.
Realization realize(const SignalSource& source, const render::ImageInfo& image, std::uint64_t seed,
                    std::span<const DetectedCube> cubes, int threads, const CancelToken* cancel,
                    double most_drift_bytes = kMostDriftBytes);

}  // namespace ifov::session
