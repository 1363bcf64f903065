#include <gtest/gtest.h>

#include "geometry/mesh_topology.h"
#include "scene_maker.h"

namespace ifov::geometry::test_mesh_topology {
namespace {

/// Twelve triangles of a cube; each face has its own four vertices at the positions of its neighbours'.
TriangleMesh cube() {
  TriangleMesh mesh;
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const int corner : face)
      mesh.vertices_m.push_back({double(corner & 1), double(corner >> 1 & 1), double(corner >> 2 & 1)});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

/// Two rectangles that share an edge, the second one bent up by `angle_deg`.
MeshTopology folded(double angle_deg, bool second_wound_alike = true) {
  const double a = angle_deg * 3.141592653589793 / 180.0;
  const std::vector<math::Point3> v{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {std::cos(a), 0, std::sin(a)}};
  return topology_of(
      v, std::vector<Triangle>{{0, 1, 2}, second_wound_alike ? Triangle{0, 3, 1} : Triangle{0, 1, 3}});
}

TEST(MeshTopology, CubeHasSixPatchesAndIsClosed) {
  const TriangleMesh mesh = cube();
  const MeshTopology topology = topology_of(mesh.vertices_m, mesh.triangles);
  EXPECT_EQ(topology.patch_count, 6u);
  EXPECT_TRUE(topology.closed);
  EXPECT_FALSE(topology.loose);
  for (std::uint32_t t = 0; t < 12; ++t) EXPECT_EQ(topology.patches[t], t / 2);
}

TEST(MeshTopology, RoundThingsAreOnePatch) {
  const TriangleMesh mesh = test::ball(24, 40, 1.0);
  const MeshTopology topology = topology_of(mesh.vertices_m, mesh.triangles);
  EXPECT_EQ(topology.patch_count, 1u);
  EXPECT_TRUE(topology.closed);
  TriangleMesh open = mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(topology_of(open.vertices_m, open.triangles).closed);
}

TEST(MeshTopology, CreaseBeginsAtThirtyDegrees) {
  EXPECT_EQ(folded(29.0).patch_count, 1u);
  EXPECT_EQ(folded(31.0).patch_count, 2u);
  EXPECT_EQ(folded(-29.0).patch_count, 1u);
  EXPECT_EQ(folded(-31.0).patch_count, 2u);
  EXPECT_EQ(folded(10.0, false).patch_count, 1u);  // wound against each other, yet smooth
  EXPECT_EQ(folded(170.0, false).patch_count, 2u);
}

TEST(MeshTopology, LeavesAreLoose) {
  TriangleMesh leaves;
  for (std::uint64_t k = 0; k < 100; ++k) {
    const auto first = static_cast<std::uint32_t>(leaves.vertices_m.size());
    const math::Point3 at{double(k), 0, 0};
    for (const math::Vec3 d : {math::Vec3{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}})
      leaves.vertices_m.push_back(at + d);
    leaves.triangles.push_back({first, first + 1, first + 2});
    leaves.triangles.push_back({first, first + 2, first + 3});
  }
  EXPECT_TRUE(topology_of(leaves.vertices_m, leaves.triangles).loose);
  EXPECT_EQ(topology_of(leaves.vertices_m, leaves.triangles).patch_count, 100u);
}

TEST(MeshTopology, TrianglesWithoutAreaAreHarmless) {
  const std::vector<math::Point3> v{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  const MeshTopology topology = topology_of(v, std::vector<Triangle>{{0, 1, 2}, {0, 0, 1}, {0, 1, 3}});
  EXPECT_EQ(topology.patches.size(), 3u);
  EXPECT_FALSE(topology.closed);
}

}  // namespace
}  // namespace ifov::geometry::test_mesh_topology
