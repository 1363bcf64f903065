#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "render/image_info.h"

namespace ifov {
class CancelToken;
}
namespace ifov::io {
struct ChannelDocument;
struct DocumentSources;
class EnviReader;
}  // namespace ifov::io

namespace ifov::session {

class LineCube;

inline constexpr const char* kNoNoise =
    "no channel tells the sensor's noise: give channels 'noise' (NEdL) or 'noise_temperature' (NEdT)";

/// Channels with the noise that they tell. InputError where none tells any.
std::vector<render::ChannelInfo> noisy_channels(const io::DocumentSources& sources,
                                                std::span<const io::ChannelDocument> written);

/// A cube of radiance with one realization of the noise, which is there once it is published.
std::unique_ptr<LineCube> noisy_cube(const io::EnviReader& radiance,
                                     std::span<const render::ChannelInfo> channels, std::uint64_t seed,
                                     const std::filesystem::path& to, int threads, const CancelToken* cancel);

}  // namespace ifov::session
