#pragma once

#include <cstddef>
#include <functional>
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
struct Detector;
}

namespace ifov::session {

/// How the values of a quantity stand in a cube, and what its header says of them: `header` is that of the radiance.
io::EnviHeader detected_header(io::EnviHeader header, DetectedQuantity quantity,
                               std::span<const render::ChannelInfo> channels, const std::string& radiance,
                               std::uint64_t seed);

/// What a radiance is told as, in a column of the image.
using RadianceAs = std::function<double(std::size_t column, double radiance)>;

/// Appends signals of a line, in electrons, as the quantity of a cube of such a type; radiance for the shares `light` of it that fell on
/// their elements (empty: all).
void append_detected(const sensor::Detector& detector, DetectedQuantity quantity, io::EnviType type,
                     std::span<const double> signal, std::span<const double> light, const RadianceAs& as,
                     std::vector<std::byte>& values);
/// Appends a line of radiance.
void append_values(std::span<const float> radiance, const RadianceAs& as, std::vector<std::byte>& values);

}  // namespace ifov::session
