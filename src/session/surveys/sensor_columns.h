#pragma once

#include <vector>

namespace ifov {
struct SensorDescription;
}
namespace ifov::io {
struct DocumentSources;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::radiometry {
struct Channel;
}

namespace ifov::session {

/// What differs from column to column of the detector, and from element to element. `told` has its channels.
void tell_columns(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                  const std::vector<radiometry::Channel>& channels, SensorDescription& told);

}  // namespace ifov::session
