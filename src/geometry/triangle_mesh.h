#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace ifov::geometry {

/// Texture coordinates.
struct Uv {
  double u = 0.0, v = 0.0;
  friend constexpr bool operator==(const Uv&, const Uv&) = default;
};

/// Three indices into a list; a corner that has no such attribute holds kNoIndex.
using Triangle = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

/// Triangles over shared vertices, metres in the object's frame, counter-clockwise when seen from outside.
struct TriangleMesh {
  std::vector<math::Point3> vertices_m;
  std::vector<Triangle> triangles;

  std::vector<std::uint32_t> slots;     ///< material slot per triangle; empty: all 0
  std::vector<std::string> slot_names;  ///< as in the file; empty: one slot without a name

  std::vector<math::Normal3> normals;    ///< vertex normals; may be empty
  std::vector<Triangle> normal_corners;  ///< into `normals`, per triangle; empty: the triangles' own indices
  std::vector<Uv> uvs;                   ///< texture coordinates; may be empty
  std::vector<Triangle> uv_corners;      ///< into `uvs`, per triangle; empty: the triangles' own indices
};

}  // namespace ifov::geometry
