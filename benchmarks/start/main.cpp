// A large mesh of triangles that all differ.
//   bench_start write FOLDER CELLS   writes CELLS x CELLS cells of two triangles as PLY, and two documents that look at
//                                    a part of them and at all
//   bench_start trace CELLS          rays into such a mesh with its trees made chunk by chunk and at once: whether they
//                                    meet the same, and the triangle that they name, and how fast. Prints one JSON object
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/format.h"
#include "core/parallel.h"
#include "geometry/world/world_builder.h"

namespace {

using namespace ifov;

constexpr double kCell_m = 2.0;
constexpr std::size_t kRays = 1 << 20, kBatch = 512;

/// Of all threads of this process: others who use the machine do not count.
double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double uniform(std::uint64_t key, std::uint64_t index) {
  std::uint64_t h = key * 0x9e3779b97f4a7c15ull + index * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

/// Hills, furrows and stones.
std::array<float, 3> vertex(std::uint32_t cells, std::uint32_t column, std::uint32_t row) {
  const double x = (column - 0.5 * cells) * kCell_m, y = (row - 0.5 * cells) * kCell_m;
  const double z = 40.0 * std::sin(x / 230.0) * std::cos(y / 320.0) + 6.0 * std::sin(x / 31.0 + y / 57.0) +
                   0.8 * uniform(1, std::uint64_t{row} * (cells + 1) + column);
  return {float(x), float(y), float(z)};
}

geometry::Triangle triangle(std::uint32_t cells, std::uint32_t number) {
  const std::uint32_t cell = number / 2, a = cell / cells * (cells + 1) + cell % cells, d = a + cells + 2;
  return number % 2 == 0 ? geometry::Triangle{a, a + 1, d} : geometry::Triangle{a, d, d - 1};
}

void write_mesh(const std::filesystem::path& path, std::uint32_t cells) {
  std::ofstream file(path, std::ios::binary);
  file << format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      (cells + 1) * (cells + 1), 2 * cells * cells);
  std::vector<char> row;
  const auto append = [&](const void* bytes, std::size_t count) {
    row.insert(row.end(), static_cast<const char*>(bytes), static_cast<const char*>(bytes) + count);
  };
  const auto flush = [&] {
    file.write(row.data(), static_cast<std::streamsize>(row.size()));
    row.clear();
  };
  for (std::uint32_t j = 0; j <= cells; ++j, flush())
    for (std::uint32_t i = 0; i <= cells; ++i) append(vertex(cells, i, j).data(), 12);
  for (std::uint32_t j = 0; j < cells; ++j, flush())
    for (std::uint32_t t = 2 * cells * j; t < 2 * cells * (j + 1); ++t) {
      row.push_back(3);
      append(triangle(cells, t).data(), 12);
    }
  if (!file.flush()) std::exit(1);
}

void write_document(const std::filesystem::path& path, double gsd_m, int pixels) {
  std::ofstream(path) << format(R"({{"ifov": 1,
  "scene": {{"materials": {{"soil": {{"reflectance": 0.3}}}},
            "objects": [{{"mesh": {{"file": "mesh.ply"}}, "material": "soil"}}]}},
  "light": {{"sun": {{"point": {{"zenith": "40 deg", "azimuth": "130 deg"}}}}}},
  "sensor": {{"camera": {{"orthographic": {{"gsd": "{} m", "pixels": [{}, {}]}}}},
             "channels": [{{"name": "red", "monochromatic": {{"at": "0.65 um"}}}}]}},
  "sampling": {{"grid": {{"elements": [2, 2]}}, "max_depth": 2}}}}
)",
                                gsd_m, pixels, pixels);
}

geometry::TriangleMesh mesh_of(std::uint32_t cells) {
  geometry::TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const auto [x, y, z] = vertex(cells, i, j);
      mesh.vertices_m.push_back({x, y, z});
    }
  for (std::uint32_t t = 0; t < 2 * cells * cells; ++t) mesh.triangles.push_back(triangle(cells, t));
  return mesh;
}

std::unique_ptr<geometry::World> world_of(const geometry::TriangleMesh& mesh, geometry::LargeMeshes how) {
  geometry::WorldBuilder builder;
  const std::uint32_t soil = 0;
  builder.place(builder.add_shape(mesh), {}, {&soil, 1});
  geometry::BuildOptions options;
  options.large_meshes = how;
  return builder.build(options);
}

