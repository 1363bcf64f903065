#pragma once

#include <span>
#include <vector>

#include "radiometry/channel.h"

namespace ifov::io {
struct DocumentSources;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::render {
struct ChannelInfo;
}

namespace ifov::session {

/// Standard deviation of the sensor's noise in every channel, W m-2 sr-1 um-1: that of the document at the centre of the channel,
/// a temperature difference of a black surface of 300 K, a share of a radiance, or what follows from its detector at the detector's
/// reference; 0 of a channel that tells none.
std::vector<double> assemble_noise(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                                   const std::vector<radiometry::Channel>& channels);

/// Tells it, and the detector that it is of, of the channels.
void tell_noise(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                const std::vector<radiometry::Channel>& channels, std::span<render::ChannelInfo> of);

}  // namespace ifov::session
