#include "io/mesh/gltf_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/mesh/gltf_accessor.h"
#include "io/mesh/gltf_file.h"
#include "io/mesh/gltf_materials.h"
#include "io/mesh/mesh_materials.h"
#include "math/transform.h"

namespace ifov::io {
namespace {

constexpr std::string_view kGltfExtensions[] = {".gltf", ".glb"};

using geometry::kNoIndex;
using geometry::Triangle;
using math::Transform;
using math::Vec3;

class Reader {
 public:
  Reader(const std::filesystem::path& path, LogSink* log, MeshUse use)
      : name_(path.string()),
        log_(log),
        use_(use),
        model_(load_gltf(path, log, use == MeshUse::shape ? GltfImages::left_out : GltfImages::elsewhere)),
        slot_names_(gltf_slot_names(model_, use == MeshUse::with_materials)),
        visited_(model_.nodes.size(), false) {}

  geometry::TriangleMesh read() {
    check_extensions();
    std::size_t buffer_bytes = 0;
    for (const tinygltf::Buffer& buffer : model_.buffers) buffer_bytes += buffer.data.size();
    // What is there only once takes at least six bytes of a buffer per triangle.
    most_triangles_ = std::max(kMostUnfoldedTriangles, buffer_bytes / 6);
    // A list instead of recursion: chains of nodes may be as long as the file.
    std::vector<std::pair<int, Transform>> waiting;
    for (const int node : roots()) waiting.emplace_back(node, Transform());
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const auto [index, file_from_parent] = waiting.back();
      waiting.pop_back();
      const tinygltf::Node& node = visit(index);
      const Transform file_from_node = file_from_parent * transform_of(node, index);
      if (node.mesh >= 0) add_mesh(node.mesh, file_from_node);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        waiting.emplace_back(*child, file_from_node);
    }
    if (mesh_.triangles.empty()) fail("the scene has no triangles");
    if (!any_uv_) mesh_.uvs.clear(), mesh_.uv_corners.clear();
    if (!any_normal_) mesh_.normals.clear(), mesh_.normal_corners.clear();
    if (skipped_ > 0 && log_ != nullptr)
      log_->warn(format("{}: {} primitives of points or lines are left out", name_, skipped_));
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(format("{}: {}", name_, message), {name_, 0, 0});
  }

  void check_extensions() const {
    for (const std::string& extension : model_.extensionsRequired)
      if (extension != "KHR_mesh_quantization" && extension != "KHR_texture_transform" &&
          !extension.starts_with("KHR_materials_"))
        fail(format("it needs the extension '{}', which is not read", extension.substr(0, 100)));
  }

  std::vector<int> roots() const {
    if (model_.scenes.empty()) {
      std::vector<bool> child(model_.nodes.size(), false);
      for (const tinygltf::Node& node : model_.nodes)
        for (const int c : node.children)
          if (c >= 0 && static_cast<std::size_t>(c) < child.size()) child[static_cast<std::size_t>(c)] = true;
      std::vector<int> roots;
      for (std::size_t k = 0; k < child.size(); ++k)
        if (!child[k]) roots.push_back(static_cast<int>(k));
      return roots;
    }
    const int scene = std::max(model_.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= model_.scenes.size())
      fail(format("there is no scene {}: the file has {}", scene, model_.scenes.size()));
    return model_.scenes[static_cast<std::size_t>(scene)].nodes;
  }

  const tinygltf::Node& visit(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size())
      fail(format("there is no node {}: the file has {}", index, model_.nodes.size()));
    const auto at = static_cast<std::size_t>(index);
    if (visited_[at]) fail(format("node {} has more than one parent", index));
    visited_[at] = true;
    return model_.nodes[at];
  }

