#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "geometry/world/world_builder.h"
#include "io/document/scene_document.h"
#include "session/assembly/shared/map_frame.h"

namespace ifov::io {
struct DocumentSources;
class SceneCache;
}  // namespace ifov::io

namespace ifov::session {

/// A shape that the builder knows, in the frame of the object that asked for it.
struct BuiltShape {
  geometry::ShapeId id;
  math::Transform object_from_shape;
  std::vector<std::string> slot_names;
  /// It bounds a volume, or is a plane, which has a lower side; of meshes only told where that is asked for.
  bool has_inside = false;
  bool of_triangles = true;          ///< so that it may have holes
  bool may_have_coordinates = true;  ///< of textures; only meshes
  /// Of a mesh with the materials of its file: its path, and by slot the triangles without texture coordinates.
  std::string file{};
  std::vector<std::size_t> without_uv{};
};

/// Turns shapes of documents into shapes of a builder; the file of a mesh is read once.
class ShapeAssembly {
 public:
  /// `cache` and `log` may be null.
  ShapeAssembly(const io::DocumentSources& sources, const MapFrame& frame, geometry::WorldBuilder& builder,
                io::SceneCache* cache, LogSink* log, bool tells_insides)
      : sources_(sources),
        frame_(frame),
        builder_(builder),
        cache_(cache),
        log_(log),
        tells_insides_(tells_insides) {}

  enum class Use { object, part_of_prototype };
  /// Throws InputError for what is no shape: copies, scattered copies and cities.
  BuiltShape build(const io::ObjectDocument& object, Use use);

 private:
  BuiltShape shape(const io::PrimitiveShape& s);
  BuiltShape shape(const io::MeshShape& s);
  BuiltShape shape(const io::TerrainShape& s);
  BuiltShape shape(const io::CityShape&);
  BuiltShape shape(const io::InstanceShape&);
  BuiltShape shape(const io::InstancesShape&);
  BuiltShape shape(const io::RandomPlacement&);

  const io::DocumentSources& sources_;
  const MapFrame& frame_;
  geometry::WorldBuilder& builder_;
  io::SceneCache* cache_;
  LogSink* log_;
  bool tells_insides_;
  std::map<std::string, BuiltShape> meshes_;
  Use use_ = Use::object;        // of the shape that is being built
  bool with_materials_ = false;  // likewise: of the file
};

}  // namespace ifov::session
