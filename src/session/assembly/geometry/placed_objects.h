#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ifov::geometry {
class World;
}
namespace ifov::io {
struct ObjectDocument;
}
namespace ifov::render {
struct ObjectInfo;
}

namespace ifov::session {

/// Which of the world's objects stand for which object of the document.
class PlacedObjects {
 public:
  /// The next object of the document begins with this number.
  void begin(std::uint32_t first) { first_.push_back(first); }
  void end(std::uint32_t count) { first_.push_back(count); }

  std::size_t document_objects() const { return first_.empty() ? 0 : first_.size() - 1; }
  std::uint32_t first(std::size_t object) const { return first_[object]; }
  std::uint32_t count(std::size_t object) const { return first_[object + 1] - first_[object]; }
  std::uint32_t all() const { return first_.empty() ? 0 : first_.back(); }  ///< that stand for any
  /// Index of the document's object; the number of them where there is none.
  std::size_t of(std::uint32_t placed) const;

 private:
  std::vector<std::uint32_t> first_;  ///< by object of the document, and the number of all at the end
};

/// "'tower' (line 23)", "scene.objects[0] (a plane, line 12)": for messages. `objects` are those of
/// the document's scene.
std::string title_of(std::span<const io::ObjectDocument> objects, std::size_t object);

/// Classes of what pixels see: the document's objects by their names, or as "plane 0" by kind and index, and "lamps" where the world holds
/// more than they. What does not fit into classes of 16 bits shares one, "others".
std::vector<render::ObjectInfo> object_classes(std::span<const io::ObjectDocument> objects,
                                               const PlacedObjects& placed, const geometry::World& world);

}  // namespace ifov::session
