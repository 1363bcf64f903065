// Light sought from emitters: closed forms, the same mean as without, and enclosures.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/periodic_world.h"
#include "materials/bsdf/mirror.h"
#include "radiometry/planck.h"
#include "transport/emitters.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_emitters {
namespace {

using math::Point3;
using math::Ray;
using math::Transform;
using math::Vec3;
using test::SmallScene;

double planck(double temperature_k) {
  return radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, temperature_k);
}

struct Estimate {
  double mean = 0.0, deviation = 0.0, standard_error = 0.0;
};

using Tamper = std::function<void(transport::PathVertex&)>;

/// As SmallScene::radiance, with what paths recorded changed before light is made of it.
Estimate radiance(const transport::SpectralScene& scene, const Ray& ray, std::uint32_t count,
                  bool seek = true, const Tamper& tamper = {}) {
  transport::TransportOptions options;
  options.seek_emitters = seek;
  transport::PathTracer tracer(scene, options);
  transport::PathLight light(scene);
  double sum = 0.0, square = 0.0;
  constexpr std::uint32_t kBatch = 1024;
  std::vector<geometry::SurfacePoint> hits(kBatch);
  for (std::uint32_t first = 0; first < count; first += kBatch) {
    const std::uint32_t batch = std::min(kBatch, count - first);
    std::vector<Ray> rays(batch, ray);
    std::vector<transport::PathKey> keys(batch);
    for (std::uint32_t k = 0; k < batch; ++k) keys[k] = {17, first + k};
    sampling::RayCounts counts;
    transport::PathRecord record = tracer.trace(rays, keys, {hits.data(), batch}, counts);
    if (tamper)
      for (transport::PathVertex& vertex : record.vertices) tamper(vertex);
    for (std::uint32_t k = 0; k < batch; ++k) {
      const double value = static_cast<double>(light.radiance(record, k)[0]);
      sum += value;
      square += value * value;
    }
  }
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(0.0, square / count - mean * mean));
  return {mean, deviation, deviation / std::sqrt(static_cast<double>(count))};
}

Ray towards(Point3 at, Vec3 from) {
  const Vec3 direction = math::normalized(-from);
  return {at + from, direction};
}

TEST(Emitters, HotSphereOverGroundIsFoundByEveryPath) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.1, 285.0));
  scene.place(geometry::Sphere{{0.0, 0.0, 6.0}, 0.15}, scene.material(0.0, 1300.0));
  const transport::SpectralScene& spectral = scene.build();
  ASSERT_NE(spectral.emitters(), nullptr);
  EXPECT_EQ(spectral.emitters()->count(), 1u);
  EXPECT_FALSE(spectral.emitters()->leaves_some());
  for (const double x : {0.0, 2.0, 9.0}) {
    // View factor of a sphere from a plane element: cos(theta) R^2 / d^2.
    const double d2 = x * x + 36.0;
    const double factor = 6.0 / std::sqrt(d2) * 0.15 * 0.15 / d2;
    const double expected = 0.9 * planck(285.0) + 0.1 * factor * planck(1300.0);
    const Estimate found = radiance(spectral, towards({x, 0.0, 0.0}, {3.0, 1.0, 8.0}), 64);
    EXPECT_NEAR(found.mean, expected, 1e-5 * expected);
    EXPECT_LT(found.deviation, 1e-5 * expected);
  }
}

TEST(Emitters, HotDiskOverheadGivesItsViewFactor) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.5));
  scene.place(geometry::Disk{{0.0, 0.0, 2.0}, 1.0}, scene.material(0.0, 400.0));
  const transport::SpectralScene& spectral = scene.build();
  const Estimate found = radiance(spectral, towards({}, {1.5, 0.0, 1.0}), 1 << 14);
  const double expected = 0.5 * 0.2 * planck(400.0);
  EXPECT_NEAR(found.mean, expected, 1e-3 * expected);
  EXPECT_LT(found.deviation, 0.5 * expected);
}

