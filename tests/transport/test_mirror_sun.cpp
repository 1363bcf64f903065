// Sunlight by way of flat mirrors, against closed forms and against paths that find it by chance.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf/mirror.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_mirror_sun {
namespace {

using test::SmallScene;

constexpr double kGround = 0.4, kMirror = 0.8, kIrradiance = 1000.0, kHalfAngle = 0.00465;
const auto kMirrorKind = materials::Mirror::shared();

/// A rectangle in a plane of constant x, seen from both sides.
geometry::Polygon wall(double x, double y0, double y1, double height) {
  return {{{x, y0, 0.0}, {x, y1, 0.0}, {x, y1, height}, {x, y0, height}}};
}

math::Ray down_on(double x, double y) { return {{x, y, 0.5}, {0.0, 0.0, -1.0}}; }

SmallScene::Estimate before_facade(math::Ray ray, double plate_at_m, double half_angle,
                                   transport::TransportOptions options = {}, std::uint32_t paths = 512) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  scene.place(wall(0.0, -5.0, 5.0, 10.0), scene.material(kMirror, 0.0, kMirrorKind));
  // A small plate high above hides the mirror from the Sun.
  if (plate_at_m > 0.0)
    scene.place(geometry::Box{{plate_at_m - 1.0, -2.0, 20.0}, {plate_at_m + 1.0, 2.0, 20.1}},
                scene.material(0.0));
  scene.sun({1.0, 0.0, 2.0}, kIrradiance, half_angle);
  scene.build();
  return scene.radiance(ray, paths, 1, options);
}

double direct() { return kGround * kIrradiance * (2.0 / std::sqrt(5.0)) / std::numbers::pi; }

TEST(MirrorSun, FacadeLightsTheGroundBeforeIt) {
  for (const double half_angle : {kHalfAngle, 0.0}) {
    const auto lit = before_facade(down_on(2.0, 0.0), 0.0, half_angle);
    EXPECT_NEAR(lit.mean, direct() * (1.0 + kMirror), 1e-4 * lit.mean);
    EXPECT_LT(lit.standard_error, 1e-6 * lit.mean);
    // The mirror is 10 m tall: its light ends 5 m before it.
    const auto beyond = before_facade(down_on(5.2, 0.0), 0.0, half_angle);
    EXPECT_NEAR(beyond.mean, direct(), 1e-4 * direct());
    const auto beside = before_facade(down_on(2.0, 5.2), 0.0, half_angle);
    EXPECT_NEAR(beside.mean, direct(), 1e-4 * direct());
  }
}

// Images of the Sun in flat mirrors are known; chance looks for it in what bends, an egg.
TEST(MirrorSun, RandomPathsAreLeftToWhatHasNoImage) {
  for (const bool egg : {false, true}) {
    SmallScene scene;
    scene.place(wall(0.0, -5.0, 5.0, 10.0), scene.material(kMirror, 0.0, kMirrorKind));
    if (egg)
      scene.place(geometry::Sphere{{}, 0.5}, scene.material(kMirror, 0.0, kMirrorKind),
                  math::Transform::translation({3.0, 0.0, 1.0}) * math::Transform::scaling({1.0, 1.0, 1.4}));
    scene.sun({1.0, 0.0, 2.0}, kIrradiance, kHalfAngle);
    EXPECT_EQ(scene.build().sun_mirrors()->groups().size(), egg ? 1u : 0u);
  }
}

TEST(MirrorSun, BothLegsMustBeFree) {
  // Light for the ground at x = 2 meets the mirror at 4 m, and 20 m above the ground it is at x = 8.
  const auto hidden = before_facade(down_on(2.0, 0.0), 8.0, kHalfAngle);
  EXPECT_NEAR(hidden.mean, direct(), 1e-4 * direct());
  // Without the second leg's shadow it would be as bright as with the plate elsewhere.
  const auto free = before_facade(down_on(2.0, 0.0), 14.0, kHalfAngle);
  EXPECT_GT(free.mean - hidden.mean, 0.5 * direct());
}

/// Between two walls of mirrors; sunlight over the right one, 4 m tall, reaches the ground after one and two
/// reflections and not directly.
SmallScene::Estimate in_canyon(int reflections) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind);
  scene.place(wall(0.0, -50.0, 50.0, 12.0), mirror);
  scene.place(wall(2.0, -50.0, 50.0, 4.0), mirror);
  scene.sun({0.5, 0.0, std::sqrt(0.75)}, kIrradiance, kHalfAngle);
  scene.build();
  transport::TransportOptions options;
  options.mirror_reflections = reflections;
  return scene.radiance({{1.0, 0.0, 0.5}, {0.0, 0.0, -1.0}}, 512, 1, options);
}

TEST(MirrorSun, SeveralReflections) {
  const double unit = kGround * kIrradiance * std::sqrt(0.75) / std::numbers::pi;
  EXPECT_NEAR(in_canyon(2).mean, unit * (kMirror + kMirror * kMirror), 1e-4 * unit);
  EXPECT_NEAR(in_canyon(3).mean, unit * (kMirror + kMirror * kMirror), 1e-4 * unit);
  // One is not enough.
  EXPECT_GT(std::abs(in_canyon(1).mean - unit * (kMirror + kMirror * kMirror)), 0.3 * unit);
}

