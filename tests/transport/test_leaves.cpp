#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/planck.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_leaves {
namespace {

using test::SmallScene;

constexpr double kSun = 1000.0, kSky = 80.0;
const math::Ray kDown{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}};

double planck(double temperature_k) {
  return radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, temperature_k);
}

/// Share of its light that a leaf loses: a fault.
class Loss final : public scene::Pattern {
 public:
  explicit Loss(double share) : share_(share) {}
  void apply(const geometry::SurfacePoint&, scene::ResolvedSurface& surface) const override {
    surface.constituents[1] = surface.constituents[0];
    surface.constituents[0].weight = 0.5;
    surface.constituents[1].weight = 0.5 - share_;
    surface.count = 2;
  }

 private:
  double share_;
};

/// A closed room with leaves in it, all at one temperature; the view is on a leaf.
SmallScene::Estimate furnace(double reflectance, double transmittance, double loss = 0.0) {
  SmallScene scene;
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}, scene.material(0.5, 300.0));
  const std::uint32_t leaf = scene.leaf(reflectance, transmittance, 300.0);
  scene.place(geometry::Disk{{0.0, 0.0, 0.1}, 0.8}, leaf);
  scene.place(geometry::Disk{{0.1, 0.0, 0.2}, 0.7}, leaf,
              math::Transform::rotation(math::normalized({1.0, 1.0, 0.0}), 0.4));
  if (loss > 0.0) scene.scene().assignments[leaf].patterns.push_back(std::make_shared<Loss>(loss));
  scene.build();
  const math::Point3 eye{0.2, -0.3, 0.9};
  return scene.radiance({eye, math::normalized(math::Point3{0.0, 0.0, 0.1} - eye)}, 1 << 17);
}

TEST(Leaf, FurnaceReturnsPlanck) {
  for (const auto& [rho, tau] : {std::pair{0.4957, 0.4409}, {0.1, 0.85}, {0.0, 0.5}, {0.6, 0.4}}) {
    const auto estimate = furnace(rho, tau);
    EXPECT_LT(estimate.standard_error, 1e-3 * planck(300.0)) << rho;
    EXPECT_NEAR(estimate.mean, planck(300.0), 3.0 * estimate.standard_error + 1e-6 * planck(300.0)) << rho;
  }
}

TEST(Leaf, PlantedFaultLostLightFailsTheFurnace) {
  const auto estimate = furnace(0.4957, 0.4409, 0.005);
  EXPECT_GT(std::abs(estimate.mean - planck(300.0)), 3.0 * estimate.standard_error + 1e-3 * planck(300.0));
}

TEST(Leaf, SunIsSeenThroughItAndOnIt) {
  const double zenith = 0.5, lit = kSun * std::cos(zenith) / std::numbers::pi;
  for (const double half_angle_rad : {0.0, 0.00465}) {
    SmallScene scene;
    scene.place(geometry::Disk{{0.0, 0.0, 1.0}, 3.0}, scene.leaf(0.5, 0.3));
    scene.sun({std::sin(zenith), 0.0, std::cos(zenith)}, kSun, half_angle_rad);
    scene.build();
    EXPECT_NEAR(scene.radiance(kDown, 64).mean, 0.5 * lit, 1e-4 * lit);
    EXPECT_NEAR(scene.radiance({{0.0, 0.0, -5.0}, {0.0, 0.0, 1.0}}, 64).mean, 0.3 * lit, 1e-4 * lit);
  }
}

TEST(Leaf, SunInItsPlaneLightsBothSides) {
  // A disc of half-angle a, its centre in the leaf's plane, gives each side the irradiance L (a - sin a cos a).
  constexpr double kHalf = 0.2;
  SmallScene scene;
  scene.place(geometry::Disk{{}, 3.0}, scene.leaf(0.5, 0.3),
              math::Transform::rotation({0.0, 1.0, 0.0}, 0.5 * std::numbers::pi));
  scene.sun({0.0, 0.0, 1.0}, kSun, kHalf);
  scene.build();
  const double radiance = kSun / (std::numbers::pi * std::sin(kHalf) * std::sin(kHalf));
  const double side = radiance * (kHalf - std::sin(kHalf) * std::cos(kHalf)) / std::numbers::pi;
  const auto estimate = scene.radiance({{5.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}, 1 << 16, 1, {1});
  EXPECT_NEAR(estimate.mean, 0.8 * side, 2e-3 * side);
}

/// Radiance of a layer of leaf over level ground under a uniform sky, in units of the sky's, and its closed form.
void expect_layer(double rho, double tau, double ground) {
  SmallScene scene;
  scene.place(geometry::Plane{0.0}, scene.material(ground));
  scene.place(geometry::Plane{1.0}, scene.leaf(rho, tau));
  scene.sky(kSky);
  scene.build();
  const auto estimate = scene.radiance(kDown, 1 << 18);
  EXPECT_NEAR(estimate.mean / kSky, rho + tau * tau * ground / (1.0 - rho * ground),
              3.0 * estimate.standard_error / kSky + 1e-6);
  EXPECT_LT(estimate.standard_error, 2e-3 * kSky);
}

TEST(Leaf, LayerOverGroundFollowsTheInterreflectionSeries) {
  expect_layer(0.5, 0.44, 0.3);
  expect_layer(0.2, 0.7, 0.8);
  expect_layer(0.05, 0.9, 0.0);
}

}  // namespace
}  // namespace ifov::test_leaves
