#pragma once

#include <memory>

namespace ifov::geodesy {
struct UtcTime;
}
namespace ifov::geometry {
struct Presence;
}
namespace ifov::io {
struct ObjectDocument;
}

namespace ifov::session {

/// When an object is there, after the document's time; null: always.
std::shared_ptr<const geometry::Presence> assemble_presence(const io::ObjectDocument& object,
                                                            const geodesy::UtcTime& time);

}  // namespace ifov::session
