#include "session/assembly/geometry/placed_objects.h"

#include <algorithm>

#include "core/format.h"
#include "io/document/scene_document.h"

namespace ifov::session {
namespace {

struct KindOfShape {
  std::string operator()(const io::PrimitiveShape& primitive) const { return primitive.model; }
  std::string operator()(const io::MeshShape&) const { return "mesh"; }
  std::string operator()(const io::CityShape&) const { return "city"; }
  std::string operator()(const io::TerrainShape&) const { return "terrain"; }
  std::string operator()(const io::InstanceShape&) const { return "instance"; }
  std::string operator()(const io::InstancesShape&) const { return "list of instances"; }
  std::string operator()(const io::RandomPlacement&) const { return "random placement"; }
};

}  // namespace

std::size_t PlacedObjects::of(std::uint32_t placed) const {
  if (first_.empty() || placed >= first_.back()) return document_objects();
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), placed) - first_.begin()) -
         1;
}

std::string kind_of(const io::ObjectDocument& object) { return std::visit(KindOfShape{}, object.shape); }

std::string title_of(std::span<const io::ObjectDocument> objects, std::size_t object) {
  if (object >= objects.size()) return "an object";
  const io::ObjectDocument& one = objects[object];
  if (!one.name.empty()) return format("'{}' (line {})", one.name, one.position.line);
  return format("scene.objects[{}] (a {}, line {})", object, kind_of(one), one.position.line);
}

}  // namespace ifov::session
