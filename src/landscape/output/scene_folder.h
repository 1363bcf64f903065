#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "io/raster/raster.h"

namespace ifov::landscape {

/// A folder being made: it is called `<folder>.part` until publish(), and removed where that is never called.
class SceneFolder {
 public:
  /// InputError where the folder exists and is neither empty nor to be replaced; SystemError where it cannot
  /// be made.
  SceneFolder(const std::filesystem::path& folder, bool replace);
  ~SceneFolder();
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  /// Each returns the name to be used in documents: the path within the folder.
  std::string add_text(const std::string& name, std::string_view content);
  /// With named slots; `meshes/<name>.obj`.
  std::string add_mesh(const std::string& name, const geometry::TriangleMesh& mesh);
  /// Large and of one material; `meshes/<name>.ply`.
  std::string add_large_mesh(const std::string& name, const geometry::TriangleMesh& mesh);
  /// `instances/<name>.csv`.
  std::string add_list(const std::string& name, std::string_view rows);
  /// `maps/<name>.tif`.
  std::string add_map(const std::string& name, const io::Raster& raster);
  /// `spectra/<name>.csv`.
  std::string add_spectrum(const std::string& name, std::string_view rows);
  /// Whether a file of that path within the folder has been written.
  bool has(const std::string& file) const {
    return std::find(files_.begin(), files_.end(), file) != files_.end();
  }

  void publish();

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<std::string>& files() const { return files_; }
  std::uint64_t bytes() const { return bytes_; }
  std::size_t triangles() const { return triangles_; }

 private:
  void make_subfolder(const char* name);

  std::filesystem::path folder_, part_;
  std::vector<std::string> files_;
  std::uint64_t bytes_ = 0;
  std::size_t triangles_ = 0;
  bool published_ = false;
};

}  // namespace ifov::landscape