TEST(Emitters, BlackWallsOfACubeGiveTheirViewFactorWithoutVariance) {
  // One hot wall: from the middle of the floor, an upright wall, and four corners of the ceiling.
  for (const bool ceiling : {false, true}) {
    SmallScene scene;
    const std::uint32_t cold = scene.material(0.0), floor = scene.material(0.5),
                        hot = scene.material(0.0, 300.0);
    const auto wall = [&](Point3 a, Vec3 x, Vec3 y, std::uint32_t material) {
      scene.place(geometry::Polygon{{a, a + x, a + x + y, a + y}}, material);
    };
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    wall({}, x, y, floor);
    wall({0, 0, 1}, y, x, ceiling ? hot : cold);
    wall({}, z, x, cold);
    wall({0, 1, 0}, x, z, cold);
    wall({}, y, z, cold);
    wall({1, 0, 0}, z, y, ceiling ? cold : hot);
    const transport::SpectralScene& spectral = scene.build();
    ASSERT_NE(spectral.emitters(), nullptr);
    const Estimate found = radiance(spectral, towards({0.5, 0.5, 0.0}, {0.1, 0.2, 0.6}), 4096);
    const double a = 0.5, sloped = std::hypot(0.5, 1.0);
    const double adjacent = (std::atan(a / a) - a / sloped * std::atan(a / sloped)) / std::numbers::pi;
    const double q = std::sqrt(1.0 + 0.25);
    const double opposite = 4.0 * (0.5 / q * std::atan(0.5 / q)) / std::numbers::pi;
    const double expected = 0.5 * planck(300.0) * (ceiling ? opposite : adjacent);
    EXPECT_NEAR(found.mean, expected, 1e-4 * expected);
    EXPECT_LT(found.deviation, 1e-3 * expected);
  }
}

/// Scenes for which light is sought, each with a ray.
struct Case {
  std::string name;
  std::function<void(SmallScene&)> fill;
  Ray ray = towards({}, {1.5, 0.0, 1.0});
  bool periodic = false;
};

