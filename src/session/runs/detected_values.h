#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/envi/envi_header.h"

namespace ifov {
enum class DetectedQuantity;
}
namespace ifov::render {
struct ChannelInfo;
}
namespace ifov::sensor {
class BrightnessScale;
struct Detector;
}  // namespace ifov::sensor

namespace ifov::session {

/// How the values of a quantity stand in a cube, and what its header says of them: `header` is that of the radiance.
io::EnviHeader detected_header(io::EnviHeader header, DetectedQuantity quantity,
                               std::span<const render::ChannelInfo> channels, const std::string& radiance,
                               std::uint64_t seed);

/// What a radiance is told as: kelvins on a scale, or a multiple of it.
struct RadianceAs {
  const sensor::BrightnessScale* scale = nullptr;
  double factor = 1.0;
};

/// Appends signals, in electrons, as the quantity of a cube of such a type.
void append_detected(const sensor::Detector& detector, DetectedQuantity quantity, io::EnviType type,
                     std::span<const double> signal, const RadianceAs& as, std::vector<std::byte>& values);
/// Appends radiance.
void append_values(std::span<const float> radiance, const RadianceAs& as, std::vector<std::byte>& values);

}  // namespace ifov::session
