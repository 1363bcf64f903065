#include "geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/call_scope.h"
#include "core/parallel.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Vec3;

constexpr std::size_t kBetweenLooks = 1 << 16;  // steps of a loop until it looks whether it is cancelled

void stop_at_times(std::size_t step) {
  if (step % kBetweenLooks == 0) stop_if_cancelled();
}

/// For each vertex the first one at the same position.
std::vector<std::uint32_t> merged_vertices(std::span<const Point3> vertices_m) {
  const std::size_t slots = std::bit_ceil(2 * vertices_m.size() + 1);
  std::vector<std::uint32_t> table(slots, kNoIndex), first(vertices_m.size());
  for (std::uint32_t v = 0; v < vertices_m.size(); ++v) {
    stop_at_times(v);
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

/// One side of a triangle: its ends, the smaller first, and whether the triangle runs along it that way.
struct Edge {
  std::uint64_t ends;
  std::uint32_t triangle;
  bool rising;
};

/// All edges, equal ones side by side.
std::vector<Edge> sorted_edges(std::span<const Point3> vertices_m, std::span<const Triangle> triangles) {
  const std::vector<std::uint32_t> first = merged_vertices(vertices_m);
  const auto each = [&](const auto& take) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      stop_at_times(t);
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = first[triangles[t][k]], b = first[triangles[t][(k + 1) % 3]];
        if (a != b) take(std::min(a, b), std::max(a, b), t, a < b);
      }
    }
  };
  // Counted by their smaller ends, of which each has a few; these are sorted. end[v + 1] is where those of v go next, and at last
  // where they end.
  std::vector<std::size_t> end(vertices_m.size() + 2, 0);
  each([&](std::uint32_t low, std::uint32_t, std::uint32_t, bool) { ++end[low + 2]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Edge> edges(end.back());
  each([&](std::uint32_t low, std::uint32_t high, std::uint32_t t, bool rising) {
    edges[end[low + 1]++] = {(std::uint64_t{low} << 32) | high, t, rising};
  });
  const auto blocks = static_cast<std::int64_t>((vertices_m.size() + kBetweenLooks - 1) / kBetweenLooks);
  parallel_for(blocks, 0, [&](std::int64_t block) {
    const std::size_t from = static_cast<std::size_t>(block) * kBetweenLooks,
                      to = std::min(from + kBetweenLooks, vertices_m.size());
    for (std::size_t v = from; v < to; ++v)
      std::sort(edges.begin() + static_cast<std::ptrdiff_t>(end[v]),
                edges.begin() + static_cast<std::ptrdiff_t>(end[v + 1]), [](const Edge& a, const Edge& b) {
                  return a.ends != b.ends ? a.ends < b.ends : a.triangle < b.triangle;
                });
  });
  return edges;
}

/// Sets of triangles that grow together; the smallest triangle stands for its set.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ra = root(a), rb = root(b);
    parent_[std::max(ra, rb)] = std::min(ra, rb);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

bool mostly_small(Groups& pieces, std::size_t count) {
  std::vector<std::uint32_t> size(count);
  for (std::uint32_t t = 0; t < count; ++t) ++size[pieces.root(t)];
  std::size_t in_large = 0;
  for (const std::uint32_t n : size) in_large += n > 3 ? n : 0;
  return 20 * in_large <= count;
}

}  // namespace

MeshTopology topology_of(std::span<const Point3> vertices_m, std::span<const Triangle> triangles) {
  const double smooth_cosine = std::cos(kCreaseAngleDeg * std::numbers::pi / 180.0);
  const auto area_vector = [&](std::uint32_t t) {
    const Point3 a = vertices_m[triangles[t][0]];
    return cross(vertices_m[triangles[t][1]] - a, vertices_m[triangles[t][2]] - a);
  };
  const std::vector<Edge> edges = sorted_edges(vertices_m, triangles);
  Groups smooth(triangles.size()), pieces(triangles.size());
  MeshTopology topology;
  topology.closed = !edges.empty();
  std::size_t groups = 0;
  for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
    end = begin + 1;
    stop_at_times(groups++);
    while (end < edges.size() && edges[end].ends == edges[begin].ends) ++end;
    if (end - begin != 2 || edges[begin].rising == edges[begin + 1].rising) topology.closed = false;
    for (std::size_t i = begin; i + 1 < end; ++i) {
      const Edge &a = edges[i], &b = edges[i + 1];
      pieces.join(a.triangle, b.triangle);
      // Neighbours that are wound alike run along their common edge in opposite ways.
      const Vec3 na = area_vector(a.triangle), nb = area_vector(b.triangle);
      const double cosine = (a.rising == b.rising ? -1.0 : 1.0) * dot(na, nb) / (length(na) * length(nb));
      if (cosine > smooth_cosine) smooth.join(a.triangle, b.triangle);
    }
  }
  topology.loose = mostly_small(pieces, triangles.size());
  topology.patches.resize(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t root = smooth.root(t);
    topology.patches[t] = root == t ? topology.patch_count++ : topology.patches[root];
  }
  return topology;
}

}  // namespace ifov::geometry
