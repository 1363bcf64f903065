#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/run_control.h"
#include "geometry/triangle_mesh.h"

namespace ifov::io {

/// What a mesh is read for: its shape, with materials from the document; or with the materials of the file, whose pictures lie by the
/// texture coordinates that they are meant for.
enum class MeshUse { shape, with_materials };

struct MeshMaterials;

/// A format of mesh files.
struct MeshFormat {
  std::string_view name;                         ///< "Wavefront OBJ"
  std::span<const std::string_view> extensions;  ///< ".obj", in small letters
  bool y_up = false;                             ///< the format itself says that y points up

  /// `log` (may be null) is told what the file holds and is not used. Throws InputError with the place of what is wrong,
  /// SystemError if the file cannot be read.
  geometry::TriangleMesh (*read)(const std::filesystem::path& path, LogSink* log, MeshUse use) = nullptr;

  /// Files beside this one that its reader opens as well, of which caches and runs have to know; null where there are
  /// none. Nothing where the reader refuses the file, which is for it to say.
  std::vector<std::filesystem::path> (*further_files)(const std::filesystem::path& path) = nullptr;

  /// See read_mesh_materials() and mesh_material_files().
  MeshMaterials (*read_materials)(const std::filesystem::path& path, LogSink* log) = nullptr;
  std::vector<std::filesystem::path> (*material_files)(const std::filesystem::path& path) = nullptr;
};

/// All formats, in the order of messages.
std::span<const MeshFormat* const> mesh_formats();

/// By the file's extension, in capitals or not; null for one that is not known.
const MeshFormat* mesh_format_of(const std::filesystem::path& path);

}  // namespace ifov::io
