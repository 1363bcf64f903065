#include "session/assembly/geometry/placed_objects.h"

#include <algorithm>

#include "core/format.h"
#include "io/document/document.h"

namespace ifov::session {
namespace {

struct KindOfShape {
  const char* operator()(const io::PlaneShape&) const { return "plane"; }
  const char* operator()(const io::BoxShape&) const { return "box"; }
  const char* operator()(const io::SphereShape&) const { return "sphere"; }
  const char* operator()(const io::HemisphereShape&) const { return "hemisphere"; }
  const char* operator()(const io::CylinderShape&) const { return "cylinder"; }
  const char* operator()(const io::DiskShape&) const { return "disk"; }
  const char* operator()(const io::PolygonShape&) const { return "polygon"; }
  const char* operator()(const io::MeshShape&) const { return "mesh"; }
  const char* operator()(const io::CityShape&) const { return "city"; }
  const char* operator()(const io::TerrainShape&) const { return "terrain"; }
  const char* operator()(const io::InstanceShape&) const { return "instance"; }
  const char* operator()(const io::InstancesShape&) const { return "list of instances"; }
  const char* operator()(const io::ScatterShape&) const { return "scatter"; }
};

}  // namespace

std::size_t PlacedObjects::of(std::uint32_t placed) const {
  if (first_.empty() || placed >= first_.back()) return document_objects();
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), placed) - first_.begin()) -
         1;
}

std::string title_of(const io::Document& document, std::size_t object) {
  if (object >= document.scene.objects.size()) return "an object";
  const io::ObjectDocument& one = document.scene.objects[object];
  if (!one.name.empty()) return format("'{}' (line {})", one.name, one.position.line);
  return format("scene.objects[{}] (a {}, line {})", object, std::visit(KindOfShape{}, one.shape),
                one.position.line);
}

}  // namespace ifov::session
