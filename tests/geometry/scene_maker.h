#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "math/ray.h"

namespace ifov::test {

/// Numbers in [0, 1) as hashes of what they are for.
inline double uniform(std::uint64_t key, std::uint64_t index) {
  std::uint64_t h = key * 0x9e3779b97f4a7c15ull + index * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

inline math::Vec3 direction(std::uint64_t key, std::uint64_t index) {
  const double z = 2.0 * uniform(key, 2 * index) - 1.0, a = 6.283185307179586 * uniform(key, 2 * index + 1);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

/// A bumpy height field of n x n cells of 1 m about `centre`, two triangles each, wound with outside up.
inline geometry::TriangleMesh height_field(int n, math::Point3 centre, std::uint64_t key = 1) {
  geometry::TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const auto at = static_cast<std::uint64_t>(j * (n + 1) + i);
      mesh.vertices_m.push_back(
          centre + math::Vec3{i - 0.5 * n + 0.2 * uniform(key, 3 * at),
                              j - 0.5 * n + 0.2 * uniform(key, 3 * at + 1),
                              2.0 * std::sin(0.3 * i) * std::cos(0.2 * j) + 0.4 * uniform(key, 3 * at + 2)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i), b = a + 1,
                 c = a + static_cast<std::uint32_t>(n) + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// A closed ball of triangles, outside outwards.
inline geometry::TriangleMesh ball(int rings, int sectors, double radius_m, math::Point3 centre = {}) {
  geometry::TriangleMesh mesh;
  mesh.vertices_m.push_back(centre + math::Vec3{0.0, 0.0, radius_m});
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const double polar = 3.141592653589793 * r / rings, a = 6.283185307179586 * s / sectors;
      mesh.vertices_m.push_back(
          centre + math::Vec3{std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)} *
                       radius_m);
    }
  mesh.vertices_m.push_back(centre - math::Vec3{0.0, 0.0, radius_m});
  const auto at = [&](int r, int s) {
    return static_cast<std::uint32_t>(1 + (r - 1) * sectors + s % sectors);
  };
  const auto last = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
  for (int s = 0; s < sectors; ++s) {
    mesh.triangles.push_back({0, at(1, s), at(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, s), last, at(rings - 1, s + 1)});
  }
  return mesh;
}

/// The nearest triangle along a ray by plain double arithmetic, every triangle tried; t is infinite where
/// none is met.
struct BruteHit {
  double t = std::numeric_limits<double>::infinity();
  std::size_t triangle = 0;
  double margin = 0.0;  ///< smallest barycentric weight: how far from an edge the hit lies
};
inline BruteHit brute_force(const std::vector<math::Point3>& vertices,
                            const std::vector<geometry::Triangle>& triangles, const math::Ray& ray) {
  BruteHit best;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const math::Point3 a = vertices[triangles[k][0]];
    const math::Vec3 e1 = vertices[triangles[k][1]] - a,
                     e2 = vertices[triangles[k][2]] - a;  // Moeller and Trumbore, 1997
    const math::Vec3 p = cross(ray.direction, e2);
    const double det = dot(e1, p);
    if (det == 0.0) continue;
    const math::Vec3 s = ray.origin_m - a, q = cross(s, e1);
    const double u = dot(s, p) / det, v = dot(ray.direction, q) / det, t = dot(e2, q) / det;
    const double margin = std::min(std::min(u, v), 1.0 - u - v);
    if (margin >= 0.0 && t > ray.t_min_m && t < best.t) best = {t, k, margin};
  }
  return best;
}

}  // namespace ifov::test
