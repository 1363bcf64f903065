#include "io/mesh/mesh_reader.h"

#include <cctype>

#include "core/error.h"
#include "core/names.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/ply_reader.h"

namespace ifov::io {
namespace {

struct MeshFormat {
  const char* extension;
  bool y_up;
  geometry::TriangleMesh (*read)(const std::filesystem::path&, LogSink*);
};

constexpr MeshFormat kFormats[] = {
    {".obj", false, [](const std::filesystem::path& path, LogSink* log) { return read_obj(path, log); }},
    {".ply", false, [](const std::filesystem::path& path, LogSink*) { return read_ply(path); }},
    {".gltf", true, [](const std::filesystem::path& path, LogSink* log) { return read_gltf(path, log); }},
    {".glb", true, [](const std::filesystem::path& path, LogSink* log) { return read_gltf(path, log); }}};

const MeshFormat* format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const MeshFormat& known : kFormats)
    if (extension == known.extension) return &known;
  return nullptr;
}

}  // namespace

std::vector<std::string> mesh_extensions() {
  std::vector<std::string> extensions;
  for (const MeshFormat& known : kFormats) extensions.emplace_back(known.extension);
  return extensions;
}

bool format_has_y_up(const std::filesystem::path& path) {
  const MeshFormat* known = format_of(path);
  return known != nullptr && known->y_up;
}

geometry::TriangleMesh read_mesh(const std::filesystem::path& path, LogSink* log) {
  const MeshFormat* known = format_of(path);
  const std::string name = path.string();
  if (known == nullptr)
    throw InputError(format("cannot tell the format of the mesh '{}' by its extension; expected {}", name,
                            list_names(mesh_extensions(), "or")),
                     {name, 0, 0});
  geometry::TriangleMesh mesh = known->read(path, log);
  if (mesh.triangles.empty()) throw InputError(format("{}: the file has no faces", name), {name, 0, 0});
  return mesh;
}

}  // namespace ifov::io
