// Light of hot things by way of flat mirrors: sought through the receiver's image behind them.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/bsdf/mirror.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov {
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
    const auto by_chance = among_walls(false, 1 << 17, ray), sought = among_walls(true, 1 << 15, ray);
    const double error = std::hypot(by_chance.standard_error, sought.standard_error);
    EXPECT_NEAR(sought.mean, by_chance.mean, 4.0 * error);
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

}  // namespace
}  // namespace ifov
