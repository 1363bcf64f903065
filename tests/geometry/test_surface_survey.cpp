#include <gtest/gtest.h>

#include <cmath>

#include "geometry/world/surface_survey.h"
#include "geometry/world/world_builder.h"

namespace ifov::geometry::test_surface_survey {
namespace {

using math::Point3;
using math::Transform;

class Survey : public testing::Test {
 protected:
  void place(Shape shape, std::uint32_t material, const Transform& transform = {}) {
    const ShapeId id = builder_.add_shape(std::move(shape));
    const std::vector<std::uint32_t> materials(builder_.slot_count(id), material);
    builder_.place(id, transform, materials);
  }
  /// Of material 1.
  const SurfaceSurvey& survey() {
    BuildOptions options{.threads = 1};
    options.surveyed = {false, true};
    world_ = builder_.build(options);
    return *world_->survey();
  }
  WorldBuilder builder_;
  std::unique_ptr<World> world_;
};

TriangleMesh tent(bool smooth) {
  TriangleMesh mesh;
  mesh.vertices_m = {{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 2.0, 1.0}};
  mesh.triangles = {{0, 2, 3}, {1, 3, 2}};
  if (smooth) mesh.normals = {{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}};
  return mesh;
}

TEST_F(Survey, ListsFacesOfChosenMaterialsByNormal) {
  place(Plane{}, 0);
  place(Box{{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}}, 1);
  place(Box{{5.0, 0.0, 0.0}, {6.0, 2.0, 3.0}}, 1);
  place(Disk{{0.0, 0.0, 9.0}, 1.0}, 1);
  const SurfaceSurvey& found = survey();
  // Opposite faces are one normal, and the disc's is that of tops and bottoms.
  ASSERT_EQ(found.flats.size(), 3u);
  double area = 0.0;
  for (const auto& flat : found.flats) {
    area += flat.area_m2;
    if (std::abs(flat.normal.z) < 0.5) continue;
    EXPECT_NEAR(std::abs(flat.high_m - flat.low_m), 9.0, 1e-9);
    EXPECT_NEAR(flat.bounds.high_m.x, 6.0, 1e-9);
    EXPECT_NEAR(flat.bounds.low_m.x, -1.0, 1e-9);
  }
  EXPECT_NEAR(area, 2.0 * 22.0 + 4.0, 1e-9);
  EXPECT_TRUE(found.rounds.empty());
  EXPECT_TRUE(found.balls.empty());
}

TEST_F(Survey, TurnedCopiesHaveTheirOwnNormals) {
  const ShapeId part = builder_.add_shape(Box{{-1.0, -1.0, 0.0}, {1.0, 1.0, 1.0}});
  const Part parts[] = {{part, Transform{}, {}}};
  const ShapeId whole = builder_.add_prototype(parts);
  const std::vector<std::uint32_t> material{1};
  for (int k = 0; k < 9; ++k)
    builder_.place(
        whole,
        Transform::translation({4.0 * k, 0.0, 0.0}) * Transform::rotation({0.0, 0.0, 1.0}, 0.1 * (k % 3)),
        material);
  // Tops, and two sides for each of three directions.
  EXPECT_EQ(survey().flats.size(), 7u);
}

TEST_F(Survey, RoundAndSmoothSurfacesStandApart) {
  place(Cylinder{{0.0, 0.0, 0.0}, 1.0, 2.0, true}, 1);
  place(Sphere{{5.0, 0.0, 0.0}, 1.0}, 1);
  place(Sphere{{9.0, 0.0, 0.0}, 1.0}, 0);
  place(tent(true), 1);
  place(tent(false), 1, Transform::translation({0.0, 0.0, 5.0}));
  const SurfaceSurvey& found = survey();
  EXPECT_EQ(found.rounds.size(), 2u);
  ASSERT_EQ(found.smooths.size(), 1u);
  EXPECT_EQ(found.smooths[0].triangles.size(), 2u);
  EXPECT_EQ(found.flats.size(), 3u);  // the can's ends and the two sides of the tent without normals
  EXPECT_EQ(found.balls.size(), 1u);  // about the smooth tent
  EXPECT_NEAR(found.rounds[1].ball.centre_m.x, 5.0, 1e-12);
  EXPECT_GE(found.rounds[1].ball.radius_m, 1.0);
}

TEST_F(Survey, NormalsThatAreAllAlikeMakeAFace) {
  TriangleMesh mesh = tent(false);
  mesh.triangles.resize(1);
  mesh.normals.assign(4, {-0.6, 0.0, 0.8});
  place(std::move(mesh), 1);
  const SurfaceSurvey& found = survey();
  ASSERT_EQ(found.flats.size(), 1u);
  EXPECT_NEAR(std::abs(dot(found.flats[0].normal, math::Vec3{-0.6, 0.0, 0.8})), 1.0, 1e-12);
  EXPECT_TRUE(found.smooths.empty());
}

TEST_F(Survey, NothingIsListedUnasked) {
  place(Plane{}, 0);
  world_ = builder_.build(1);
  EXPECT_EQ(world_->survey(), nullptr);
}

TEST_F(Survey, HitsSayHowTheyBend) {
  place(Cylinder{{0.0, 0.0, 0.0}, 1.0, 2.0, true}, 1);
  place(tent(true), 1, Transform::translation({5.0, 0.0, 0.0}));
  survey();
  const math::Ray rays[] = {{{0.0, 0.0, 9.0}, {0.0, 0.0, -1.0}},
                            {{-9.0, 0.0, 1.0}, {1.0, 0.0, 0.0}},
                            {{4.8, 0.5, 9.0}, {0.0, 0.0, -1.0}}};
  SurfacePoint hits[3];
  world_->intersect(rays, hits);
  EXPECT_EQ(hits[0].bend, Bend::none);
  EXPECT_EQ(hits[1].bend, Bend::round);
  EXPECT_EQ(hits[2].bend, Bend::smooth);
}

}  // namespace
}  // namespace ifov::geometry::test_surface_survey
