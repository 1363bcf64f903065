#pragma once

#include <filesystem>

#include "core/run_control.h"
#include "geometry/triangle_mesh.h"
#include "io/mesh/mesh_format.h"

namespace ifov::io {

/// Copies within one file (nodes of a glTF file, templates of a CityJSON file) may unfold to this many
/// triangles, so that a small file cannot fill the memory.
inline constexpr std::size_t kMostUnfoldedTriangles = 5'000'000;

/// Reads the default scene of a glTF 2 file (.gltf or .glb) as one mesh in metres, y up: triangles, strips
/// and fans of all nodes with their transforms applied in double (a mirroring node turns its triangles
/// round), POSITION, NORMAL, TEXCOORD_0 (v counted from the image's lower edge as in OBJ: 1 - v of the file).
/// Materials become slots by name ("material <number>" where they have none), the absent material a slot
/// without a name. With materials: the coordinates of each primitive are those that the picture of its base colour lies by (its set,
/// its KHR_texture_transform), and slots of one name are told apart. Skins, morphs, animations, images, cameras, points and lines are not read, the last three
/// with a word to `log` (may be null). Throws InputError for anything broken, for compressed or sparse data;
/// SystemError if the file cannot be read.
geometry::TriangleMesh read_gltf(const std::filesystem::path& path, LogSink* log = nullptr,
                                 MeshUse use = MeshUse::shape);

extern const MeshFormat kGltf;

}  // namespace ifov::io
