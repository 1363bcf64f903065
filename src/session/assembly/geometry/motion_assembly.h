#pragma once

#include <memory>

namespace ifov::geometry {
class Motion;
}
namespace ifov::io {
struct ObjectDocument;
}
namespace ifov::math {
struct Vec3;
}

namespace ifov::session {

struct GeometrySubject;

/// The path of an object that moves; `offset_m` as of MapFrame::document_offset_m. Throws InputError, with the place of the object's
/// `motion`, where the path does not cover the time for which the image is exposed, and by how much.
std::shared_ptr<const geometry::Motion> assemble_motion(const GeometrySubject& of,
                                                        const io::ObjectDocument& object,
                                                        math::Vec3 offset_m);

}  // namespace ifov::session
