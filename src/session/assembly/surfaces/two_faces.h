#pragma once

namespace ifov::io {
struct MaterialDocument;
}

namespace ifov::session {

/// Whether a material is told, or known by the library, to be a thin sheet both faces of which are outdoors.
bool has_two_faces(const io::MaterialDocument& source);

}  // namespace ifov::session
