#include "io/mesh/mesh_reader.h"

#include "core/error.h"
#include "core/names.h"
#include "io/files/inputs.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {

std::vector<std::string> mesh_extensions() {
  std::vector<std::string> extensions;
  for (const MeshFormat* known : mesh_formats())
    extensions.insert(extensions.end(), known->extensions.begin(), known->extensions.end());
  return extensions;
}

bool format_has_y_up(const std::filesystem::path& path) {
  const MeshFormat* known = mesh_format_of(path);
  return known != nullptr && known->y_up;
}

std::vector<std::string> further_mesh_files(const std::filesystem::path& path) {
  std::vector<std::string> files;
  const MeshFormat* known = mesh_format_of(path);
  if (known != nullptr && known->further_files != nullptr)
    for (const std::filesystem::path& file : known->further_files(path)) files.push_back(file.string());
  return files;
}

geometry::TriangleMesh read_mesh(const std::filesystem::path& path, LogSink* log, MeshUse use) {
  if (const auto* const asset = arrays_of_asset<geometry::TriangleMesh>(path, "a mesh")) return *asset;
  const MeshFormat* known = mesh_format_of(path);
  const std::string name = path.string();
  if (known == nullptr)
    throw InputError(format("cannot tell the format of the mesh '{}' by its extension; expected {}", name,
                            list_names(mesh_extensions(), "or")),
                     {name, 0, 0});
  geometry::TriangleMesh mesh = known->read(path, log, use);
  if (mesh.triangles.empty()) throw InputError(format("{}: the file has no faces", name), {name, 0, 0});
  return mesh;
}

}  // namespace ifov::io
