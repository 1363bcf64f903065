#include "geometry/mesh_chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "geometry/growing_box.h"

namespace ifov::geometry {
namespace {

struct Middle {
  std::array<float, 3> at;  // three times the middle, which is as good
  std::uint32_t triangle;
};

/// Entries of the order that become `chunks` chunks.
struct Range {
  std::size_t begin, end, chunks;
};

int longest_side(std::span<const Middle> middles) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Middle& m : middles)
    for (std::size_t k = 0; k < 3; ++k)
      low[k] = std::min(low[k], m.at[k]), high[k] = std::max(high[k], m.at[k]);
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
  return longest;
}

/// Where the first half of a range ends; each half has its share of the chunks.
std::size_t halve(std::vector<Middle>& middles, const Range& range) {
  const std::size_t size = range.end - range.begin;
  const std::size_t middle = range.begin + size * (range.chunks / 2) / range.chunks;
  const auto at = [&](std::size_t k) { return middles.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto side = static_cast<std::size_t>(longest_side(std::span(middles).subspan(range.begin, size)));
  std::nth_element(at(range.begin), at(middle), at(range.end), [side](const Middle& a, const Middle& b) {
    return std::tie(a.at[side], a.triangle) < std::tie(b.at[side], b.triangle);
  });
  return middle;
}

std::vector<Middle> middles_of(const MeshLists& mesh) {
  std::vector<Middle> middles(mesh.triangles.size());
  for (std::size_t t = 0; t < middles.size(); ++t) {
    const Triangle& i = mesh.triangles[t];
    const math::Point3 a = mesh.vertices_m[i[0]], b = mesh.vertices_m[i[1]], c = mesh.vertices_m[i[2]];
    middles[t] = {{float(a.x + b.x + c.x), float(a.y + b.y + c.y), float(a.z + b.z + c.z)},
                  static_cast<std::uint32_t>(t)};
  }
  return middles;
}

World::Bounds bounds_of(const MeshLists& mesh, std::span<const std::uint32_t> triangles) {
  GrowingBox box;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t i : mesh.triangles[t]) box.include(mesh.vertices_m[i], mesh.vertices_m[i]);
  return box.bounds;
}

}  // namespace

void divide(MeshLists& mesh) {
  const std::size_t count = mesh.triangles.size();
  if (count <= kMostInChunk) return;
  struct Divided {
    std::shared_ptr<const void> whole;
    std::vector<std::uint32_t> order;
    std::vector<MeshChunk> chunks;
  };
  const auto divided = std::make_shared<Divided>();
  divided->whole = mesh.keeper;
  divided->order.resize(count);
  {
    std::vector<Middle> middles = middles_of(mesh);
    std::vector<Range> ranges{{0, count, (count + kMostInChunk - 1) / kMostInChunk}};
    while (std::any_of(ranges.begin(), ranges.end(), [](const Range& r) { return r.chunks > 1; })) {
      std::vector<std::size_t> ends(ranges.size());
      parallel_for(static_cast<std::int64_t>(ranges.size()), 0, [&](std::int64_t k) {
        const auto n = static_cast<std::size_t>(k);
        ends[n] = ranges[n].chunks > 1 ? halve(middles, ranges[n]) : ranges[n].end;
      });
      std::vector<Range> next;
      for (std::size_t k = 0; k < ranges.size(); ++k) {
        const Range& r = ranges[k];
        if (r.chunks == 1) {
          next.push_back(r);
          continue;
        }
        next.push_back({r.begin, ends[k], r.chunks / 2});
        next.push_back({ends[k], r.end, r.chunks - r.chunks / 2});
      }
      ranges = std::move(next);
    }
    for (std::size_t k = 0; k < count; ++k) divided->order[k] = middles[k].triangle;
    for (const Range& r : ranges)
      divided->chunks.push_back(
          {{}, static_cast<std::uint32_t>(r.begin), static_cast<std::uint32_t>(r.end - r.begin)});
  }
  parallel_for(static_cast<std::int64_t>(divided->chunks.size()), 0, [&](std::int64_t k) {
    MeshChunk& chunk = divided->chunks[static_cast<std::size_t>(k)];
    const std::span<std::uint32_t> own = std::span(divided->order).subspan(chunk.first, chunk.count);
    std::sort(own.begin(), own.end());
    chunk.bounds = bounds_of(mesh, own);
  });
  mesh.order = divided->order, mesh.chunks = divided->chunks;
  mesh.keeper = divided;
}

}  // namespace ifov::geometry
