#pragma once

#include <cstdint>
#include <memory>

namespace ifov::geometry {
class Motion;
class World;
}  // namespace ifov::geometry
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

/// What moves of a scene, collected; afterwards a world with all of it.
class MovingObjects {
 public:
  MovingObjects();
  ~MovingObjects();
  /// A body about what carries it, placed after so many objects that stand still.
  void add(std::unique_ptr<geometry::World> body, std::shared_ptr<const geometry::Motion> motion,
           std::uint32_t after);
  std::uint32_t count() const { return count_; }  ///< of objects
  /// Itself where nothing moves.
  std::unique_ptr<geometry::World> about(std::unique_ptr<geometry::World> still, const GeometrySubject& of);

 private:
  struct Content;
  std::unique_ptr<Content> content_;
  std::uint32_t count_ = 0;
};

/// Throws InputError with the place of the object's `motion`.
[[noreturn]] void refuse_motion(const GeometrySubject& of, const io::ObjectDocument& object, const char* why);

}  // namespace ifov::session
