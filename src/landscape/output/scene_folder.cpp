#include "landscape/output/scene_folder.h"

#include <system_error>

#include "core/error.h"
#include "core/format.h"
#include "io/files/own_files.h"
#include "io/mesh/mesh_writer.h"
#include "io/raster/raster_writer.h"

namespace ifov::landscape {
namespace fs = std::filesystem;

SceneFolder::SceneFolder(const fs::path& folder, bool replace) : folder_(folder.lexically_normal()) {
  if (folder_.has_parent_path() && !folder_.has_filename()) folder_ = folder_.parent_path();
  std::error_code error;
  if (fs::exists(folder_, error)) {
    if (!fs::is_directory(folder_, error))
      throw InputError(format("ifov: '{}' exists and is not a folder; give another name", folder_.string()));
    if (!replace && !fs::is_empty(folder_, error))
      throw InputError(
          format("ifov: the folder '{}' exists; give another name, or --force to replace it with all "
                 "that is in it",
                 folder_.string()));
  }
  part_ = folder_;
  part_ += ".part";
  fs::remove_all(part_, error);
  if (!fs::create_directories(part_, error))
    throw SystemError(format("cannot make the folder '{}': {}", part_.string(), error.message()));
}

SceneFolder::~SceneFolder() {
  std::error_code error;
  if (!published_) fs::remove_all(part_, error);
}

void SceneFolder::make_subfolder(const char* name) {
  std::error_code error;
  fs::create_directories(part_ / name, error);
  if (error)
    throw SystemError(format("cannot make the folder '{}': {}", (part_ / name).string(), error.message()));
}

std::string SceneFolder::add_text(const std::string& name, std::string_view content) {
  io::write_new_file(part_ / name, content);
  files_.push_back(name);
  bytes_ += content.size();
  return name;
}

std::string SceneFolder::add_mesh(const std::string& name, const geometry::TriangleMesh& mesh) {
  make_subfolder("meshes");
  triangles_ += mesh.triangles.size();
  return add_text(format("meshes/{}.obj", name), io::obj_text(mesh));
}

std::string SceneFolder::add_large_mesh(const std::string& name, const geometry::TriangleMesh& mesh) {
  make_subfolder("meshes");
  triangles_ += mesh.triangles.size();
  return add_text(format("meshes/{}.ply", name), io::ply_bytes(mesh));
}

std::string SceneFolder::add_list(const std::string& name, std::string_view rows) {
  make_subfolder("instances");
  return add_text(format("instances/{}.csv", name), rows);
}

std::string SceneFolder::add_spectrum(const std::string& name, std::string_view rows) {
  make_subfolder("spectra");
  return add_text(format("spectra/{}.csv", name), rows);
}

std::string SceneFolder::add_map(const std::string& name, const io::Raster& raster) {
  make_subfolder("maps");
  const std::string file = format("maps/{}.tif", name);
  io::write_byte_raster(part_ / file, raster);
  std::error_code error;
  files_.push_back(file);
  bytes_ += fs::file_size(part_ / file, error);
  return file;
}

void SceneFolder::publish() {
  std::error_code error;
  fs::path old = folder_;
  old += ".old";
  const bool replaces = fs::exists(folder_, error);
  if (replaces) {
    fs::remove_all(old, error);
    fs::rename(folder_, old, error);
  }
  if (!error) fs::rename(part_, folder_, error);
  if (error) throw SystemError(format("cannot put '{}' in its place: {}", folder_.string(), error.message()));
  published_ = true;
  if (replaces) fs::remove_all(old, error);
}

}  // namespace ifov::landscape
