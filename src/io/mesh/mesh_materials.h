#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::io {

struct Picture;

/// How a material of a mesh file is looked through.
enum class AlphaMode { opaque, mask, blend };
/// What lies beyond the edges of a picture.
enum class Wrap { repeat, mirror, edge };

/// What a mesh file says of the colour of one of its materials.
struct FileMaterial {
  std::string slot;                             ///< as TriangleMesh::slot_names
  std::array<double, 3> colour{1.0, 1.0, 1.0};  ///< linear sRGB, 0 to 1; the picture is multiplied by it
  std::shared_ptr<const Picture> picture;       ///< null: one colour
  std::string picture_name;                     ///< for people
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};  ///< along u and along v
  AlphaMode alpha = AlphaMode::opaque;
  double opacity = 1.0;       ///< that of its pictures is multiplied by it
  double alpha_cutoff = 0.5;  ///< of AlphaMode::mask: what is below is not there
  /// How opaque it is from place to place: the fourth bytes of these cells; null: alike everywhere.
  std::shared_ptr<const Picture> opacity_picture;
  std::string opacity_name;                                      ///< for people
  std::array<Wrap, 2> opacity_wrap{Wrap::repeat, Wrap::repeat};  ///< as `wrap`
  std::vector<std::string> not_used;  ///< what else the file says of it: "metalness", "normal map"
};

struct MeshMaterials {
  std::vector<FileMaterial> materials;  ///< of the slots that the file says something of
  std::string source;                   ///< what says it, for people: "house.mtl"
  bool says_coding = true;              ///< the format says that colours are linear; else that is a guess
};

/// The materials of a mesh file: base colours of glTF, Kd and map_Kd of an OBJ's library, the TextureFile of a PLY. Pictures that are
/// used by several are read once. Throws InputError, with the place, where there is none of that, or a picture is not there or not
/// read; SystemError if the file cannot be read. `log` may be null.
MeshMaterials read_mesh_materials(const std::filesystem::path& path, LogSink* log = nullptr);

/// The files that these lie in, beside the mesh; none where they cannot be told.
std::vector<std::filesystem::path> mesh_material_files(const std::filesystem::path& path);

/// A file that a mesh file names: in the mesh's own folder or below, or of a mesh in memory an asset beside it. `what`: "image".
/// Throws InputError that says what is wrong, without a place.
std::filesystem::path file_beside_mesh(const std::filesystem::path& mesh, std::string name,
                                       const std::string& what);

}  // namespace ifov::io
