#pragma once

#include <filesystem>
#include <vector>

#include "core/run_control.h"

namespace ifov::io {

struct MeshMaterials;

/// Diffuse colours (Kd) and pictures (map_Kd) of the libraries that an OBJ file names (mtllib); see read_mesh_materials().
MeshMaterials read_obj_materials(const std::filesystem::path& path, LogSink* log);
std::vector<std::filesystem::path> obj_material_files(const std::filesystem::path& path);

}  // namespace ifov::io
