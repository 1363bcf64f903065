#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "geometry/world/prototype_plan.h"
#include "geometry/world/world_builder.h"
#include "scene_maker.h"

namespace ifov::geometry::test_nested_instances {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;
using Slots = std::vector<std::uint32_t>;

/// A list of placings by a function of the index.
class Listed final : public Placements {
 public:
  explicit Listed(std::vector<Transform> all) : all_(std::move(all)) {}
  std::size_t count() const override { return all_.size(); }
  Transform at(std::size_t index) const override { return all_[index]; }

 private:
  std::vector<Transform> all_;
};

std::shared_ptr<const Placements> ring(int count, double radius_m, double height_m, std::uint64_t key) {
  std::vector<Transform> all;
  for (int k = 0; k < count; ++k) {
    const double size = 0.7 + 0.6 * test::uniform(key, static_cast<std::uint64_t>(k));
    all.push_back(Transform::rotation({0, 0, 1}, 2.0 * std::numbers::pi * k / count) *
                  Transform::translation({radius_m, 0, height_m}) *
                  Transform::rotation(test::direction(key + 1, static_cast<std::uint64_t>(k)), 0.8) *
                  Transform::scaling({size, size, 0.9 * size}));
  }
  return std::make_shared<Listed>(std::move(all));
}

TriangleMesh leaf() {
  TriangleMesh mesh;
  mesh.vertices_m = {{-0.1, -0.05, 0}, {0.1, -0.05, 0}, {0.1, 0.05, 0}, {-0.1, 0.05, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return mesh;
}

/// Trees of branches of leaves with a ball each, placed from a list: three levels.
struct Grove {
  WorldBuilder builder;
  ShapeId leaf_id, ball_id, branch, tree;
  Grove() {
    leaf_id = builder.add_shape(leaf());
    ball_id = builder.add_shape(Sphere{{}, 0.15});
    branch = builder.add_prototype(std::vector<Part>{{leaf_id, {}, {0}, ring(6, 0.5, 0.3, 5)},
                                                     {ball_id, Transform::translation({0, 0, 0.8}), {1}}});
    tree = builder.add_prototype(std::vector<Part>{{branch, {}, {0, 1}, ring(5, 1.5, 2.0, 9)},
                                                   {ball_id, Transform::scaling({3, 3, 3}), {2}}});
  }
  std::unique_ptr<World> built(InstanceStorage storage) {
    std::vector<Transform> places;
    for (int k = 0; k < 12; ++k)
      places.push_back(Transform::translation({4.0 * (k % 4), 4.0 * (k / 4), 0.1 * k}) *
                       Transform::rotation({0, 0, 1}, 0.5 * k));
    EXPECT_EQ(builder.place_many(tree, Transform::translation({4e5, 5e6, 100}),
                                 std::make_shared<Listed>(std::move(places)), Slots{7, 8, 9}),
              0u);
    return builder.build({1, storage});
  }
};

/// What random rays over the grove meet.
std::vector<SurfacePoint> hits(const World& world, std::size_t count) {
  const World::Bounds b = world.bounds();
  std::vector<Ray> rays(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec3 size = b.high_m - b.low_m;
    const Point3 to = b.low_m + Vec3{test::uniform(31, 3 * i) * size.x, test::uniform(31, 3 * i + 1) * size.y,
                                     test::uniform(31, 3 * i + 2) * size.z};
    const Vec3 d = test::direction(32, i);
    rays[i] = {to - d * 3000.0, d};
  }
  std::vector<SurfacePoint> found(count);
  world.intersect(rays, found);
  std::vector<std::uint8_t> blocked(count);
  world.occluded(rays, blocked);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(blocked[i] != 0, found[i].hit()) << i;
  return found;
}

/// The smallest differences that two ways of keeping the same scene may show.
void expect_same(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b,
                 std::size_t least_met) {
  std::size_t met = 0, other = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    // At an edge of a triangle one float may say it is met and another that it is not.
    if (a[i].hit() != b[i].hit() || a[i].primitive != b[i].primitive || a[i].instance != b[i].instance) {
      ++other;
      continue;
    }
    if (!a[i].hit()) continue;
    ++met;
    ASSERT_LT(length(a[i].position_m - b[i].position_m), 1e-8);
    ASSERT_EQ(a[i].patch, b[i].patch);
    ASSERT_EQ(a[i].material, b[i].material);
    ASSERT_EQ(a[i].front, b[i].front);
    ASSERT_NEAR(a[i].u, b[i].u, 1e-7);
    ASSERT_NEAR(a[i].v, b[i].v, 1e-7);
    ASSERT_GT(dot(a[i].geometric_normal, b[i].geometric_normal.as_vector()), 1.0 - 1e-12);
  }
  EXPECT_GT(met, least_met);
  EXPECT_LE(other, a.size() / 1000);
}

/// The same grove with every leaf and ball placed by hand in one prototype for each tree.
std::unique_ptr<World> by_hand() {
  WorldBuilder builder;
  const ShapeId leaf_id = builder.add_shape(leaf()), ball_id = builder.add_shape(Sphere{{}, 0.15});
  std::vector<Part> parts;
  const auto branches = ring(5, 1.5, 2.0, 9), leaves = ring(6, 0.5, 0.3, 5);
  for (std::size_t k = 0; k < 5; ++k) {
    for (std::size_t j = 0; j < 6; ++j) parts.push_back({leaf_id, branches->at(k) * leaves->at(j), {0}});
    parts.push_back({ball_id, branches->at(k) * Transform::translation({0, 0, 0.8}), {1}});
  }
  parts.push_back({ball_id, Transform::scaling({3, 3, 3}), {2}});
  const ShapeId tree = builder.add_prototype(parts);
  for (int k = 0; k < 12; ++k)
    builder.place(tree,
                  Transform::translation({4e5, 5e6, 100}) *
                      Transform::translation({4.0 * (k % 4), 4.0 * (k / 4), 0.1 * k}) *
                      Transform::rotation({0, 0, 1}, 0.5 * k),
                  Slots{7, 8, 9});
  return builder.build(1);
}

TEST(NestedInstances, AreWhatIsPlacedByHand) {
  const auto nested = Grove().built(InstanceStorage::nodes), plain = by_hand();
  EXPECT_EQ(nested->object_count(), 12u);
  EXPECT_EQ(nested->triangle_count(), 12u * 5 * 6 * 2);
  expect_same(hits(*nested, 40000), hits(*plain, 40000), 2000);
  for (std::size_t k = 0; k < 12; ++k) {
    const auto a = nested->object(k), b = plain->object(k);
    EXPECT_LT(length(a.centre_m - b.centre_m), 1e-8);
    EXPECT_LT(length(a.pilot_point_m - b.pilot_point_m), 1e-8);
    EXPECT_NEAR(a.radius_m, b.radius_m, 1e-9);
  }
}

TEST(NestedInstances, ATableGivesTheSameHitsAsNodes) {
  const auto nodes = Grove().built(InstanceStorage::nodes), table = Grove().built(InstanceStorage::table);
  EXPECT_FALSE(nodes->storage().instance_table);
  EXPECT_TRUE(table->storage().instance_table);
  EXPECT_EQ(table->storage().instances, 12u);
  expect_same(hits(*nodes, 40000), hits(*table, 40000), 2000);
}

TEST(NestedInstances, HitsOfATableAreExact) {
  // A ball of triangles under a general transform, far from the origin: planes of triangles are met within
  // rounding in double.
  WorldBuilder builder;
  const ShapeId id = builder.add_shape(test::ball(10, 12, 1.0));
  const Transform map = Transform::translation({500000.0, 4e6, 20.0}) *
                        Transform::rotation({1.0, 2.0, 3.0}, 1.1) * Transform::scaling({2.0, 2.0, 2.0});
  builder.place(id, map, Slots{1});
  builder.place(id, Transform::translation({500900.0, 4e6, 20.0}), Slots{1});
  const auto world = builder.build({1, InstanceStorage::table});
  const TriangleMesh mesh = test::ball(10, 12, 1.0);
  int met = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vec3 d = test::direction(61, i);
    const Point3 from = Point3{500000.0, 4e6, 20.0} + test::direction(62, i) * 1.2 - d * 1000.0;
    std::array<SurfacePoint, 1> hit;
    world->intersect(std::array{Ray{from, d}}, hit);
    if (!hit[0].hit() || hit[0].instance != 0) continue;
    ++met;
    const Triangle& t = mesh.triangles[hit[0].primitive];
    const Point3 a = map(mesh.vertices_m[t[0]]), b = map(mesh.vertices_m[t[1]]),
                 c = map(mesh.vertices_m[t[2]]);
    const Vec3 n = math::normalized(cross(b - a, c - a));
    EXPECT_LT(std::abs(dot(n, hit[0].position_m - a)), 2e-9);
  }
  EXPECT_GT(met, 1000);
}

/// A list of so many copies that joining them would take more memory than placing them one by one.
class Wide final : public Placements {
 public:
  std::size_t count() const override { return 4000; }
  Transform at(std::size_t k) const override {
    return Transform::translation(
        {3.0 * static_cast<double>(k % 80), 3.0 * static_cast<double>(k / 80), 0.0});
  }
};

TEST(NestedInstances, LargePrototypesStandApartAndLookTheSame) {
  const auto build = [](bool nested) {
    WorldBuilder builder;
    const ShapeId ball = builder.add_shape(test::ball(10, 12, 1.0)),
                  post = builder.add_shape(Box{{-.1, -.1, 0}, {.1, .1, 2}});
    const ShapeId plant = builder.add_prototype(
        std::vector<Part>{{ball, Transform::translation({0, 0, 2}), {1}}, {post, {}, {0}}});
    const auto list = std::make_shared<Wide>();
    if (nested) {
      const ShapeId field = builder.add_prototype(std::vector<Part>{{plant, {}, {1, 0}, list}});
      builder.place(field, Transform::rotation({0, 0, 1}, 0.2), Slots{5, 6});
      builder.place(field, Transform::translation({300, 0, 0}), Slots{7, 8});
    } else {
      builder.place_many(plant, Transform::rotation({0, 0, 1}, 0.2), list, Slots{6, 5});
      builder.place_many(plant, Transform::translation({300, 0, 0}), list, Slots{8, 7});
    }
    return builder.build(1);
  };
  const auto nested = build(true), plain = build(false);
  EXPECT_EQ(nested->storage().prototypes_apart, 1u);
  EXPECT_EQ(nested->storage().instances, 8000u);
  EXPECT_LT(nested->storage().bytes, 20e6);
  EXPECT_EQ(nested->object_count(), 2u);
  EXPECT_EQ(plain->object_count(), 8000u);
  const std::vector<SurfacePoint> a = hits(*nested, 20000), b = hits(*plain, 20000);
  std::size_t met = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].hit(), b[i].hit());
    if (!a[i].hit()) continue;
    ++met;
    ASSERT_EQ(a[i].material, b[i].material);
    ASSERT_EQ(a[i].instance, b[i].instance / 4000);
    // A plant has one box and one patch of triangles and six of faces; plants of a field are numbered on.
    const std::uint32_t plant = b[i].instance % 4000;
    ASSERT_EQ(a[i].patch, b[i].patch + 7 * plant);
    const bool box = b[i].primitive == 0;
    ASSERT_EQ(a[i].primitive, box ? plant : 4000 + 216 * plant + b[i].primitive - 1);
    ASSERT_LT(length(a[i].position_m - b[i].position_m), 1e-9);
  }
  EXPECT_GT(met, 5000u);
}