  Transform transform_of(const tinygltf::Node& node, int index) const {
    const auto numbers = [&](const std::vector<double>& list, std::size_t count, const char* what) {
      bool finite = list.size() == count;
      for (const double value : list) finite = finite && std::isfinite(value);
      if (!list.empty() && !finite)
        fail(format("node {}: its {} needs {} finite numbers", index, what, count));
      return !list.empty();
    };
    if (numbers(node.matrix, 16, "matrix")) {
      const std::vector<double>& m = node.matrix;
      return Transform::from_columns({m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]},
                                     {m[12], m[13], m[14]});
    }
    Transform transform;
    if (numbers(node.translation, 3, "translation"))
      transform = Transform::translation({node.translation[0], node.translation[1], node.translation[2]});
    if (numbers(node.rotation, 4, "rotation")) {
      const Vec3 axis{node.rotation[0], node.rotation[1], node.rotation[2]};
      const double sine = length(axis);
      if (sine > 0.0)
        transform = transform * Transform::rotation(axis, 2.0 * std::atan2(sine, node.rotation[3]));
    }
    if (numbers(node.scale, 3, "scale"))
      transform = transform * Transform::scaling({node.scale[0], node.scale[1], node.scale[2]});
    return transform;
  }

  void add_mesh(int index, const Transform& file_from_mesh) {
    if (static_cast<std::size_t>(index) >= model_.meshes.size())
      fail(format("there is no mesh {}: the file has {}", index, model_.meshes.size()));
    for (const tinygltf::Primitive& primitive : model_.meshes[static_cast<std::size_t>(index)].primitives)
      add_primitive(primitive, file_from_mesh);
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Transform& file_from_mesh) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      ++skipped_;
      return;
    }
    const auto attribute = [&](const char* name) {
      const auto found = primitive.attributes.find(name);
      return found == primitive.attributes.end() ? -1 : found->second;
    };
    if (attribute("POSITION") < 0) fail("a primitive has no POSITION");
    const GltfAccessor positions(model_, attribute("POSITION"), TINYGLTF_TYPE_VEC3, "POSITION", name_);
    const std::size_t count = positions.count();
    std::vector<std::uint32_t> corners = corners_of(primitive, mode, count);
    if (mesh_.triangles.size() + corners.size() / 3 > most_triangles_ ||
        mesh_.vertices_m.size() + count > 3 * most_triangles_)
      fail(format("the nodes unfold to more than {} triangles; place copies with 'instances' in the document",
                  most_triangles_));
    const auto first = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    for (std::size_t k = 0; k < count; ++k) {
      const math::Point3 p =
          file_from_mesh(math::Point3{positions.value(k, 0), positions.value(k, 1), positions.value(k, 2)});
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        fail(format("accessor {} (POSITION): vertex {} is not finite", attribute("POSITION"), k));
      mesh_.vertices_m.push_back(p);
    }
    GltfPlacement placement;
    if (use_ == MeshUse::with_materials) placement = gltf_placement(model_, primitive.material, name_);
    const std::string set = format("TEXCOORD_{}", placement.set);
    const std::uint32_t uv = add_uvs(attribute(set.c_str()), set.c_str(), placement, count);
    const std::uint32_t normal = add_normals(attribute("NORMAL"), count, file_from_mesh);
    const std::uint32_t slot = slot_of(primitive.material);
    const bool mirrored = file_from_mesh.determinant() < 0.0;
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
      if (mirrored) std::swap(corners[k + 1], corners[k + 2]);
      const auto from = [&](std::uint32_t begin) {
        return begin == kNoIndex
                   ? Triangle{kNoIndex, kNoIndex, kNoIndex}
                   : Triangle{begin + corners[k], begin + corners[k + 1], begin + corners[k + 2]};
      };
      mesh_.triangles.push_back(from(first));
      mesh_.uv_corners.push_back(from(uv));
      mesh_.normal_corners.push_back(from(normal));
      mesh_.slots.push_back(slot);
    }
  }

  /// Three corners per triangle, whatever the mode; indices from 0 within the primitive.
  std::vector<std::uint32_t> corners_of(const tinygltf::Primitive& primitive, int mode,
                                        std::size_t vertices) const {
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
      const GltfAccessor indices(model_, primitive.indices, TINYGLTF_TYPE_SCALAR, "indices", name_);
      order.reserve(indices.count());
      for (std::size_t k = 0; k < indices.count(); ++k) {
        const double index = indices.value(k, 0);
        if (!(index >= 0.0) || index != std::floor(index) || index >= static_cast<double>(vertices))
          fail(format("accessor {} (indices): entry {} names vertex {} of {}", primitive.indices, k, index,
                      vertices));
        order.push_back(static_cast<std::uint32_t>(index));
      }
    } else {
      for (std::size_t k = 0; k < vertices; ++k) order.push_back(static_cast<std::uint32_t>(k));
    }
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      if (order.size() % 3 != 0) fail(format("a primitive of triangles has {} corners", order.size()));
      return order;
    }
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 2; k < order.size(); ++k) {
      const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
      const std::size_t a = strip ? k - 2 : 0;
      Triangle t{order[a], order[k - 1], order[k]};
      if (strip && k % 2 == 1) std::swap(t[0], t[1]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) corners.insert(corners.end(), t.begin(), t.end());
    }
    return corners;
  }

  std::uint32_t add_uvs(int accessor, const char* set, const GltfPlacement& placement, std::size_t count) {
    if (accessor < 0) return kNoIndex;
    const GltfAccessor uvs = attribute_accessor(accessor, TINYGLTF_TYPE_VEC2, set, count);
    any_uv_ = true;
    const auto first = static_cast<std::uint32_t>(mesh_.uvs.size());
    for (std::size_t k = 0; k < count; ++k) {
      const std::array<double, 2> at = placement.of(uvs.value(k, 0), uvs.value(k, 1));
      const geometry::Uv uv{at[0], 1.0 - at[1]};
      if (!std::isfinite(uv.u) || !std::isfinite(uv.v))
        fail(format("accessor {} ({}): entry {} is not finite", accessor, set, k));
      mesh_.uvs.push_back(uv);
    }
    return first;
  }

  std::uint32_t add_normals(int accessor, std::size_t count, const Transform& file_from_mesh) {
    if (accessor < 0 || file_from_mesh.determinant() == 0.0) return kNoIndex;
    const GltfAccessor normals = attribute_accessor(accessor, TINYGLTF_TYPE_VEC3, "NORMAL", count);
    any_normal_ = true;
    const auto first = static_cast<std::uint32_t>(mesh_.normals.size());
    for (std::size_t k = 0; k < count; ++k)
      mesh_.normals.push_back(
          file_from_mesh(math::Normal3{normals.value(k, 0), normals.value(k, 1), normals.value(k, 2)}));
    return first;
  }

  GltfAccessor attribute_accessor(int index, int type, const char* what, std::size_t count) const {
    const GltfAccessor accessor(model_, index, type, what, name_);
    if (accessor.count() != count)
      fail(format("accessor {} ({}) has {} entries for {} vertices", index, what, accessor.count(), count));
    return accessor;
  }

  std::uint32_t slot_of(int material) {
    std::string name;
    if (material >= 0) {
      if (static_cast<std::size_t>(material) >= model_.materials.size())
        fail(format("there is no material {}: the file has {}", material, model_.materials.size()));
      name = slot_names_[static_cast<std::size_t>(material)];
    }
    const auto [entry, is_new] = slots_.try_emplace(name, static_cast<std::uint32_t>(slots_.size()));
    if (is_new) mesh_.slot_names.push_back(name);
    return entry->second;
  }

  std::string name_;
  LogSink* log_;
  MeshUse use_;
  tinygltf::Model model_;
  std::vector<std::string> slot_names_;
  std::vector<bool> visited_;
  geometry::TriangleMesh mesh_;
  std::map<std::string, std::uint32_t> slots_;
  bool any_uv_ = false, any_normal_ = false;
  std::size_t skipped_ = 0, most_triangles_ = 0;
};

}  // namespace

geometry::TriangleMesh read_gltf(const std::filesystem::path& path, LogSink* log, MeshUse use) {
  return Reader(path, log, use).read();
}

constinit const MeshFormat kGltf{.name = "glTF 2",
                                 .extensions = kGltfExtensions,
                                 .y_up = true,
                                 .read = read_gltf,
                                 .further_files = gltf_buffers,
                                 .read_materials = read_gltf_materials,
                                 .material_files = gltf_material_files};

}  // namespace ifov::io
