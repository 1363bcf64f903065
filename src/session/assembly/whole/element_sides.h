#pragma once

namespace ifov::io {
struct DocumentSources;
struct SensorDocument;
}  // namespace ifov::io

namespace ifov::session {

/// The sensor with the fill factor that a table of its elements tells, if one does. InputError, located; SystemError.
io::SensorDocument with_element_sides(const io::DocumentSources& sources, const io::SensorDocument& sensor);

}  // namespace ifov::session
