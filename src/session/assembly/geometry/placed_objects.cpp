#include "session/assembly/geometry/placed_objects.h"

#include <algorithm>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/scene_document.h"
#include "render/image_info.h"

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

std::string title_of(std::span<const io::ObjectDocument> objects, std::size_t object) {
  if (object >= objects.size()) return "an object";
  const io::ObjectDocument& one = objects[object];
  if (!one.name.empty()) return format("'{}' (line {})", one.name, one.position.line);
  return format("scene.objects[{}] (a {}, line {})", object, std::visit(KindOfShape{}, one.shape),
                one.position.line);
}

std::vector<render::ObjectInfo> object_classes(std::span<const io::ObjectDocument> objects,
                                               const PlacedObjects& placed, const geometry::World& world) {
  constexpr std::size_t kMost = 65533;  // and nothing, others, lamps
  std::vector<render::ObjectInfo> classes;
  for (std::size_t k = 0; k < std::min(placed.document_objects(), kMost); ++k)
    classes.push_back({objects[k].name.empty()
                           ? format("{} {}", std::visit(KindOfShape{}, objects[k].shape), k)
                           : objects[k].name,
                       placed.first(k)});
  if (placed.document_objects() > kMost) classes.push_back({"others", placed.first(kMost)});
  if (!classes.empty() && world.object_count() > placed.all()) classes.push_back({"lamps", placed.all()});
  return classes;
}

}  // namespace ifov::session
