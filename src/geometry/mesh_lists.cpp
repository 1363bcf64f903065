#include "geometry/mesh_lists.h"

#include <utility>

namespace ifov::geometry {

MeshLists lists_of(const TriangleMesh& mesh) {
  MeshLists lists;
  lists.vertices_m = mesh.vertices_m, lists.triangles = mesh.triangles, lists.slots = mesh.slots;
  lists.normals = mesh.normals, lists.normal_corners = mesh.normal_corners;
  lists.uvs = mesh.uvs, lists.uv_corners = mesh.uv_corners;
  lists.slot_names = mesh.slot_names;
  return lists;
}

MeshLists keep_mesh(TriangleMesh mesh, std::vector<std::uint32_t> patches) {
  struct Kept {
    TriangleMesh mesh;
    std::vector<std::uint32_t> patches;
  };
  const auto kept = std::make_shared<const Kept>(Kept{std::move(mesh), std::move(patches)});
  MeshLists lists = lists_of(kept->mesh);
  lists.patches = kept->patches;
  lists.keeper = kept;
  return lists;
}

}  // namespace ifov::geometry
