// Light of hot things by way of flat mirrors: sought through the receiver's image behind them.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/bsdf/mirror.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_emitter_mirrors {
namespace {

using test::SmallScene;

const auto kMirrorKind = materials::Mirror::shared();
constexpr double kGround = 0.5, kMirror = 0.8;

math::Ray down_on(double x, double y) { return {{x, y, 0.02}, {0.0, 0.0, -1.0}}; }

geometry::Polygon wall(double x, double y0, double y1, double height) {
  return {{{x, y0, 0.0}, {x, y1, 0.0}, {x, y1, height}, {x, y0, height}}};
}

/// A hot ball before two walls of mirrors that stand square to each other, one of them a thin box, and a tilted
/// disc; a box hides some of it.
SmallScene::Estimate among_walls(bool by_mirrors, std::uint32_t paths, math::Ray ray) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind);
  scene.place(wall(0.0, -4.0, 4.0, 3.0), mirror);
  scene.place(geometry::Box{{0.0, 4.0, 0.0}, {5.0, 4.1, 3.0}}, mirror);
  scene.place(
      geometry::Disk{{0.0, 0.0, 0.0}, 1.0}, mirror,
      math::Transform::translation({4.5, -1.0, 1.5}) * math::Transform::rotation({0.0, 1.0, 0.0}, -1.2));
  scene.place(geometry::Box{{2.4, 1.0, 0.0}, {2.6, 1.5, 1.0}}, scene.material(0.2));
  scene.place(geometry::Sphere{{2.5, 2.0, 2.2}, 0.9}, scene.material(0.0, 900.0));
  scene.build();
  transport::TransportOptions options;
  options.mirror_reflections = by_mirrors ? 8 : 0;
  return scene.radiance(ray, paths, 3, options);
}

TEST(EmitterMirrors, NothingIsCountedTwice) {
  for (const math::Ray& ray : {down_on(0.5, 2.0), down_on(1.0, -1.0), down_on(2.5, 0.7), down_on(3.5, 3.5)}) {
    const auto at_random = among_walls(false, 1 << 17, ray), sought = among_walls(true, 1 << 15, ray);
    const double error = std::hypot(at_random.standard_error, sought.standard_error);
    EXPECT_NEAR(sought.mean, at_random.mean, 4.0 * error);
    EXPECT_LT(error, 0.01 * sought.mean);
  }
}

TEST(EmitterMirrors, ImagesOfASmallBallLightTheGround) {
  // Level ground before a mirror wall: the ball's own view factor and that of its image.
  constexpr double kRadius = 0.02, kX = 1.0, kZ = 2.0;
  const auto before_wall = [&](int reflections) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(kGround));
    scene.place(wall(0.0, -50.0, 50.0, 50.0), scene.material(kMirror, 0.0, kMirrorKind));
    scene.place(geometry::Sphere{{kX, 0.0, kZ}, kRadius}, scene.material(0.0, 900.0));
    scene.build();
    transport::TransportOptions options;
    options.mirror_reflections = reflections;
    return scene.radiance(down_on(2.0, 0.0), 1 << 10, 3, options);
  };
  const auto view_factor = [&](double x) {
    const double d2 = (2.0 - x) * (2.0 - x) + kZ * kZ;
    return kRadius * kRadius / d2 * kZ / std::sqrt(d2);
  };
  const double share = kMirror * view_factor(-kX) / view_factor(kX);
  const auto sought = before_wall(8), unsought = before_wall(0);
  EXPECT_NEAR((sought.mean / unsought.mean - 1.0) / share, 1.0, 2e-3);
  EXPECT_GT(share, 0.15);
}