/// Rows of a scanner, and as many rays from near the ground in any direction.
std::vector<math::Ray> rays_over(std::uint32_t cells) {
  std::vector<math::Ray> rays;
  const double side_m = 0.98 * kCell_m * cells;
  for (std::uint64_t k = 0; k < kRays; ++k) {
    const std::uint64_t row = k / kBatch;
    const math::Point3 near{(uniform(2, row) - 0.5) * side_m, (uniform(3, row) - 0.5) * side_m, 60.0};
    if (row % 2 == 0) {
      const math::Vec3 down = math::normalized({0.1 * (uniform(4, row) - 0.5), 0.05, -1.0});
      rays.push_back({near + math::Vec3{0.5 * double(k % kBatch), 0.0, 0.0} - down * 3000.0, down});
    } else {
      const double z = -0.5 * uniform(5, k), a = 6.283185307179586 * uniform(6, k),
                   r = std::sqrt(1.0 - z * z);
      rays.push_back({near, {r * std::cos(a), r * std::sin(a), z}});
    }
  }
  return rays;
}

double trace_s(const geometry::World& world, const std::vector<math::Ray>& rays,
               std::vector<geometry::SurfacePoint>& hits) {
  const double before_s = processor_s();
  parallel_for(static_cast<std::int64_t>(rays.size() / kBatch), 0, [&](std::int64_t k) {
    const std::size_t begin = static_cast<std::size_t>(k) * kBatch;
    world.intersect(std::span(rays).subspan(begin, kBatch), std::span(hits).subspan(begin, kBatch));
  });
  return processor_s() - before_s;
}

bool same(const geometry::SurfacePoint& a, const geometry::SurfacePoint& b) {
  return a.hit() == b.hit() && a.distance_m == b.distance_m && a.position_m == b.position_m &&
         a.geometric_normal == b.geometric_normal && a.primitive == b.primitive && a.patch == b.patch;
}

int trace(std::uint32_t cells) {
  const geometry::TriangleMesh mesh = mesh_of(cells);
  const std::vector<math::Ray> rays = rays_over(cells);
  const auto at_once = world_of(mesh, geometry::LargeMeshes::at_once);
  const auto by_chunk = world_of(mesh, geometry::LargeMeshes::by_chunk);
  std::vector<geometry::SurfacePoint> expected(rays.size()), found(rays.size());
  const double first_s = trace_s(*by_chunk, rays, found);
  trace_s(*at_once, rays, expected);
  constexpr int kTurns = 7;
  std::vector<double> ratios;
  for (int turn = 0; turn < kTurns; ++turn) {
    double once_s = 0.0, chunk_s = 0.0;
    if (turn % 2 == 0) once_s = trace_s(*at_once, rays, expected);
    chunk_s = trace_s(*by_chunk, rays, found);
    if (turn % 2 == 1) once_s = trace_s(*at_once, rays, expected);
    ratios.push_back(chunk_s / once_s);
  }
  std::sort(ratios.begin(), ratios.end());
  std::size_t met = 0, different = 0, wrong = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!same(found[k], expected[k])) ++different;
    if (!found[k].hit()) continue;
    ++met;
    const geometry::Triangle& t = mesh.triangles[found[k].primitive];
    const math::Point3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
    const math::Vec3 n = math::normalized(cross(b - a, c - a));
    if (std::abs(dot(n, found[k].position_m - a)) > 1e-8) ++wrong;
  }
  std::puts(
      format(
          "{{\"triangles\": {}, \"chunks\": {}, \"rays\": {}, \"met\": {}, \"different\": {}, \"wrong\": {}, "
          "\"trees_and_rays_s\": {:.2f}, \"time_over_at_once\": {:.3f}}}",
          by_chunk->triangle_count(), by_chunk->storage().chunks, rays.size(), met, different, wrong, first_s,
          ratios[kTurns / 2])
          .c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "write") == 0) {
    const std::filesystem::path folder = argv[2];
    const auto cells = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
    std::filesystem::create_directories(folder);
    write_mesh(folder / "mesh.ply", cells);
    write_document(folder / "part.json", 1.0, 32);
    write_document(folder / "whole.json", kCell_m * cells / 512.0, 512);
    return 0;
  }
  if (argc == 3 && std::strcmp(argv[1], "trace") == 0)
    return trace(static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)));
  std::fprintf(stderr, "bench_start write FOLDER CELLS | bench_start trace CELLS\n");
  return 2;
}
