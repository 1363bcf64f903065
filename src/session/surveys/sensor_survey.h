#pragma once

namespace ifov {
struct SensorDescription;
}
namespace ifov::io {
struct DocumentSources;
struct OriginDocument;
struct SensorDocument;
}  // namespace ifov::io

namespace ifov::session {

/// What follows of a sensor without a scene.
SensorDescription survey_sensor(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                                const io::OriginDocument& origin);

}  // namespace ifov::session