TEST(MirrorSun, DepthLimitCountsMirrors) {
  transport::TransportOptions once;
  once.maximum_scatterings = 1;
  EXPECT_NEAR(before_facade(down_on(2.0, 0.0), 0.0, kHalfAngle, once).mean, direct(), 1e-4 * direct());
  once.maximum_scatterings = 2;
  EXPECT_NEAR(before_facade(down_on(2.0, 0.0), 0.0, kHalfAngle, once).mean, direct() * (1.0 + kMirror),
              1e-4 * direct());
}

/// A tilted mirror, a wall that its light falls on, and a leaf, under a Sun so wide that paths find it by chance.
SmallScene::Estimate wide_sun(int reflections, std::uint32_t paths, math::Ray ray) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind);
  scene.place(wall(0.0, -3.0, 3.0, 3.0), mirror);
  scene.place(
      geometry::Disk{{0.0, 0.0, 0.0}, 1.5}, mirror,
      math::Transform::translation({3.5, 0.0, 1.0}) * math::Transform::rotation({0.0, 1.0, 0.0}, -1.1));
  scene.place(geometry::Disk{{0.0, 0.0, 0.0}, 0.5}, scene.leaf(0.3, 0.4),
              math::Transform::translation({1.8, 0.0, 1.2}));
  scene.sun({0.5, 0.1, 1.0}, kIrradiance, 0.4);
  scene.sky(30.0);
  scene.build();
  transport::TransportOptions options;
  options.mirror_reflections = reflections;
  return scene.radiance(ray, paths, 7, options);
}

TEST(MirrorSun, NothingIsCountedTwice) {
  for (const math::Ray& ray :
       {down_on(1.0, 0.5), down_on(2.6, 0.0), math::Ray{{1.8, 0.1, 5.0}, {0.0, 0.0, -1.0}},
        math::Ray{{1.0, 0.0, 0.4}, math::normalized({-1.0, 0.2, -0.1})}}) {
    const auto at_random = wide_sun(0, 1 << 17, ray), sought = wide_sun(2, 1 << 15, ray);
    const double error = std::hypot(at_random.standard_error, sought.standard_error);
    EXPECT_NEAR(sought.mean, at_random.mean, 4.0 * error + 1e-6 * sought.mean);
    EXPECT_LT(error, 0.01 * sought.mean);
  }
}

TEST(MirrorSun, PlantedFaultMirrorsLeftOutOrTwiceFail) {
  // Half of the light at this point comes by way of mirrors, so that neither could pass.
  const auto with = wide_sun(2, 1 << 14, down_on(1.0, 0.5));
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  scene.sun({0.5, 0.1, 1.0}, kIrradiance, 0.4);
  scene.sky(30.0);
  scene.build();
  const auto without = scene.radiance(down_on(1.0, 0.5), 1 << 14);
  EXPECT_GT(with.mean - without.mean, 0.1 * with.mean);
}

TEST(MirrorSun, ManyPanesOfOneNormalAreOneImage) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind);
  for (int k = 0; k < 40; ++k) scene.place(wall(0.0, -10.0 + 0.5 * k, -9.6 + 0.5 * k, 10.0), mirror);
  scene.sun({1.0, 0.0, 2.0}, kIrradiance, 0.0);
  const transport::SpectralScene& spectral = scene.build();
  ASSERT_NE(spectral.sun_mirrors(), nullptr);
  EXPECT_EQ(spectral.sun_mirrors()->facings().size(), 1u);
  const double through = scene.radiance(down_on(2.0, 0.2), 64).mean,
               between = scene.radiance(down_on(2.0, 0.45), 64).mean;
  EXPECT_NEAR(through, direct() * (1.0 + kMirror), 1e-4 * through);
  EXPECT_NEAR(between, direct(), 1e-4 * between);
}

TEST(MirrorSun, FacesOfManyNormalsArePickedAtRandom) {
  // Facets about a point, each sending the Sun to it: more images than rays. By chance or one by one, the sum is one.
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind);
  const math::Vec3 sun = math::normalized({0.0, 0.0, 1.0});
  constexpr int kFacets = 20;
  double expected = 1.0;
  for (int k = 0; k < kFacets; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / kFacets;
    const math::Vec3 towards = math::normalized({std::cos(turn), std::sin(turn), 0.7});
    const math::Vec3 normal = math::normalized(sun - towards);
    const math::Point3 at = math::Point3{} + towards * 4.0;
    const math::Vec3 axis = math::cross({0.0, 0.0, 1.0}, normal);
    scene.place(geometry::Disk{{0.0, 0.0, 0.0}, 0.3}, mirror,
                math::Transform::translation(at - math::Point3{}) *
                    math::Transform::rotation(axis, std::acos(normal.z)));
    expected += kMirror * towards.z;
  }
  scene.sun(sun, kIrradiance, kHalfAngle);
  scene.build();
  const auto estimate = scene.radiance({{0.0, 0.0, 0.5}, {0.0, 0.0, -1.0}}, 1 << 12);
  EXPECT_NEAR(estimate.mean, kGround * kIrradiance / std::numbers::pi * expected,
              4.0 * estimate.standard_error + 1e-4 * estimate.mean);
  EXPECT_LT(estimate.standard_error, 0.01 * estimate.mean);
}

}  // namespace
}  // namespace ifov::test_mirror_sun
