// Sunlight by way of balls and round columns: their images against the law of reflection, the light against closed
// forms and against paths that find it by chance.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf/mirror.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "transport/shapes/round_mirror.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_round_mirrors {
namespace {

using geometry::SurfaceSurvey;
using geometry::UnitKind;
using math::Point3;
using math::Transform;
using math::Vec3;
using test::SmallScene;
using transport::RoundMirror;

class Draws {
 public:
  double unit() { return sampling::unit_double(sampling::hash(7, number_++)); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  Vec3 direction() {
    const double z = between(-1.0, 1.0), turn = between(0.0, 2.0 * std::numbers::pi),
                 r = std::sqrt(1.0 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
  }

 private:
  std::uint64_t number_ = 0;
};

Transform placed(Draws& draws, double radius, double length) {
  return Transform::translation(
             {draws.between(-3.0, 3.0), draws.between(-3.0, 3.0), draws.between(-3.0, 3.0)}) *
         Transform::rotation(draws.direction(), draws.between(0.0, 3.0)) *
         Transform::scaling({radius, radius, length});
}

/// Solid angle of a small square of directions towards the Sun over that of its images.
double measured_spread(const RoundMirror& mirror, Point3 from, Vec3 sun) {
  constexpr double kStep = 1e-5;
  const sampling::TangentFrame frame(sun);
  Vec3 moved[2];
  for (int k = 0; k < 2; ++k) {
    const Vec3 step = kStep * (k == 0 ? frame.first : frame.second);
    const auto up = mirror.image(from, normalized(sun + step)),
               down = mirror.image(from, normalized(sun - step));
    if (!up || !down) return 0.0;
    moved[k] = (up->direction - down->direction) / (2.0 * kStep);
  }
  return 1.0 / length(cross(moved[0], moved[1]));
}

TEST(RoundMirror, ImagesObeyTheLawOfReflection) {
  Draws draws;
  int spheres = 0, cylinders = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const UnitKind kind = trial % 2 == 0 ? UnitKind::sphere : UnitKind::cylinder;
    const double radius = draws.between(0.1, 2.0),
                 length_m = kind == UnitKind::sphere ? radius : draws.between(0.5, 9.0);
    const Transform map = placed(draws, radius, length_m), unit = map.inverse();
    const auto mirror = RoundMirror::of({kind, map, 5, {}});
    ASSERT_TRUE(mirror);
    EXPECT_EQ(mirror->object(), 5u);
    // From close above the surface to far away.
    const Vec3 out = draws.direction();
    const Point3 from = map.origin_m() + out * (radius * (1.0 + std::pow(10.0, draws.between(-3.0, 3.0))));
    const Vec3 sun = draws.direction();
    const auto image = mirror->image(from, sun);
    if (!image) continue;
    (kind == UnitKind::sphere ? spheres : cylinders) += 1;
    const Point3 p = unit(image->at);
    const bool ball = kind == UnitKind::sphere;
    EXPECT_NEAR(std::hypot(p.x, p.y, ball ? p.z : 0.0), 1.0, 1e-9);
    const Vec3 normal = map(math::Normal3{p.x, p.y, ball ? p.z : 0.0}).as_vector();
    EXPECT_NEAR(length(from + image->direction * image->distance_m - image->at), 0.0,
                1e-9 * image->distance_m);
    const Vec3 mirrored = image->direction - 2.0 * dot(image->direction, normal) * normal;
    EXPECT_NEAR(length(mirrored - sun), 0.0, 1e-7);
    EXPECT_GT(dot(normal, sun), 0.0);
    const double spread = measured_spread(*mirror, from, sun);
    if (spread > 0.0 && dot(normal, sun) > 0.05) {
      EXPECT_NEAR(image->spread() / spread, 1.0, 1e-3);
    }
  }
  EXPECT_GT(spheres, 5000);
  EXPECT_GT(cylinders, 500);
}

/// Of a point light: the places as Fermat has them, the beam as Coddington's equations have it (s + L + 2 s L / (R cos t)
/// and s + L + 2 s L cos t / R across, with s, L the two ways and t the angle of incidence; a cylinder bends in one plane).
TEST(RoundMirror, ImagesOfNearLightsObeyTheLawOfReflection) {
  Draws draws;
  int seen = 0, hidden = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const bool cylinder = trial % 2 == 1;
    const double radius = draws.between(0.1, 2.0), length_m = cylinder ? draws.between(0.5, 9.0) : radius;
    const Transform map = placed(draws, radius, length_m);
    const auto mirror = RoundMirror::of({cylinder ? UnitKind::cylinder : UnitKind::sphere, map, 5, {}});
    ASSERT_TRUE(mirror);
    const Vec3 axis = normalized(map.column_z());
    const auto beside = [&] {
      Vec3 out = draws.direction();
      if (cylinder) out = normalized(out - dot(out, axis) * axis);
      const Point3 foot = cylinder ? map.origin_m() + axis * (length_m * draws.unit()) : map.origin_m();
      return foot + out * (radius * (1.0 + std::pow(10.0, draws.between(-3.0, 3.0))));
    };
    const Point3 from = beside(), light = beside();
    const auto image = mirror->image_of(from, light);
    if (!image) {
      ++hidden;
      continue;
    }
    ++seen;
    const Vec3 to = light - image->at, up = image->at - map.origin_m();
    const Vec3 normal = normalized(cylinder ? up - dot(up, axis) * axis : up);
    EXPECT_LT(length(image->onward - normalized(to)), 1e-7);
    const double own = -dot(image->direction, normal), other = dot(normalized(to), normal);
    EXPECT_GT(own, 0.0);
    EXPECT_NEAR(own, other, 1e-9);
    EXPECT_NEAR(length(map.inverse()(image->at) -
                       map.inverse()(map.origin_m() + (cylinder ? dot(up, axis) * axis : Vec3{}))),
                1.0, 1e-9);
    const double s = length(to), l = image->distance_m;
    double area = (s + l + 2.0 * s * l / (radius * own)) * (s + l + 2.0 * s * l * own / radius);
    if (cylinder) {
      // Euler: the curvatures of the surface in the plane of incidence and across it, and the twist between them, bend
      // the beam by 2 cos t (k_p / cos2 t, k_s, k_t / cos t).
      const Vec3 in_plane = normalized(image->direction + own * normal), across = cross(normal, in_plane);
      const Vec3 round = cross(normal, axis);
      const double p = dot(in_plane, round), q = dot(across, round);
      const double a = 2.0 * p * p / (radius * own), b = 2.0 * q * q * own / radius, c = 2.0 * p * q / radius;
      area = own > 1.0 - 1e-6 ? (s + l) * (s + l + 2.0 * s * l / radius)
                              : (s + l + s * l * a) * (s + l + s * l * b) - std::pow(s * l * c, 2);
    }
    EXPECT_NEAR(image->area_m2(s) / area, 1.0, 1e-6) << cylinder << " " << own;
    const auto met = mirror->met(from, image->at);
    ASSERT_TRUE(met);
    EXPECT_NEAR(met->area_m2(s) / area, 1.0, 1e-6);
  }
  EXPECT_GT(seen, 3000);
  EXPECT_GT(hidden, 1000);
}

TEST(RoundMirror, ANearLightFarAwayIsTheSun) {
  Draws draws;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto mirror = RoundMirror::of({UnitKind::sphere, placed(draws, 0.7, 0.7), 5, {}});
    const Point3 from{draws.between(-9.0, 9.0), draws.between(-9.0, 9.0), draws.between(-9.0, 9.0)};
    const Vec3 sun = draws.direction();
    const auto far = mirror->image(from, sun), near = mirror->image_of(from, from + 1e9 * sun);
    ASSERT_EQ(far.has_value(), near.has_value());
    if (!far) continue;
    EXPECT_LT(length(far->at - near->at), 1e-7);
    EXPECT_NEAR(near->area_m2(1e9) / 1e18 / far->spread(), 1.0, 1e-6);
  }
}