TEST(NestedInstances, ThePlanWeighsMemory) {
  // 50,000 leaves in a tree and 10,000 trees: one tree is joined, for 500 million leaves do not fit.
  WorldContent content;
  const auto with_triangles = [](std::size_t count) {
    TriangleMesh mesh;
    mesh.triangles.resize(count);
    Template t;
    t.body.mesh = keep_mesh(std::move(mesh), {});
    t.body.patch_count = 1;
    return t;
  };
  const auto listing = [](std::size_t count) {
    return std::make_shared<Listed>(std::vector<Transform>(count));
  };
  content.templates.push_back(with_triangles(2));
  Template tree, forest;
  tree.parts.push_back({0, {}, listing(50000), {}});
  tree.uses = 10000;
  content.templates.push_back(tree);
  PrototypePlan plan = plan_prototypes(content, contents_of(content));
  EXPECT_TRUE(plan.flat[1]);
  EXPECT_EQ(plan.copies, (std::vector<std::uint64_t>{0, 10000}));

  // A forest of 100,000 such trees, placed 4 times: 400,000 trees, each still joined.
  content.templates[1].uses = 0;
  forest.parts.push_back({1, {}, listing(100000), {}});
  forest.uses = 4;
  content.templates.push_back(forest);
  plan = plan_prototypes(content, contents_of(content));
  EXPECT_EQ(plan.flat, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(plan.copies, (std::vector<std::uint64_t>{0, 400000, 0}));
  EXPECT_EQ(plan.apart, 1u);
}

TEST(NestedInstances, TooManyIsSaid) {
  WorldBuilder builder;
  ShapeId inner = builder.add_shape(leaf());
  for (int level = 0; level < 12; ++level)
    inner = builder.add_prototype(std::vector<Part>{{inner, {}, {0}, std::make_shared<Wide>()}});
  builder.place(inner, {}, Slots{1});
  EXPECT_THROW(builder.build(1), InputError);
}

}  // namespace
}  // namespace ifov::geometry::test_nested_instances
