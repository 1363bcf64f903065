#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace ifov::geometry {

/// Facets meet without a crease where their normals differ by less than this.
inline constexpr double kCreaseAngleDeg = 30.0;

/// The smooth patch of every triangle: triangles are joined across shared edges (vertices at the same position count
/// as one) that are no creases. Patches are numbered from 0 in order of their first triangle.
std::vector<std::uint32_t> smooth_patches(std::span<const math::Point3> vertices_m, std::span<const Triangle> triangles);

/// The mesh bounds a volume: every edge is shared by exactly two triangles that run along it in opposite ways.
bool is_closed(std::span<const math::Point3> vertices_m, std::span<const Triangle> triangles);

}  // namespace ifov::geometry