std::vector<Case> cases() {
  const auto ground = [](SmallScene& s) { s.place(geometry::Plane{}, s.material(0.6)); };
  const Transform skewed = Transform::translation({0.2, 0.1, 2.0}) *
                           Transform::rotation({1.0, 0.4, -0.3}, 0.9) * Transform::scaling({0.7, 1.1, 0.5});
  const auto shape = [=](geometry::Shape what) {
    return [=](SmallScene& s) {
      ground(s);
      s.place(what, s.material(0.3, 600.0), skewed);
    };
  };
  std::vector<Case> list{
      {"ellipsoid", shape(geometry::Sphere{{}, 0.8})},
      {"dome", shape(geometry::Hemisphere{{}, 0.8})},
      {"box", shape(geometry::Box{{-0.5, -0.6, -0.4}, {0.5, 0.6, 0.7}})},
      {"can", shape(geometry::Cylinder{{0.0, 0.0, -0.5}, 0.5, 1.2, true})},
      {"tube", shape(geometry::Cylinder{{0.0, 0.0, -0.5}, 0.7, 1.2, false})},
      {"disk", shape(geometry::Disk{{}, 0.9})},
      {"polygon", shape(geometry::Polygon{{{0, 0, 0}, {1, 0, 0}, {1.2, 1, 0}, {0.1, 0.8, 0}}})},
  };
  list.push_back({"hidden by a plate", [=](SmallScene& s) {
                    ground(s);
                    s.place(geometry::Sphere{{0.0, 0.0, 3.0}, 0.8}, s.material(0.0, 600.0));
                    s.place(geometry::Box{{-2.0, -2.0, 1.5}, {0.1, 2.0, 1.6}}, s.material(0.4));
                  }});
  list.push_back({"touching the ground", [=](SmallScene& s) {
                    ground(s);
                    s.place(geometry::Sphere{{0.5, 0.0, 0.4}, 0.4}, s.material(0.2, 600.0));
                  }});
  list.push_back({"on the emitter",
                  [=](SmallScene& s) {
                    ground(s);
                    s.place(geometry::Box{{-1.0, -1.0, 0.0}, {1.0, 1.0, 0.5}}, s.material(0.3, 600.0));
                    s.place(geometry::Sphere{{0.0, 0.6, 1.2}, 0.3}, s.material(0.1, 600.0));
                  },
                  towards({0.0, 0.0, 0.5}, {1.0, -1.0, 2.0})});
  list.push_back({"leaf lit from both sides",
                  [](SmallScene& s) {
                    s.place(geometry::Box{{-5.0, -5.0, -9.0}, {5.0, 5.0, -8.0}}, s.material(0.5));
                    s.place(geometry::Disk{{}, 2.0}, s.leaf(0.4, 0.5));
                    s.place(geometry::Sphere{{0.3, 0.2, 1.0}, 0.3}, s.material(0.0, 600.0));
                    s.place(geometry::Box{{-0.7, 0.0, -1.4}, {0.1, 0.6, -1.0}}, s.material(0.1, 600.0));
                  },
                  towards({}, {2.0, 0.5, 1.0})});
  list.push_back({"in a room",
                  [](SmallScene& s) {
                    s.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}, s.material(0.7));
                    s.place(geometry::Sphere{{0.4, 0.4, -0.5}, 0.2}, s.material(0.3, 600.0));
                    s.place(geometry::Box{{-0.9, -0.5, -0.6}, {-0.4, 0.5, -0.5}}, s.material(0.5));
                  },
                  {{0.1, -0.2, 0.3}, math::normalized({-0.3, 0.1, -1.0})}});
  list.push_back(
      {"seen in a mirror",
       [=](SmallScene& s) {
         ground(s);
         s.place(geometry::Polygon{{{1.0, -3.0, 0.0}, {1.0, -3.0, 5.0}, {1.0, 3.0, 5.0}, {1.0, 3.0, 0.0}}},
                 s.material(0.9, 0.0, materials::Mirror::shared()));
         s.place(geometry::Sphere{{-1.0, 0.5, 1.5}, 0.5}, s.material(0.3, 600.0));
       },
       towards({1.0, 0.0, 0.5}, {-2.0, -0.5, 0.4})});
  list.push_back({"periodic",
                  [](SmallScene& s) {
                    s.place(geometry::Plane{}, s.material(0.6));
                    s.place(geometry::Box{{0.5, 0.5, 0.0}, {0.9, 2.0, 0.8}}, s.material(0.5));
                    s.place(geometry::Sphere{{2.6, 0.2, 0.9}, 0.4}, s.material(0.2, 600.0));
                  },
                  towards({-7.3, 11.2, 0.0}, {0.1, 0.1, 5.0}), true});
  return list;
}

const transport::SpectralScene& build(SmallScene& scene, const Case& c) {
  c.fill(scene);
  if (!c.periodic) return scene.build();
  return scene.build([](std::unique_ptr<geometry::World> world) -> std::unique_ptr<geometry::World> {
    return std::make_unique<geometry::PeriodicWorld>(std::move(world),
                                                     geometry::PeriodicWorld::Cell{-1.0, -1.0, 4.0, 3.0});
  });
}

TEST(Emitters, SeekingChangesNoMean) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    SmallScene scene;
    const transport::SpectralScene& spectral = build(scene, c);
    ASSERT_NE(spectral.emitters(), nullptr);
    const Estimate sought = radiance(spectral, c.ray, 1 << 14),
                   found = radiance(spectral, c.ray, 1 << 16, false);
    const double error = std::hypot(sought.standard_error, found.standard_error);
    EXPECT_NEAR(sought.mean, found.mean, 4.0 * error);
    EXPECT_LT(error, 0.04 * found.mean);
    EXPECT_LT(sought.deviation, found.deviation);
  }
}

/// Cases whose means differ from those without seeking by more than four standard errors.
int caught(const Tamper& tamper) {
  int count = 0;
  for (const Case& c : cases()) {
    SmallScene scene;
    const transport::SpectralScene& spectral = build(scene, c);
    const Estimate sought = radiance(spectral, c.ray, 1 << 13, true, tamper);
    const Estimate found = radiance(spectral, c.ray, 1 << 15, false);
    count +=
        std::abs(sought.mean - found.mean) > 4.0 * std::hypot(sought.standard_error, found.standard_error);
  }
  return count;
}

