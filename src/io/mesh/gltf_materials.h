#pragma once

#include <tiny_gltf.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::io {

struct MeshMaterials;

/// Base colours of the materials of a glTF 2 file; see read_mesh_materials(). Images may lie in buffers, in data URIs, in files beside.
MeshMaterials read_gltf_materials(const std::filesystem::path& path, LogSink* log);
std::vector<std::filesystem::path> gltf_material_files(const std::filesystem::path& path);

/// The slot of each material: its name, "material <number>" where it has none. `unique`: names that occur twice are told apart.
std::vector<std::string> gltf_slot_names(const tinygltf::Model& model, bool unique);

/// Where the picture of a material's base colour lies: by which set of texture coordinates, moved how (KHR_texture_transform).
struct GltfPlacement {
  int set = 0;
  std::array<double, 2> offset{0.0, 0.0}, scale{1.0, 1.0};
  double rotation_rad = 0.0;

  /// Of coordinates of the file, v downwards: first scale, then rotate, then move. The rotation is counter-clockwise as one sees it
  /// with v downwards, as the extension's text and the usual viewers have it (not the extension's example in GLSL).
  std::array<double, 2> of(double u, double v) const;
};
/// `material` -1: none. Throws InputError on numbers that are not finite.
GltfPlacement gltf_placement(const tinygltf::Model& model, int material, const std::string& file);

}  // namespace ifov::io