TEST(RoundMirror, OfABallFarAwayReflectsToAllSidesAlike) {
  // Radiant intensity of a ball in the Sun: E R^2 / 4, whatever the direction.
  const auto mirror = RoundMirror::of({UnitKind::sphere, Transform::scaling({2.0, 2.0, 2.0}), 0, {}});
  const Vec3 sun = math::normalized({0.3, -0.5, 0.6});
  for (const Vec3 out :
       {Vec3{0.0, 0.0, 1.0}, math::normalized({-0.3, 0.5, -0.5}), math::normalized({1.0, 1.0, 0.0})}) {
    const auto image = mirror->image(Point3{} + out * 1e6, sun);
    ASSERT_TRUE(image);
    EXPECT_NEAR(image->spread() / (4.0 * 1e12 / 4.0), 1.0, 1e-4);
  }
  EXPECT_FALSE(mirror->image(Point3{} + sun * -1e3, sun)) << "in its shadow";
  EXPECT_FALSE(mirror->image({0.5, 0.0, 0.0}, sun)) << "inside";
}

TEST(RoundMirror, EndsAreMindedAndStretchedShapesAreNot) {
  const Transform one;
  const Vec3 sun{0.0, 0.0, 1.0};
  // Light that falls along a column misses its side; from beside and below the ray would leave at the upper end.
  EXPECT_FALSE(RoundMirror::of({UnitKind::open_cylinder, one, 0, {}})->image({3.0, 0.0, 0.5}, sun));
  const auto tall = RoundMirror::of({UnitKind::open_cylinder, Transform::scaling({1.0, 1.0, 9.0}), 0, {}});
  const Vec3 low = math::normalized({1.0, 0.0, 1.0});
  EXPECT_TRUE(tall->image({3.0, 0.0, 0.5}, low));
  EXPECT_FALSE(tall->image({9.0, 0.0, 5.0}, low));
  const auto dome = RoundMirror::of({UnitKind::hemisphere, one, 0, {}});
  EXPECT_TRUE(dome->image({3.0, 0.0, 0.1}, low));
  EXPECT_FALSE(dome->image({3.0, 0.0, -9.0}, low)) << "the lower half is missing";
  EXPECT_TRUE(dome->hollow());
  EXPECT_FALSE(RoundMirror::of({UnitKind::sphere, Transform::scaling({1.0, 1.0, 1.1}), 0, {}}));
  EXPECT_FALSE(RoundMirror::of({UnitKind::open_cylinder, Transform::scaling({1.0, 1.1, 1.0}), 0, {}}));
}

