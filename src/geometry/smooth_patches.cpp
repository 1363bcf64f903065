#include "geometry/smooth_patches.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Vec3;

/// For each vertex the first one at the same position.
std::vector<std::uint32_t> merged_vertices(std::span<const Point3> vertices_m) {
  const std::size_t slots = std::bit_ceil(2 * vertices_m.size() + 1);
  std::vector<std::uint32_t> table(slots, kNoIndex), first(vertices_m.size());
  for (std::uint32_t v = 0; v < vertices_m.size(); ++v) {
    const Point3& p = vertices_m[v];
    std::uint64_t h = 0;
    for (const double c : {p.x, p.y, p.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15ull;  // + 0.0 makes -0 and 0 one
      h ^= h >> 29;
    }
    std::size_t at = h & (slots - 1);
    while (table[at] != kNoIndex && !(vertices_m[table[at]] == p)) at = (at + 1) & (slots - 1);
    if (table[at] == kNoIndex) table[at] = v;
    first[v] = table[at];
  }
  return first;
}

/// One side of a triangle: its ends in rising order, whether the triangle runs along it that way.
struct Edge {
  std::uint32_t low, high, triangle;
  bool rising;
};

/// All edges, equal ones side by side.
std::vector<Edge> sorted_edges(std::span<const Point3> vertices_m, std::span<const Triangle> triangles) {
  const std::vector<std::uint32_t> first = merged_vertices(vertices_m);
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = first[triangles[t][k]], b = first[triangles[t][(k + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  return edges;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t t) {
  while (parent[t] != t) t = parent[t] = parent[parent[t]];
  return t;
}

}  // namespace

std::vector<std::uint32_t> smooth_patches(std::span<const Point3> vertices_m, std::span<const Triangle> triangles) {
  const double smooth_cosine = std::cos(kCreaseAngleDeg * std::numbers::pi / 180.0);
  const auto area_vector = [&](std::uint32_t t) {
    const Point3 a = vertices_m[triangles[t][0]];
    return cross(vertices_m[triangles[t][1]] - a, vertices_m[triangles[t][2]] - a);
  };
  std::vector<std::uint32_t> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);

  const std::vector<Edge> edges = sorted_edges(vertices_m, triangles);
  for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
    end = begin + 1;
    while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
    for (std::size_t i = begin; i + 1 < end; ++i) {
      const Edge &a = edges[i], &b = edges[i + 1];
      const Vec3 na = area_vector(a.triangle), nb = area_vector(b.triangle);
      // Neighbours that are wound alike run along their common edge in opposite ways.
      const double cosine = (a.rising == b.rising ? -1.0 : 1.0) * dot(na, nb) / (length(na) * length(nb));
      if (!(cosine > smooth_cosine)) continue;
      const std::uint32_t ra = root_of(parent, a.triangle), rb = root_of(parent, b.triangle);
      parent[std::max(ra, rb)] = std::min(ra, rb);
    }
  }

  std::vector<std::uint32_t> patch(triangles.size());
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t root = root_of(parent, t);  // the smallest triangle of its patch
    patch[t] = root == t ? count++ : patch[root];
  }
  return patch;
}

bool is_closed(std::span<const Point3> vertices_m, std::span<const Triangle> triangles) {
  const std::vector<Edge> edges = sorted_edges(vertices_m, triangles);
  if (edges.empty() || edges.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a.low != b.low || a.high != b.high || a.rising == b.rising) return false;
    if (i + 2 < edges.size() && edges[i + 2].low == a.low && edges[i + 2].high == a.high) return false;
  }
  return true;
}

}  // namespace ifov::geometry
