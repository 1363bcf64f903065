#pragma once

#include <memory>
#include <vector>

#include "io/document/document_error.h"
#include "radiometry/channel.h"

namespace ifov::io {
struct SensorDocument;
}
namespace ifov::sensor {
class ColumnResponses;
struct Mosaic;
}  // namespace ifov::sensor

namespace ifov::session {

/// Responses that differ from column to column of an image; null where none do.
std::shared_ptr<const sensor::ColumnResponses> assemble_smile(
    const io::DocumentSources& sources, const io::SensorDocument& sensor,
    const std::vector<radiometry::Channel>& channels, int width_px);

/// How far to the right what elements see lies, by channel and column of an image, px; of a channel empty where that is nowhere, and
/// of all where none has any.
std::vector<std::vector<double>> assemble_keystone(const io::DocumentSources& sources,
                                                   const io::SensorDocument& sensor,
                                                   const std::vector<radiometry::Channel>& channels,
                                                   int width_px);

/// What the elements see; null: all channels. Names are those of channels.
std::shared_ptr<const sensor::Mosaic> assemble_mosaic(const io::SensorDocument& sensor);

/// The sensor with a channel for each response that paths carry, in place of those of its document.
io::SensorDocument sensor_as_carried(const io::SensorDocument& sensor,
                                     const sensor::ColumnResponses* responses);

}  // namespace ifov::session