constexpr double kGround = 0.4, kMirror = 0.8, kIrradiance = 1000.0;
const auto kMirrorKind = materials::Mirror::shared();

/// A ball, a can, half a ball and a leaf on the ground, under a Sun so wide that paths find it by chance.
SmallScene::Estimate among_rounds(int reflections, std::uint32_t paths, math::Ray ray,
                                  double half_angle = 0.4) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  const std::uint32_t mirror = scene.material(kMirror, 0.0, kMirrorKind);
  scene.place(geometry::Sphere{{-1.5, 0.0, 1.0}, 1.0}, mirror);
  scene.place(geometry::Cylinder{{0.0, 0.0, 0.0}, 0.5, 3.0, true}, mirror,
              Transform::translation({1.5, -0.5, 0.0}) * Transform::rotation({0.0, 1.0, 0.0}, 0.2));
  scene.place(geometry::Disk{{0.0, 0.0, 0.0}, 0.4}, scene.leaf(0.3, 0.4),
              Transform::translation({0.3, 0.2, 1.2}));
  scene.sun({0.5, 0.1, 1.0}, kIrradiance, half_angle);
  scene.sky(30.0);
  scene.build();
  transport::TransportOptions options;
  options.mirror_reflections = reflections;
  return scene.radiance(ray, paths, 7, options);
}

math::Ray down_on(double x, double y) { return {{x, y, 0.5}, {0.0, 0.0, -1.0}}; }

TEST(RoundMirrors, NothingIsCountedTwice) {
  for (const math::Ray& ray : {down_on(-0.2, 0.3), down_on(-1.4, 1.2), down_on(0.7, -0.5), down_on(2.6, 0.0),
                               math::Ray{{0.3, 0.2, 5.0}, {0.0, 0.0, -1.0}}}) {
    const auto at_random = among_rounds(0, 1 << 17, ray), sought = among_rounds(2, 1 << 15, ray);
    const double error = std::hypot(at_random.standard_error, sought.standard_error);
    EXPECT_NEAR(sought.mean, at_random.mean, 4.0 * error + 1e-6 * sought.mean);
    EXPECT_LT(error, 0.01 * sought.mean);
  }
}

TEST(RoundMirrors, ANarrowSunIsFoundAndRandomPathsDoNotFindIt) {
  // The planted fault: not sought, the ball's light is found by next to no path.
  const math::Ray ray = down_on(-0.2, 0.3);
  const auto sought = among_rounds(2, 1 << 12, ray, 1e-4), wide = among_rounds(2, 1 << 14, ray, 0.05),
             at_random = among_rounds(0, 1 << 12, ray, 1e-4);
  EXPECT_NEAR(sought.mean, wide.mean, 0.03 * wide.mean);
  EXPECT_LT(at_random.mean, 0.95 * sought.mean);
  EXPECT_LT(sought.standard_error, 0.01 * sought.mean);
}

TEST(RoundMirrors, LightOfABallIsThatOfTheClosedForm) {
  // The Sun overhead, a normal 60 degrees from it: light leaves the ball 60 degrees from the nadir. Of directions that
  // differ in the plane of incidence the ball spreads 1 + 2 L / (R cos 60), across it 1 + 2 L cos 60 / R.
  constexpr double kRadius = 2.0, kHeight = 5.0, kCosine = 0.5;
  const double sine = std::sqrt(0.75), at_z = kHeight + kRadius * kCosine, way = at_z / kCosine;
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kGround));
  scene.place(geometry::Sphere{{0.0, 0.0, kHeight}, kRadius}, scene.material(kMirror, 0.0, kMirrorKind));
  scene.sun({0.0, 0.0, 1.0}, kIrradiance, 0.0);
  scene.build();
  // The ground and the ball once each: what the ground throws back to the ball is another 0.3 %.
  transport::TransportOptions with, without;
  with.maximum_scatterings = without.maximum_scatterings = 2;
  without.mirror_reflections = 0, without.sought_only = true;
  const math::Ray ray = down_on(kRadius * sine + way * sine, 0.0);
  const double ball =
      scene.radiance(ray, 1 << 10, 1, with).mean - scene.radiance(ray, 1 << 10, 1, without).mean;
  const double spread = (1.0 + 2.0 * way / (kRadius * kCosine)) * (1.0 + 2.0 * way * kCosine / kRadius);
  const double expected = kGround / std::numbers::pi * kMirror * kIrradiance * kCosine / spread;
  EXPECT_NEAR(ball, expected, 2e-3 * expected);
}

}  // namespace
}  // namespace ifov::test_round_mirrors
