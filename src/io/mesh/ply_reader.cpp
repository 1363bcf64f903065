#include "io/mesh/ply_reader.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/mesh/mesh_materials.h"
#include "io/mesh/ply_header.h"
#include "io/mesh/ply_values.h"
#include "io/mesh/polygon_pieces.h"
#include "io/raster/picture.h"

namespace ifov::io {
namespace {

constexpr std::string_view kPlyExtensions[] = {".ply"};

using geometry::Triangle;

constexpr std::pair<std::string_view, std::string_view> kTextureNames[] = {
    {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

const PlyProperty* index_list(const PlyElement& element) {
  for (const char* name : {"vertex_indices", "vertex_index"})
    if (const PlyProperty* p = element.find(name); p != nullptr && p->count_type) return p;
  return nullptr;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : name_(path.string()),
        bytes_(read_input(path)),
        header_(read_ply_header(bytes_, name_)),
        values_(bytes_, header_, name_) {}

  geometry::TriangleMesh read() {
    bool vertices = false;
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
        vertices = true;
      } else if (element.name == "face" || element.name == "tristrips") {
        if (!vertices)
          throw InputError(format("{}: the element '{}' stands before 'vertex'", name_, element.name),
                           {name_, 0, 0});
        element.name == "face" ? read_faces(element) : read_strips(element);
      } else {
        skip_rows(element);
      }
    }
    if (!vertices) throw InputError(format("{}: the file has no element 'vertex'", name_), {name_, 0, 0});
    if (mesh_.uvs.empty()) mesh_.uv_corners.clear();
    return std::move(mesh_);
  }

 private:
  void skip_rows(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (const PlyProperty& property : element.properties) values_.skip(property);
  }

  void read_vertices(const PlyElement& element) {
    // Where each property goes: 0 to 2 position, 3 to 5 normal, 6 and 7 texture, 8 nowhere.
    constexpr std::size_t kNowhere = 8;
    std::array<std::string_view, kNowhere> names = {"x", "y", "z", "nx", "ny", "nz"};
    for (const auto& [u, v] : kTextureNames)
      if (names[6].empty() && element.find(u) != nullptr && element.find(v) != nullptr)
        names[6] = u, names[7] = v;
    std::vector<std::size_t> targets;
    std::array<bool, kNowhere + 1> there{};
    for (const PlyProperty& property : element.properties) {
      std::size_t target = kNowhere;
      for (std::size_t k = 0; k < kNowhere; ++k)
        if (property.name == names[k] && !property.count_type) target = k;
      targets.push_back(target);
      there[target] = true;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (!there[k])
        throw InputError(format("{}: the element 'vertex' has no property '{}'", name_, names[k]),
                         {name_, 0, 0});
    const bool normals = there[3] && there[4] && there[5], uvs = there[6] && there[7];
    if (element.count >= geometry::kNoIndex)
      throw InputError(format("{}: {} vertices are too many", name_, element.count), {name_, 0, 0});
    mesh_.vertices_m.reserve(element.count);
    std::array<double, kNowhere> row{};
    for (std::uint64_t k = 0; k < element.count; ++k) {
      for (std::size_t p = 0; p < targets.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (targets[p] == kNowhere)
          values_.skip(property);
        else if (targets[p] < 3)
          row[targets[p]] = values_.finite_number(property.type, "a coordinate");
        else if (targets[p] < 6)
          row[targets[p]] = values_.number(property.type);
        else
          row[targets[p]] = values_.finite_number(property.type, "a texture coordinate");
      }
      mesh_.vertices_m.push_back({row[0], row[1], row[2]});
      if (normals) mesh_.normals.push_back({row[3], row[4], row[5]});
      if (uvs) mesh_.uvs.push_back({row[6], row[7]});
    }
  }

  std::uint32_t vertex_index(double index) {
    if (!(index >= 0.0) || index != std::floor(index) ||
        index >= static_cast<double>(mesh_.vertices_m.size()))
      values_.fail(
          format("there is no vertex number {} (from 0): the file has {}", index, mesh_.vertices_m.size()));
    return static_cast<std::uint32_t>(index);
  }

  void read_faces(const PlyElement& element) {
    const PlyProperty* indices = index_list(element);
    if (indices == nullptr && element.count > 0)
      throw InputError(format("{}: the element 'face' has no list 'vertex_indices'", name_), {name_, 0, 0});
    const PlyProperty* texcoord = element.find("texcoord");
    if (texcoord != nullptr && !texcoord->count_type) texcoord = nullptr;
    if (texcoord != nullptr) mesh_.uvs.clear();
    for (std::uint64_t row = 0; row < element.count; ++row) {
      corners_.clear();
      corner_uvs_.clear();
      for (const PlyProperty& property : element.properties) {
        if (&property == indices) {
          const std::uint64_t count = values_.list_count(*property.count_type, property.type);
          if (count < 3) values_.fail(format("a face needs at least 3 corners, found {}", count));
          for (std::uint64_t k = 0; k < count; ++k)
            corners_.push_back(vertex_index(values_.number(property.type)));
        } else if (&property == texcoord) {
          const std::uint64_t count = values_.list_count(*property.count_type, property.type);
          for (std::uint64_t k = 0; k < count; ++k)
            corner_uvs_.push_back(values_.finite_number(property.type, "a texture coordinate"));
        } else {
          values_.skip(property);
        }
      }
      if (texcoord != nullptr && !corner_uvs_.empty() && corner_uvs_.size() != 2 * corners_.size())
        values_.fail(format("a face of {} corners needs {} texture coordinates, found {}", corners_.size(),
                            2 * corners_.size(), corner_uvs_.size()));
      add_face(texcoord != nullptr);
    }
  }

  void add_face(bool with_uvs) {
    points_.clear();
    for (const std::uint32_t c : corners_) points_.push_back(mesh_.vertices_m[c]);
    const auto pieces = cut_face(points_);
    if (!pieces) values_.fail(kCrossesItself);
    const auto first_uv = static_cast<std::uint32_t>(mesh_.uvs.size());
    for (std::size_t k = 0; k + 1 < corner_uvs_.size(); k += 2)
      mesh_.uvs.push_back({corner_uvs_[k], corner_uvs_[k + 1]});
    for (const Triangle& t : *pieces) {
      mesh_.triangles.push_back({corners_[t[0]], corners_[t[1]], corners_[t[2]]});
      if (!with_uvs) continue;
      if (corner_uvs_.empty())
        mesh_.uv_corners.push_back({geometry::kNoIndex, geometry::kNoIndex, geometry::kNoIndex});
      else
        mesh_.uv_corners.push_back({first_uv + t[0], first_uv + t[1], first_uv + t[2]});
    }
  }

  /// Strips of triangles, alternately wound; -1 begins the next one.
  void read_strips(const PlyElement& element) {
    const PlyProperty* indices = index_list(element);
    if (indices == nullptr || !mesh_.uv_corners.empty()) {
      skip_rows(element);
      return;
    }
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (const PlyProperty& property : element.properties) {
        if (&property != indices) {
          values_.skip(property);
          continue;
        }
        const std::uint64_t count = values_.list_count(*property.count_type, property.type);
        corners_.clear();
        for (std::uint64_t k = 0; k < count; ++k) {
          const double index = values_.number(property.type);
          if (index == -1.0) {
            corners_.clear();
            continue;
          }
          corners_.push_back(vertex_index(index));
          const std::size_t n = corners_.size();
          if (n < 3) continue;
          Triangle t{corners_[n - 3], corners_[n - 2], corners_[n - 1]};
          if (n % 2 == 0) std::swap(t[0], t[1]);
          if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
        }
      }
  }

  std::string name_;
  std::string bytes_;
  PlyHeader header_;
  PlyValues values_;
  geometry::TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;
  std::vector<double> corner_uvs_;
  std::vector<math::Point3> points_;
};

}  // namespace

geometry::TriangleMesh read_ply(const std::filesystem::path& path) { return Reader(path).read(); }

namespace {

/// The pictures that the header of a PLY file names.
std::vector<PlyHeader::TextureFile> textures_of(const std::filesystem::path& path) {
  return read_ply_header(read_input(path), path.string()).textures;
}

MeshMaterials read_ply_materials(const std::filesystem::path& path, LogSink*) {
  const std::string file = path.string();
  const std::vector<PlyHeader::TextureFile> textures = textures_of(path);
  if (textures.size() != 1)
    throw InputError(
        format("{}: {}; expected one 'comment TextureFile NAME' in its header (colours of vertices are "
               "not read)",
               file,
               textures.empty() ? std::string("the file names no picture")
                                : format("the file names {} pictures", textures.size())),
        {file, 0, 0});
  MeshMaterials all;
  all.source = path.filename().string();
  FileMaterial material;
  material.picture_name = textures[0].name;
  try {
    const auto picture = file_beside_mesh(path, textures[0].name, "image");
    material.picture = std::make_shared<const Picture>(decode_picture(read_input(picture), picture.string()));
  } catch (const std::exception& error) {
    if (dynamic_cast<const InputError*>(&error) == nullptr &&
        dynamic_cast<const SystemError*>(&error) == nullptr)
      throw;
    throw InputError(format("{}:{}:{}: {}", file, textures[0].line, textures[0].column, error.what()),
                     {file, textures[0].line, textures[0].column});
  }
  all.materials.push_back(std::move(material));
  return all;
}

std::vector<std::filesystem::path> ply_material_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  try {
    for (const PlyHeader::TextureFile& texture : textures_of(path))
      files.push_back(file_beside_mesh(path, texture.name, "image"));
  } catch (const InputError&) {
  } catch (const SystemError&) {
  }
  return files;
}

}  // namespace

constinit const MeshFormat kPly{
    .name = "PLY",
    .extensions = kPlyExtensions,
    .y_up = false,
    .read = [](const std::filesystem::path& path, LogSink*, MeshUse) { return read_ply(path); },
    .read_materials = read_ply_materials,
    .material_files = ply_material_files};

}  // namespace ifov::io
