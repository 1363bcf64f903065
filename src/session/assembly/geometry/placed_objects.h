#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ifov::io {
struct ObjectDocument;
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
  /// Index of the document's object; the number of them where there is none.
  std::size_t of(std::uint32_t placed) const;

 private:
  std::vector<std::uint32_t> first_;  ///< by object of the document, and the number of all at the end
};

/// "'tower' (line 23)", "scene.objects[0] (a plane, line 12)": for messages. `objects` are those of
/// the document's scene.
std::string title_of(std::span<const io::ObjectDocument> objects, std::size_t object);
std::string kind_of(const io::ObjectDocument& object);  ///< "plane", "list of instances"

}  // namespace ifov::session
