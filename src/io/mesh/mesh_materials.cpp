#include "io/mesh/mesh_materials.h"

#include <algorithm>

#include "core/error.h"
#include "io/files/inputs.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {

MeshMaterials read_mesh_materials(const std::filesystem::path& path, LogSink* log) {
  const std::string name = path.string();
  if (is_asset_name(name) && !input_exists(path))
    throw InputError(format("the mesh '{}' is arrays in memory, which have no materials of a file", name));
  const MeshFormat* known = mesh_format_of(path);
  if (known == nullptr || known->read_materials == nullptr)
    throw InputError(format("{}: materials are read of OBJ, PLY and glTF files", name), {name, 0, 0});
  return known->read_materials(path, log);
}

std::vector<std::filesystem::path> mesh_material_files(const std::filesystem::path& path) {
  const MeshFormat* known = mesh_format_of(path);
  if (known == nullptr || known->material_files == nullptr) return {};
  return known->material_files(path);
}

std::filesystem::path file_beside_mesh(const std::filesystem::path& mesh, std::string name,
                                       const std::string& what) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (is_asset_name(mesh.native())) {
    const std::string beside =
        (std::filesystem::path(mesh.string().substr(kAssetPrefix.size())).parent_path() / name)
            .lexically_normal()
            .string();
    const std::filesystem::path asset = std::string(kAssetPrefix) + beside;
    if (!input_exists(asset)) throw InputError(format("there is no {} '{}' in memory", what, asset.string()));
    return asset;
  }
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(mesh.has_parent_path() ? mesh.parent_path() : ".");
  std::error_code error;
  const auto real = std::filesystem::weakly_canonical(folder / name, error);
  const auto within = error ? std::filesystem::path("..") : real.lexically_relative(folder);
  if (within.empty() || *within.begin() == "..")
    throw InputError(format("the {} '{}' does not lie in the folder of the mesh or below", what, name));
  if (!std::filesystem::is_regular_file(real, error))
    throw InputError(format("there is no {} '{}'", what, real.string()));
  return real;
}

}  // namespace ifov::io
