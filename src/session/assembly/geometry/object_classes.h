#pragma once

#include <span>

namespace ifov::geometry {
class World;
}
namespace ifov::io {
struct ObjectDocument;
}
namespace ifov::render {
struct ImageInfo;
}

namespace ifov::session {

class PlacedObjects;

/// Classes of what pixels see: the document's objects by their names, or as "plane 0" by kind and index, and "lamps" where the world holds
/// more than they. What does not fit into classes of 16 bits shares one, "others".
void tell_objects(std::span<const io::ObjectDocument> objects, const PlacedObjects& placed,
                  const geometry::World& world, render::ImageInfo& image);

}  // namespace ifov::session