/// Hot things of four shapes about a chrome ball, a column and half a ball, on ground that lets some light through; a box
/// hides some.
SmallScene::Estimate among_balls(bool by_mirrors, std::uint32_t paths, math::Ray ray) {
  SmallScene scene;
  scene.place(wall(-9.0, -9.0, 9.0, 9.0), scene.material(0.0));
  scene.place(geometry::Disk{{0.0, 0.0, 0.0}, 9.0}, scene.leaf(kGround, 0.3));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind), hot = scene.material(0.0, 900.0);
  scene.place(geometry::Sphere{{0.0, 0.0, 1.0}, 0.8}, mirror);
  scene.place(geometry::Cylinder{{2.5, 1.0, 0.0}, 0.5, 2.0}, mirror);
  scene.place(geometry::Hemisphere{{1.0, -2.0, 0.2}, 0.4}, mirror);
  scene.place(geometry::Box{{0.9, 0.2, 0.0}, {1.1, 1.2, 0.8}}, scene.material(0.2));
  scene.place(geometry::Sphere{{1.5, 1.5, 1.7}, 0.3}, hot);
  scene.place(geometry::Sphere{{0.0, 0.0, 0.0}, 0.3}, hot,
              math::Transform::translation({-1.5, 1.0, -1.0}) * math::Transform::scaling({1.0, 0.5, 1.5}));
  scene.place(
      geometry::Disk{{0.0, 0.0, 0.0}, 0.4}, hot,
      math::Transform::translation({1.2, -0.8, 2.2}) * math::Transform::rotation({0.0, 1.0, 0.0}, 0.7));
  scene.place(geometry::Cylinder{{-1.5, -1.2, 0.2}, 0.15, 1.2}, hot);
  scene.place(geometry::Box{{2.0, -1.2, 0.3}, {2.4, -0.8, 0.5}}, hot);
  scene.build();
  transport::TransportOptions options;
  options.mirror_reflections = by_mirrors ? 8 : 0;
  return scene.radiance(ray, paths, 3, options);
}

TEST(EmitterMirrors, ByRoundMirrorsNothingIsCountedTwice) {
  for (const math::Ray& ray :
       {down_on(0.5, 0.9), down_on(-0.9, 0.3), down_on(1.9, 0.6), down_on(0.9, -1.2)}) {
    const auto at_random = among_balls(false, 1 << 18, ray), sought = among_balls(true, 1 << 16, ray);
    const double error = std::hypot(at_random.standard_error, sought.standard_error);
    EXPECT_NEAR(sought.mean, at_random.mean, 4.0 * error);
    EXPECT_LT(error, 0.01 * sought.mean);
  }
}

TEST(EmitterMirrors, ABallThrowsTheLightOfASmallOneByCoddingtonsEquations) {
  // Ground at the origin, a chrome ball above it to one side, a small hot one to the other.
  constexpr double kRadius = 0.01, kBall = 0.6, kAside = 1.5, kHeight = 1.2;
  const auto lit = [&](bool ball) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(kGround));
    if (ball)
      scene.place(geometry::Sphere{{kAside, 0.0, kHeight}, kBall}, scene.material(kMirror, 0.0, kMirrorKind));
    scene.place(geometry::Sphere{{-kAside, 0.0, kHeight}, kRadius}, scene.material(0.0, 900.0));
    scene.build();
    transport::TransportOptions options;
    options.maximum_scatterings = 2;  // not what other ground sends to the ball
    return scene.radiance(down_on(0.0, 0.0), 1 << 16, 3, options);
  };
  // Of all places on the ball the way over that which reflects is the shortest.
  double way = 1e9, place = 0.0;
  const auto at = [&](double angle) {
    return math::Point3{kAside - kBall * std::cos(angle), 0.0, kHeight - kBall * std::sin(angle)};
  };
  const math::Point3 ground{}, hot{-kAside, 0.0, kHeight};
  for (int k = 0; k < 1000000; ++k) {
    const double angle = 1e-6 * k;
    const double here = length(at(angle) - ground) + length(hot - at(angle));
    if (here < way) way = here, place = angle;
  }
  const math::Vec3 normal{-std::cos(place), 0.0, -std::sin(place)}, back = at(place) - ground;
  const double l = length(back), s = length(hot - at(place)), cosine = -dot(back, normal) / l;
  const double area = (s + l + 2.0 * s * l / (kBall * cosine)) * (s + l + 2.0 * s * l * cosine / kBall);
  const double thrown = kMirror * back.z / l * kRadius * kRadius / area;
  const double d2 = kAside * kAside + kHeight * kHeight,
               straight = kHeight / std::sqrt(d2) * kRadius * kRadius / d2;
  const auto with = lit(true), without = lit(false);
  EXPECT_NEAR((with.mean / without.mean - 1.0) / (thrown / straight), 1.0, 0.04);
  EXPECT_LT(with.standard_error, 3e-4 * with.mean);
  EXPECT_GT(thrown / straight, 0.015);
}

}  // namespace
}  // namespace ifov::test_emitter_mirrors
