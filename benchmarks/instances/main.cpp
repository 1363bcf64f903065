// Many instances of one tree, from a binary list on disk to the first rays: time, memory, and whether what the rays
// meet is right. Prints one JSON object.
//   bench_instances FOLDER COUNT [nodes|table]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "core/format.h"
#include "geometry/world/world_builder.h"
#include "io/instances/instance_file.h"
#include "io/instances/instance_writer.h"

namespace {

using namespace ifov;
using Clock = std::chrono::steady_clock;

constexpr int kLeaves = 2450;
constexpr double kStep_m = 6.0;
constexpr std::size_t kRays = 200000, kBatch = 512;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double uniform(std::uint64_t key, std::uint64_t index) {
  std::uint64_t h = key * 0x9e3779b97f4a7c15ull + index * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

/// 5,000 triangles: leaf cards of 0.35 m by 0.25 m in an ellipsoid over a trunk of 100.
geometry::TriangleMesh tree() {
  geometry::TriangleMesh mesh;
  for (std::uint64_t leaf = 0; leaf < kLeaves; ++leaf) {
    const double z = 2.0 * uniform(1, leaf) - 1.0, a = 2.0 * std::numbers::pi * uniform(2, leaf);
    const double r = std::sqrt(1.0 - z * z), depth = std::pow(uniform(3, leaf), 0.25);
    const math::Point3 centre{3.5 * depth * r * std::cos(a), 3.5 * depth * r * std::sin(a),
                              7.0 + 4.0 * depth * z};
    const math::Transform turn = math::Transform::rotation(
        {uniform(4, leaf) - 0.5, uniform(5, leaf) - 0.5, uniform(6, leaf) - 0.5}, 6.283 * uniform(7, leaf));
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const math::Vec3 d :
         {math::Vec3{-0.175, -0.125, 0}, {0.175, -0.125, 0}, {0.175, 0.125, 0}, {-0.175, 0.125, 0}})
      mesh.vertices_m.push_back(centre + turn(d));
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  const auto base = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (int ring = 0; ring <= 5; ++ring)
    for (int k = 0; k < 10; ++k)
      mesh.vertices_m.push_back(
          {0.2 * std::cos(0.6283185 * k), 0.2 * std::sin(0.6283185 * k), -0.5 + 1.2 * ring});
  for (std::uint32_t ring = 0; ring < 5; ++ring)
    for (std::uint32_t k = 0; k < 10; ++k) {
      const std::uint32_t a = base + ring * 10 + k, b = base + ring * 10 + (k + 1) % 10;
      mesh.triangles.push_back({a, b, b + 10});
      mesh.triangles.push_back({a, b + 10, a + 10});
    }
  return mesh;
}

double side_m(std::size_t count) { return kStep_m * std::ceil(std::sqrt(static_cast<double>(count))); }

void write_list(const std::string& path, std::size_t count) {
  using Layout = io::InstanceLayout;
  io::InstanceWriter writer(path, {Layout::Position::float32, Layout::Rotation::yaw, Layout::Scale::uniform});
  const auto rows = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double half = 0.5 * side_m(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double size = 0.8 + 0.5 * uniform(10, k);
    writer.add({{(static_cast<double>(k % rows) + uniform(8, k)) * kStep_m - half,
                 (static_cast<double>(k / rows) + uniform(9, k)) * kStep_m - half, 20.0 * uniform(11, k)},
                io::quaternion_of(2.0 * std::numbers::pi * uniform(12, k), 0.0, 0.0),
                {size, size, size}});
  }
  writer.finish();
}

/// Of all threads of this process.
double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Highest memory of this process so far, pages of mapped files included.
double peak_gib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) / 1048576.0;
  return NAN;
}

