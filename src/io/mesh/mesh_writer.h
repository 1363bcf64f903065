#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace ifov::io {

/// A mesh as Wavefront OBJ text: vertices to 0.1 mm, `usemtl` with the names of its slots, `vt` and `vn` where it
/// has them. Triangles keep their order within a slot.
std::string obj_text(const geometry::TriangleMesh& mesh);

/// A mesh as binary little-endian PLY: float vertices, with `s` and `t` where each vertex has one texture
/// coordinate. PLY has no names of materials: slots are lost.
std::string ply_bytes(const geometry::TriangleMesh& mesh);

}  // namespace ifov::io