TEST(Emitters, PlantedFaultEmissionCountedOnTheContinuationToo) {
  EXPECT_GT(caught([](transport::PathVertex& v) { v.emission_weight = 1.0f; }), 8);
}

TEST(Emitters, PlantedFaultWeightsThatAddUpToLess) {
  EXPECT_GT(caught([](transport::PathVertex& v) { v.sought_weight *= 0.85f; }), 8);
}

/// A closed room at one temperature whose walls reflect nearly all and which holds black things: those are sought.
Estimate enclosure(const Tamper& tamper = {}) {
  SmallScene scene;
  const std::uint32_t white = scene.material(0.97, 300.0), black = scene.material(0.0, 300.0);
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}, white);
  scene.place(geometry::Sphere{{0.3, 0.4, -0.6}, 0.3}, black);
  scene.place(geometry::Cylinder{{-0.6, 0.2, -1.0}, 0.2, 0.7, true}, black);
  scene.place(geometry::Box{{0.2, -0.9, -0.9}, {0.8, -0.5, -0.4}}, black);
  scene.place(geometry::Disk{{0.0, 0.0, 0.8}, 0.3}, scene.leaf(0.4, 0.3, 300.0));
  const transport::SpectralScene& spectral = scene.build();
  EXPECT_NE(spectral.emitters(), nullptr);
  return radiance(spectral, {{0.1, -0.2, 0.3}, math::normalized({-0.5, 0.7, 0.2})}, 1 << 15, true, tamper);
}

TEST(Emitters, ClosedEnclosureReturnsPlanck) {
  const Estimate found = enclosure();
  EXPECT_NEAR(found.mean, planck(300.0), 4.0 * found.standard_error);
  EXPECT_LT(found.standard_error, 5e-3 * planck(300.0));
}

TEST(Emitters, PlantedFaultEnclosureGainsLight) {
  const Estimate found = enclosure([](transport::PathVertex& v) { v.emission_weight = 1.0f; });
  EXPECT_GT(std::abs(found.mean - planck(300.0)), 4.0 * found.standard_error);
}

TEST(Emitters, OrdinaryScenesHaveNone) {
  {
    SmallScene warm;  // 280 to 310 K under a cold sky
    warm.place(geometry::Plane{}, warm.material(0.1, 280.0));
    warm.place(geometry::Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, warm.material(0.9, 300.0));
    warm.place(geometry::Sphere{{3.0, 0.0, 1.0}, 0.5}, warm.material(0.0, 310.0));
    EXPECT_EQ(warm.build().emitters(), nullptr);
  }
  {
    SmallScene sunlit;  // sunlight outshines what is warm
    sunlit.place(geometry::Plane{}, sunlit.material(0.3));
    sunlit.place(geometry::Sphere{{3.0, 0.0, 1.0}, 0.5}, sunlit.material(0.5, 300.0));
    sunlit.sun({0.3, 0.1, 1.0}, 1000.0, 0.00465);
    EXPECT_EQ(sunlit.build().emitters(), nullptr);
  }
  {
    SmallScene black;  // nothing scatters
    black.place(geometry::Plane{}, black.material(0.0, 285.0));
    black.place(geometry::Sphere{{3.0, 0.0, 1.0}, 0.5}, black.material(0.0, 1300.0));
    EXPECT_EQ(black.build().emitters(), nullptr);
  }
}

TEST(Emitters, HotPlaneIsLeftOutAndSaysSo) {
  SmallScene scene;
  scene.place(geometry::Plane{-5.0}, scene.material(0.1, 285.0));
  scene.place(geometry::Plane{0.0}, scene.material(0.1, 285.0));
  scene.place(geometry::Plane{20.0}, scene.material(0.0, 1300.0));
  const transport::SpectralScene& spectral = scene.build();
  ASSERT_NE(spectral.emitters(), nullptr);
  EXPECT_EQ(spectral.emitters()->count(), 0u);
  EXPECT_TRUE(spectral.emitters()->leaves_some());
}

}  // namespace
}  // namespace ifov::test_emitters