/// Rows of rays of a scanner 3 km up, a metre apart, from place to place.
std::vector<math::Ray> rays_over(std::size_t count) {
  std::vector<math::Ray> rays;
  const double side = 0.98 * side_m(count);
  for (std::uint64_t k = 0; k < kRays; ++k) {
    const std::uint64_t row = k / kBatch;
    const math::Point3 to{(uniform(20, row) - 0.5) * side + double(k % kBatch),
                          (uniform(21, row) - 0.5) * side, 0.0};
    const math::Vec3 down = math::normalized({0.1 * (uniform(22, row) - 0.5), 0.05, -1.0});
    rays.push_back({to - down * 3000.0, down});
  }
  return rays;
}

/// Hits that do not lie on the triangle that they name, placed as the list says, within 0.04 mm.
std::size_t wrong_hits(const std::vector<math::Ray>& rays, const std::vector<geometry::SurfacePoint>& hits,
                       const io::InstanceFile& list, const geometry::TriangleMesh& mesh) {
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].hit()) continue;
    const math::Transform map = list.at(hits[k].instance);
    const geometry::Triangle& t = mesh.triangles[hits[k].primitive];
    const math::Point3 a = map(mesh.vertices_m[t[0]]), b = map(mesh.vertices_m[t[1]]),
                       c = map(mesh.vertices_m[t[2]]);
    const math::Vec3 n = math::normalized(math::cross(b - a, c - a));
    const math::Point3 p =
        rays[k].origin_m + rays[k].direction * (dot(n, a - rays[k].origin_m) / dot(n, rays[k].direction));
    if (!(length(p - hits[k].position_m) < 4e-5)) ++wrong;
  }
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "bench_instances FOLDER COUNT [nodes|table]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const auto count = static_cast<std::size_t>(std::strtoull(argv[2], nullptr, 10));
  geometry::BuildOptions options;
  if (argc > 3)
    options.instances =
        argv[3] == std::string("nodes") ? geometry::InstanceStorage::nodes : geometry::InstanceStorage::table;
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "trees.ifovinst").string();
  write_list(path, count);
  const geometry::TriangleMesh mesh = tree();
  const double before_gib = peak_gib();

  const Clock::time_point start = Clock::now();
  const double cpu_before_s = cpu_s();
  const auto list = std::make_shared<io::InstanceFile>(path);
  const double list_s = seconds_since(start);
  geometry::WorldBuilder builder;
  const std::uint32_t leaf = 0;
  builder.place_many(builder.add_shape(mesh), {}, list, {&leaf, 1});
  const std::unique_ptr<geometry::World> world = builder.build(options);
  const double load_s = seconds_since(start), load_cpu_s = cpu_s() - cpu_before_s;
  const double load_gib = peak_gib();

  const std::vector<math::Ray> rays = rays_over(count);
  std::vector<geometry::SurfacePoint> hits(rays.size());
  const Clock::time_point traced = Clock::now();
  for (std::size_t k = 0; k < rays.size(); k += kBatch) {
    const std::size_t n = std::min(kBatch, rays.size() - k);
    world->intersect(std::span(rays).subspan(k, n), std::span(hits).subspan(k, n));
  }
  const double trace_s = seconds_since(traced);
  std::size_t met = 0;
  for (const geometry::SurfacePoint& hit : hits) met += hit.hit();
  std::puts(
      format(
          "{{\"instances\": {}, \"triangles\": {}, \"table\": {}, \"list_s\": {:.2f}, \"load_s\": {:.2f}, "
          "\"load_cpu_s\": {:.2f}, \"peak_gib\": {:.3f}, \"bytes_per_instance\": {:.0f}, \"tables_and_trees_bytes_per_instance\": {:.0f}, "
          "\"rays\": {}, \"met\": {}, \"wrong\": {}, \"mrays_per_s\": {:.3f}}}",
          world->object_count(), world->triangle_count(), world->storage().instance_table, list_s, load_s,
          load_cpu_s, load_gib, (load_gib - before_gib) * 1073741824.0 / static_cast<double>(count),
          static_cast<double>(world->storage().bytes) / static_cast<double>(count), rays.size(), met,
          wrong_hits(rays, hits, *list, mesh), 1e-6 * static_cast<double>(rays.size()) / trace_s)
          .c_str());
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return 0;
}
