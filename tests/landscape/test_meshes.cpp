#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "landscape/buildings/house.h"
#include "landscape/plants/tree.h"
#include "landscape/shapes/mesh_builder.h"
#include "landscape/things/car.h"
#include "landscape/things/court.h"
#include "landscape/things/harbour_things.h"

namespace ifov::landscape::test_meshes {
namespace {

struct Bounds {
  Point3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  Vec3 size() const { return high - low; }
};

/// Of the triangles of one slot, or of all.
Bounds bounds_of(const geometry::TriangleMesh& mesh, const std::string& slot = "") {
  Bounds b;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!slot.empty() && mesh.slot_names[mesh.slots[t]] != slot) continue;
    for (const std::uint32_t k : mesh.triangles[t]) {
      const Point3 p = mesh.vertices_m[k];
      b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
      b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
    }
  }
  return b;
}

/// Six times the volume within the triangles of a closed mesh.
double volume_m3(const geometry::TriangleMesh& mesh) {
  double sum = 0.0;
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]] - Point3{}, b = mesh.vertices_m[t[1]] - Point3{},
               c = mesh.vertices_m[t[2]] - Point3{};
    sum += math::dot(a, math::cross(b, c));
  }
  return sum / 6.0;
}

TEST(MeshBuilder, ClosedShapesFaceOutwards) {
  MeshBuilder box;
  box.slot("a");
  box.box({-1.0, -2.0, 0.0}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(volume_m3(box.take()), 24.0, 1e-9);
  MeshBuilder tube;
  tube.slot("a");
  tube.tube({0.0, 0.0, 0.0}, {0.0, 3.0, 4.0}, 0.5, 96);
  EXPECT_NEAR(volume_m3(tube.take()), M_PI * 0.25 * 5.0, 0.01);
  MeshBuilder slab;
  slab.slot("a");
  const std::vector<std::vector<Point3>> faces{{{0, 0, 1}, {2, 0, 1}, {2, 1, 2}, {0, 1, 2}},
                                               {{2, 2, 1}, {0, 2, 1}, {0, 1, 2}, {2, 1, 2}}};
  slab.slab(faces, 0.25);
  EXPECT_NEAR(volume_m3(slab.take()), 2.0 * 2.0 * 0.25, 1e-9);
}

TEST(Court, FollowsTheRulesOfTennis) {
  const geometry::TriangleMesh mesh = court_mesh();
  Bounds lines;
  std::set<double> widths;
  for (std::size_t t = 0; t + 1 < mesh.triangles.size(); ++t) {
    if (mesh.slot_names[mesh.slots[t]] != "line") continue;
    Bounds own;
    for (const std::uint32_t k : mesh.triangles[t]) {
      const Point3 p = mesh.vertices_m[k];
      if (p.z > 0.05) own.low.z = -1.0;  // the net's band
      own.low = {std::min(own.low.x, p.x), std::min(own.low.y, p.y), own.low.z};
      own.high = {std::max(own.high.x, p.x), std::max(own.high.y, p.y), own.high.z};
    }
    if (own.low.z < 0.0) continue;
    lines.low = {std::min(lines.low.x, own.low.x), std::min(lines.low.y, own.low.y), 0.0};
    lines.high = {std::max(lines.high.x, own.high.x), std::max(lines.high.y, own.high.y), 0.0};
    widths.insert(std::round(1e4 * std::min(own.high.x - own.low.x, own.high.y - own.low.y)) / 1e4);
  }
  EXPECT_NEAR(lines.size().x, 23.77, 1e-9);
  EXPECT_NEAR(lines.size().y, 10.97, 1e-9);
  EXPECT_EQ(widths, std::set<double>{0.05});
  const Bounds net = bounds_of(mesh, "net");
  EXPECT_NEAR(net.size().y, 10.97 + 2.0 * 0.914, 0.06);
  EXPECT_LT(net.high.z, 1.07 + 0.03);
}

TEST(House, StandsOnItsGroundAndWithinItsFootprint) {
  for (int k = 0; k < 40; ++k) {
    const HousePlan plan = draw_house(RandomStream(static_cast<std::uint64_t>(k) + 1));
    const geometry::TriangleMesh mesh = house_mesh(plan);
    const Bounds all = bounds_of(mesh), roof = bounds_of(mesh, "roof");
    const Footprint footprint = plan.footprint({});
    EXPECT_GE(all.low.z, 0.0);
    EXPECT_GE(all.low.x, footprint.x0 - 1e-9);
    EXPECT_LE(all.high.x, footprint.x1 + 1e-9);
    EXPECT_GE(all.low.y, footprint.y0 - 1e-9);
    EXPECT_LE(all.high.y, footprint.y1 + 1e-9);
    EXPECT_NEAR(roof.high.z, plan.ridge_height(), 1e-9);
    // A garage's roof stays below the main ridge, and eaves above doors.
    EXPECT_LT(plan.slope * 0.5 * plan.garage_width, plan.slope * 0.5 * plan.depth);
    EXPECT_GT(roof.low.z, 1.9);
    for (const char* slot : {"wall", "window", "door", "garage door", "trim"})
      EXPECT_LT(bounds_of(mesh, slot).high.z, roof.high.z) << slot;
  }
}

TEST(Car, StandsOnItsWheels) {
  for (int k = 0; k < kCarKinds; ++k) {
    const geometry::TriangleMesh mesh = car_mesh(static_cast<CarKind>(k));
    const Bounds all = bounds_of(mesh);
    EXPECT_NEAR(all.low.z, 0.0, 1e-9);
    EXPECT_NEAR(bounds_of(mesh, "tyre").low.z, 0.0, 1e-9);
    EXPECT_GT(all.size().x, 4.2);
    EXPECT_LT(all.size().x, 5.0);
    EXPECT_LT(all.size().y, 2.0);
    EXPECT_GT(bounds_of(mesh, "glass").low.z, 0.9);
  }
}

TEST(Harbour, ContainersAreTwentyFeet) {
  const Vec3 size = bounds_of(container_mesh()).size();
  EXPECT_NEAR(size.x, 6.06, 1e-9);
  EXPECT_NEAR(size.y, 2.44, 1e-9);
  EXPECT_NEAR(size.z, 2.59, 1e-9);
}

TEST(Trees, HaveTheLeavesTheyShould) {
  ASSERT_GE(tree_species().size(), 3u);
  for (const Species& species : tree_species()) {
    const Tree tree = grow_tree(species, 5), other = grow_tree(species, 6);
    EXPECT_GE(tree.leaf_count, 20000) << species.name;
    EXPECT_LE(tree.leaf_count, 100000) << species.name;
    EXPECT_EQ(tree.leaves.triangles.size(), 2 * static_cast<std::size_t>(tree.leaf_count));
    EXPECT_NE(tree.leaves.vertices_m, other.leaves.vertices_m) << "individuals differ";
    EXPECT_EQ(tree.leaves.vertices_m, grow_tree(species, 5).leaves.vertices_m) << "and can be grown again";
    EXPECT_NEAR(tree.height_m, species.height_m, 0.25 * species.height_m) << species.name;
    EXPECT_GT(bounds_of(tree.leaves).low.z, 0.1) << species.name;
    EXPECT_LT(tree.crown_radius_m, 1.5 * species.crown_radius_m) << species.name;
  }
}

/// Every leaf is at most a shoot's length from wood.
TEST(Trees, LeavesHangOnWood) {
  const Tree tree = grow_tree(tree_species()[0], 5);
  constexpr double kCell = 0.25;
  std::set<std::tuple<int, int, int>> wood;
  const auto cell = [&](Point3 p) {
    return std::tuple(static_cast<int>(std::floor(p.x / kCell)), static_cast<int>(std::floor(p.y / kCell)),
                      static_cast<int>(std::floor(p.z / kCell)));
  };
  for (const Point3& p : tree.wood.vertices_m) wood.insert(cell(p));
  std::size_t floating = 0;
  for (std::size_t k = 0; k < tree.leaves.vertices_m.size(); k += 4) {
    const auto [x, y, z] = cell(tree.leaves.vertices_m[k]);
    bool near = false;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) near = near || wood.contains({x + dx, y + dy, z + dz});
    floating += !near;
  }
  EXPECT_EQ(floating, 0u);
}

}  // namespace
}  // namespace ifov::landscape::test_meshes
