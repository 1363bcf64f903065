#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "core/error.h"
#include "geometry/terrain_mesh.h"

namespace ifov::geometry::test_terrain_mesh {
namespace {

TerrainGrid grid_of(int columns, int rows, const std::function<double(int, int)>& height) {
  TerrainGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.along_column_m = {2.0, 0.0, 0.0};
  grid.along_row_m = {0.0, -3.0, 0.0};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) grid.height_m.push_back(static_cast<float>(height(c, r)));
  return grid;
}

double hills(int c, int r) {
  return 40.0 * std::sin(0.11 * c) * std::cos(0.07 * r) + 3.0 * std::sin(1.3 * c + r);
}

/// Height of the mesh at a place, found triangle by triangle; NaN where there is none.
double height_at(const TriangleMesh& mesh, double x, double y) {
  for (const Triangle& t : mesh.triangles) {
    const math::Point3 &a = mesh.vertices_m[t[0]], &b = mesh.vertices_m[t[1]], &c = mesh.vertices_m[t[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    const double s = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
    const double t2 = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
    if (s >= -1e-9 && t2 >= -1e-9 && s + t2 <= 1.0 + 1e-9) return a.z + s * (b.z - a.z) + t2 * (c.z - a.z);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += 0.5 * math::cross(mesh.vertices_m[t[1]] - mesh.vertices_m[t[0]],
                              mesh.vertices_m[t[2]] - mesh.vertices_m[t[0]])
                      .z;
  return area;
}

/// Edges that only one triangle has: the rim, and a crack wherever one triangle meets two.
int open_edges(const TriangleMesh& mesh, double width_m, double height_m) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  int open = 0;
  for (const auto& [edge, count] : balance) {
    if (count == 0) continue;
    const math::Point3 &a = mesh.vertices_m[edge.first], &b = mesh.vertices_m[edge.second];
    const bool rim =
        (a.x == b.x && (a.x == 0.0 || a.x == width_m)) || (a.y == b.y && (a.y == 0.0 || a.y == -height_m));
    open += rim ? 0 : 1;
  }
  return open;
}

TEST(TerrainMesh, KeepsTheStatedDetailOnAnySize) {
  for (const auto& [columns, rows] : {std::pair{33, 33}, {40, 27}, {5, 61}, {2, 9}}) {
    const TerrainGrid grid = grid_of(columns, rows, hills);
    for (const double detail_m : {0.0, 0.5, 4.0, 1000.0}) {
      const TerrainMesh terrain = mesh_terrain(grid, detail_m, false);
      double worst = 0.0;
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
          const math::Point3 node = grid.node(c, r);
          const double z = height_at(terrain.mesh, node.x, node.y);
          ASSERT_TRUE(std::isfinite(z)) << c << ", " << r;
          worst = std::max(worst, std::abs(z - node.z));
        }
      EXPECT_LE(worst, detail_m + 1e-9);
      EXPECT_NEAR(worst, terrain.largest_height_error_m, 1e-9);
      EXPECT_NEAR(area_of(terrain.mesh), 2.0 * (columns - 1) * 3.0 * (rows - 1), 1e-6);
      EXPECT_EQ(open_edges(terrain.mesh, 2.0 * (columns - 1), 3.0 * (rows - 1)), 0);
    }
  }
}

TEST(TerrainMesh, ACrackWouldBeSeen) {
  // One triangle beside two on the same line, with all edges in the inside of a larger rim.
  TriangleMesh mesh;
  mesh.vertices_m = {{1, -1, 0}, {3, -1, 0}, {2, -2, 0}, {2, -1, 0}, {1, -0.5, 0}, {3, -0.5, 0}};
  mesh.triangles = {{2, 1, 0}, {0, 3, 4}, {3, 1, 5}};
  EXPECT_GT(open_edges(mesh, 10.0, 10.0), 0);
}

TEST(TerrainMesh, CountsOfTriangles) {
  // A plane needs the fewest triangles that fit the rim; every node, two for each cell.
  const TerrainGrid plane = grid_of(33, 33, [](int c, int r) { return 0.5 * c + 0.25 * r; });
  EXPECT_EQ(mesh_terrain(plane, 0.0, false).mesh.triangles.size(), 2u);
  const TerrainGrid rough = grid_of(33, 17, [](int c, int r) { return c * c + r * r; });
  EXPECT_EQ(mesh_terrain(rough, 0.0, false).mesh.triangles.size(), 2u * 32u * 16u);
}

TEST(TerrainMesh, ASingleStepIsRefinedOnlyThere) {
  const TerrainGrid grid = grid_of(65, 65, [](int c, int r) { return c == 21 && r == 40 ? 10.0 : 0.0; });
  const TerrainMesh terrain = mesh_terrain(grid, 1.0, false);
  EXPECT_LT(terrain.mesh.triangles.size(), 100u);
  EXPECT_NEAR(height_at(terrain.mesh, 42.0, -120.0), 10.0, 1e-9);
  EXPECT_LE(terrain.largest_height_error_m, 1.0);
}

TEST(TerrainMesh, UnknownHeightsAreHoles) {
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  TerrainGrid grid = grid_of(9, 9, [](int, int) { return 5.0; });
  for (int r = 3; r <= 5; ++r)
    for (int c = 2; c <= 4; ++c) grid.height_m[grid.index(c, r)] = unknown;
  const TerrainMesh terrain = mesh_terrain(grid, 2.0, false);
  EXPECT_EQ(terrain.known_nodes, 72u);
  // 4 x 4 cells have an unknown corner; those at the four corners keep the half that does not touch it.
  EXPECT_NEAR(area_of(terrain.mesh), (64.0 - 16.0) * 6.0 + 4 * 3.0, 1e-9);
  EXPECT_TRUE(std::isnan(height_at(terrain.mesh, 2.0 * 3, -3.0 * 4)));
  EXPECT_NEAR(height_at(terrain.mesh, 2.0 * 7, -3.0 * 7), 5.0, 1e-12);
  grid.height_m.assign(grid.height_m.size(), unknown);
  EXPECT_THROW(mesh_terrain(grid, 0.0, false), InputError);
}

TEST(TerrainMesh, IrregularGridsKeepTheirPlacesToo) {
  TerrainGrid grid = grid_of(33, 33, [](int, int) { return 100.0; });
  for (int r = 0; r < 33; ++r)
    for (int c = 0; c < 33; ++c) grid.positions_m.push_back({30.0 * c, -30.0 * r + 0.05 * c * (32 - c)});
  const TerrainMesh coarse = mesh_terrain(grid, 20.0, false), fine = mesh_terrain(grid, 1.0, false);
  EXPECT_EQ(coarse.mesh.triangles.size(), 2u);
  EXPECT_NEAR(coarse.largest_shift_m, 0.05 * 16 * 16, 1e-9);
  EXPECT_GT(fine.mesh.triangles.size(), 2u);
  EXPECT_LE(fine.largest_shift_m, 1.0);
}

TEST(TerrainMesh, SmoothNormalsAreThoseOfTheSlope) {
  const TerrainGrid grid =
      grid_of(9, 9, [](int c, int r) { return 1.0 * c - 0.6 * r; });  // 0.5 per m east, 0.2 north
  const TerrainMesh terrain = mesh_terrain(grid, 0.0, true);
  ASSERT_EQ(terrain.mesh.normals.size(), terrain.mesh.vertices_m.size());
  const math::Vec3 expected = math::normalized({-0.5, -0.2, 1.0});
  for (const math::Normal3& normal : terrain.mesh.normals)
    EXPECT_NEAR(math::length(normal.as_vector() - expected), 0.0, 1e-6);
}

}  // namespace
}  // namespace ifov::geometry::test_terrain_mesh
