#include "session/assembly/geometry/object_classes.h"

#include <algorithm>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/scene_document.h"
#include "render/image_info.h"
#include "session/assembly/geometry/placed_objects.h"

namespace ifov::session {

void tell_objects(std::span<const io::ObjectDocument> objects, const PlacedObjects& placed,
                  const geometry::World& world, render::ImageInfo& image) {
  constexpr std::size_t kMost = 65533;  // and nothing, others, lamps
  const std::size_t count = placed.document_objects();
  const auto add = [&](std::string name, std::uint32_t first) {
    image.objects.push_back(std::move(name));
    image.first_of_objects.push_back(first);
  };
  for (std::size_t k = 0; k < std::min(count, kMost); ++k)
    add(objects[k].name.empty() ? format("{} {}", kind_of(objects[k]), k) : objects[k].name, placed.first(k));
  if (count > kMost) add("others", placed.first(kMost));
  if (count > 0 && world.object_count() > placed.first(count)) add("lamps", placed.first(count));
}

}  // namespace ifov::session
