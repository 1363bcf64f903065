#pragma once

#include <span>
#include <vector>

#include "radiometry/channel.h"

namespace ifov::io {
struct ChannelDocument;
struct DocumentSources;
}  // namespace ifov::io

namespace ifov::session {

/// Standard deviation of the sensor's noise in every channel, W m-2 sr-1 um-1: that of the document at the centre of the channel,
/// or a temperature difference of a black surface of 300 K; 0 of a channel that tells none.
std::vector<double> assemble_noise(const io::DocumentSources& sources,
                                   std::span<const io::ChannelDocument> written,
                                   const std::vector<radiometry::Channel>& channels);

}  // namespace ifov::session
