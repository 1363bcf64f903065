// Light through panes, media and films: closed forms, furnaces, and twins with a planted fault.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf/boundary/film.h"
#include "materials/bsdf/boundary/slab.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/mirror.h"
#include "materials/bsdf/rough_conductor.h"
#include "radiometry/planck.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_panes {
namespace {

using materials::Bsdf;
using materials::BsdfEvent;
using materials::Side;
using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::SmallScene;

constexpr double kFloor = 0.4, kIrradiance = 1000.0, kHalfAngle = 0.00465;
constexpr double kIndex = 1.5;

Spectrum one(double value) { return Spectrum::constant(value); }

std::shared_ptr<const Bsdf> pane() { return materials::slab::make(one(kIndex), one(1e-5), 4e-3, one(1.0)); }
std::shared_ptr<const Bsdf> glass(double n = kIndex, double k = 0.0) {
  return materials::smooth::make(one(n), one(k), one(1.0), true);
}

double share(const Bsdf& bsdf, Side side, double cosine) {
  return materials::directional_hemispherical(bsdf, side, cosine).at(SmallScene::kWavelength_um);
}

geometry::Polygon sheet(double height, double half = 50.0) {
  return {{{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}}};
}

/// A boundary with a fault: what it lets through is multiplied, or what it emits is that of another angle.
class Faulty final : public Bsdf {
 public:
  Faulty(std::shared_ptr<const Bsdf> right, double through, double back, std::shared_ptr<const Bsdf> behind)
      : right_(std::move(right)), through_(through), back_(back), behind_(std::move(behind)) {}
  bool is_delta() const override { return true; }
  bool may_transmit() const override { return right_->may_transmit(); }
  materials::Passage passage() const override { return right_->passage(); }
  std::shared_ptr<const Bsdf> behind() const override { return behind_; }
  double bending_index() const override { return right_->bending_index(); }
  materials::BsdfSample sample(const BsdfEvent& view, double a, double b) const override {
    return right_->sample(view, a, b);
  }
  double pdf(const BsdfEvent&) const override { return 0.0; }
  double shape(const BsdfEvent&) const override { return 0.0; }
  double grey(const BsdfEvent&) const override { return 1.0; }
  std::span<const Spectrum> spectra() const override { return right_->spectra(); }
  void evaluate(const BsdfEvent& event, materials::ParameterSpectra rows, std::size_t count,
                float* share) const override {
    right_->evaluate(event, rows, count, share);
    for (std::size_t n = 0; n < count; ++n)
      share[n] *= static_cast<float>(event.side == Side::transmitted ? through_ : back_);
  }

 private:
  std::shared_ptr<const Bsdf> right_;
  double through_, back_;
  std::shared_ptr<const Bsdf> behind_;
};

transport::TransportOptions scatterings(int most) {
  transport::TransportOptions options;
  options.maximum_scatterings = most;
  return options;
}

const Vec3 kSun = math::normalized({0.5, 0.3, 0.9});

/// The floor as seen from under `panes` sheets of glass.
SmallScene::Estimate under_panes(int panes, double half_angle, int most, std::uint32_t paths,
                                 const std::shared_ptr<const Bsdf>& kind = pane()) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kFloor));
  for (int k = 0; k < panes; ++k) scene.place(sheet(2.0 + 0.5 * k), scene.material(0.1, 0.0, kind));
  scene.sun(kSun, kIrradiance, half_angle);
  scene.build();
  return scene.radiance({{0.1, 0.2, 1.0}, {0.0, 0.0, -1.0}}, paths, 1, scatterings(most));
}

TEST(Panes, SunlitFloorBehindOneAndTwo) {
  const double lit = kFloor * kIrradiance * kSun.z / pi;
  const double t = share(*pane(), Side::transmitted, kSun.z), r = share(*pane(), Side::reflected, kSun.z);
  for (const double half_angle : {0.0, kHalfAngle}) {
    const auto behind_one = under_panes(1, half_angle, 2, 64);
    EXPECT_NEAR(behind_one.mean, lit * t, 2e-4 * lit);
    // Light goes to and fro between two.
    const auto behind_two = under_panes(2, half_angle, 2, 64);
    EXPECT_NEAR(behind_two.mean, lit * t * t / (1.0 - r * r), 3e-4 * lit);
    EXPECT_GT(std::abs(behind_two.mean - lit * t * t), 1e-3 * lit);
  }
}

TEST(Panes, WhatTheFloorSendsUpComesBackInPart) {
  const double lit = kFloor * kIrradiance * kSun.z / pi * share(*pane(), Side::transmitted, kSun.z);
  const double back = share(*pane(), Side::reflected, materials::kBihemispherical);
  const auto found = under_panes(1, kHalfAngle, -1, 1 << 14);
  EXPECT_LT(found.standard_error, 2e-3 * lit);
  EXPECT_NEAR(found.mean, lit / (1.0 - kFloor * back), 3.0 * found.standard_error + 1e-3 * lit);
}

TEST(Panes, SeenFromAboveBothSidesCount) {
  // The floor through the pane, and the sky in it.
  constexpr double kSky = 20.0;
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.0, 290.0));
  scene.place(sheet(2.0), scene.material(0.1, 0.0, pane()));
  scene.sky(kSky);
  scene.build();
  const Vec3 down = math::normalized({0.6, 0.0, -1.0});
  const auto found = scene.radiance({{0.0, 0.0, 5.0}, down}, 16);
  const double t = share(*pane(), Side::transmitted, -down.z), r = share(*pane(), Side::reflected, -down.z);
  const double planck = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 290.0);
  EXPECT_NEAR(found.mean, t * planck + r * kSky, 1e-4 * planck);
  EXPECT_LT(found.standard_error, 1e-6 * planck);
}

/// In a room of the sky's radiance a ball of glass looks as the sky does.
SmallScene::Estimate ball_in_the_sky(const std::shared_ptr<const Bsdf>& kind, Vec3 towards) {
  SmallScene scene;
  scene.place(geometry::Sphere{{0.0, 0.0, 100.0}, 1.0}, scene.material(0.1, 0.0, kind));
  scene.place(geometry::Sphere{{0.0, 0.0, 100.0}, 20.0}, scene.material(0.0, 290.0));
  scene.build();
  return scene.radiance({{0.0, 0.0, 105.0}, math::normalized(towards)}, 512);
}

TEST(Panes, GlassBallInUniformLightLooksAsThat) {
  const double planck = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 290.0);
  for (const Vec3 towards : {Vec3{0.0, 0.0, -1.0}, {0.1, 0.0, -1.0}, {0.195, 0.0, -1.0}}) {
    const auto found = ball_in_the_sky(glass(), towards);
    EXPECT_NEAR(found.mean, planck, 3.0 * found.standard_error + 1e-4 * planck);
  }
}

TEST(Panes, PlantedFaultOfTheSquareOfTheIndexIsSeen) {
  // Radiance that grows by n^2 into the glass and does not fall by it again.
  const double planck = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 290.0);
  const auto wrong = std::make_shared<Faulty>(glass(), 1.0 / (kIndex * kIndex), 1.0, glass()->behind());
  const auto found = ball_in_the_sky(wrong, {0.1, 0.0, -1.0});
  EXPECT_GT(std::abs(found.mean - planck), 0.3 * planck);
}

/// A closed room at one temperature, with glossy walls, a pane, a coated pane, a ball of glass that absorbs and one of metal.
SmallScene::Estimate warm_room(const std::shared_ptr<const Bsdf>& sheet_kind, Vec3 towards,
                               std::uint32_t paths) {
  constexpr double kWarm = 300.0;
  SmallScene scene;
  const auto kind = [&](const std::shared_ptr<const Bsdf>& bsdf) { return scene.material(0.1, kWarm, bsdf); };
  const auto gloss = std::make_shared<materials::RoughConductor>(
      one(2.0), one(1.0), one(1.0),
      materials::RoughConductor::Facets{materials::FacetShape::ggx, 0.3, 0.3, 0.0});
  scene.place(geometry::Box{{-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}}, kind(gloss));
  scene.place(sheet(-1.0, 1.0), kind(sheet_kind));
  scene.place(sheet(1.2, 1.0),
              kind(materials::film::make({one(1.8), one(0.1), 1e-6}, one(1.5), one(3e-5), 4e-3, one(1.0))));
  scene.place(geometry::Sphere{{0.3, 0.4, -0.3}, 0.3}, kind(glass(1.5, 1e-6)));
  scene.place(geometry::Sphere{{-0.7, 0.4, 0.3}, 0.3},
              kind(materials::smooth::make(one(2.0), one(2.0), one(1.0), false)));
  scene.build();
  return scene.radiance({{0.1, -0.2, 0.3}, math::normalized(towards)}, paths);
}

TEST(Panes, WarmRoomReturnsPlanck) {
  const double planck = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  for (const Vec3 towards : {Vec3{0.1, 0.1, -1.0}, {0.2, 0.6, -0.6}, {0.0, 0.1, 1.0}, {-0.8, 0.6, 0.0}}) {
    const auto found = warm_room(pane(), towards, 1 << 13);
    EXPECT_LT(found.standard_error, 2e-3 * planck);
    EXPECT_NEAR(found.mean, planck, 3.0 * found.standard_error + 1e-3 * planck);
  }
}

TEST(Panes, PlantedFaultOtherEmissionFailsInTheRoom) {
  // What it reflects when it emits is what it reflects at right angles: emission without its angle.
  class Flat final : public Bsdf {
   public:
    bool is_delta() const override { return true; }
    bool may_transmit() const override { return true; }
    materials::Passage passage() const override { return materials::Passage::straight; }
    materials::BsdfSample sample(const BsdfEvent& view, double a, double b) const override {
      return right_->sample(view, a, b);
    }
    double pdf(const BsdfEvent&) const override { return 0.0; }
    double shape(const BsdfEvent&) const override { return 0.0; }
    double grey(const BsdfEvent&) const override { return 1.0; }
    std::span<const Spectrum> spectra() const override { return right_->spectra(); }
    void evaluate(const BsdfEvent& event, materials::ParameterSpectra rows, std::size_t count,
                  float* share) const override {
      // NodeBsdf asks for emission in the frame of the normal, paths in that of the scene.
      BsdfEvent asked = event;
      if (event.normal.z == 1.0 && event.outgoing.y == 0.0 && event.outgoing.x > 0.0)
        asked.outgoing = {0.0, 0.0, 1.0};
      right_->evaluate(asked, rows, count, share);
    }

   private:
    std::shared_ptr<const Bsdf> right_ = materials::slab::make(one(kIndex), one(1e-4), 4e-3, one(1.0));
  };
  const double planck = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  const auto found = warm_room(std::make_shared<Flat>(), {-0.65, -0.6, -1.0}, 1 << 14);
  EXPECT_GT(std::abs(found.mean - planck), 3.0 * found.standard_error + 1e-3 * planck);
}

/// A bed half a metre under water, seen from above.
SmallScene::Estimate lake(double half_angle, int most, std::uint32_t paths, double k = 0.0) {
  SmallScene scene;
  scene.place(geometry::Plane{-0.5}, scene.material(kFloor));
  scene.place(geometry::Box{{-500.0, -500.0, -1.0}, {500.0, 500.0, 0.0}},
              scene.material(0.1, 0.0, glass(1.33, k)));
  scene.sun(kSun, kIrradiance, half_angle);
  scene.build();
  return scene.radiance({{0.1, 0.2, 3.0}, {0.0, 0.0, -1.0}}, paths, 1, scatterings(most));
}

TEST(Panes, SunlitBedOfALake) {
  const auto water = glass(1.33);
  const double in = share(*water, Side::transmitted, kSun.z), out = share(*water, Side::transmitted, 1.0);
  const double once = kFloor / pi * kIrradiance * kSun.z * in * out / (1.33 * 1.33);
  for (const double half_angle : {0.0, kHalfAngle}) {
    const auto found = lake(half_angle, 3, 64);
    EXPECT_NEAR(found.mean, once, 3e-4 * once);
    EXPECT_LT(found.standard_error, 5e-4 * once);  // the disc's own width
  }
  // With all that goes to and fro under the surface: it returns r of diffuse light.
  const double r = 1.0 - share(*water, Side::transmitted, materials::kBihemispherical) / (1.33 * 1.33);
  const auto whole = lake(kHalfAngle, -1, 1 << 14);
  EXPECT_LT(whole.standard_error, 5e-3 * once);
  EXPECT_NEAR(whole.mean, once / (1.0 - kFloor * r), 3.0 * whole.standard_error + 2e-3 * once);
}

TEST(Panes, WaterAbsorbsOnBothWays) {
  constexpr double kAbsorbing = 5e-7;
  const double per_m = 4.0 * pi * kAbsorbing / (SmallScene::kWavelength_um * 1e-6);
  const double within = std::sqrt(1.0 - (1.0 - kSun.z * kSun.z) / (1.33 * 1.33));
  const auto clear = lake(0.0, 3, 16), dim = lake(0.0, 3, 16, kAbsorbing);
  const double expected = std::exp(-per_m * 0.5 * (1.0 + 1.0 / within));
  EXPECT_NEAR(dim.mean / clear.mean, expected, 1e-3 * expected);
}

TEST(Panes, SunThroughAThickPlate) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kFloor));
  scene.place(geometry::Box{{-20.0, -20.0, 2.0}, {20.0, 20.0, 2.3}}, scene.material(0.1, 0.0, glass()));
  scene.sun(kSun, kIrradiance, kHalfAngle);
  scene.build();
  const double t = share(*glass(), Side::transmitted, kSun.z), lit = kFloor * kIrradiance * kSun.z / pi;
  EXPECT_NEAR(scene.radiance({{0.1, 0.2, 1.0}, {0.0, 0.0, -1.0}}, 64, 1, scatterings(1)).mean, lit * t * t,
              2e-4 * lit);
}

TEST(Panes, NothingIsCountedTwice) {
  // Under a Sun so wide that chance finds it: panes, their reflections, a plate and a hot ball behind glass.
  const auto yard = [](bool sought, std::uint32_t paths, const math::Ray& ray) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(kFloor));
    scene.place(geometry::Polygon{{{1.0, -3.0, 0.0}, {1.0, 3.0, 0.0}, {1.0, 3.0, 3.0}, {1.0, -3.0, 3.0}}},
                scene.material(0.1, 0.0, pane()));
    scene.place(geometry::Polygon{{{0.0, -3.0, 2.0}, {3.0, -3.0, 2.0}, {3.0, 3.0, 2.2}, {0.0, 3.0, 2.2}}},
                scene.material(0.1, 0.0, pane()));
    scene.place(geometry::Box{{-2.0, -2.0, 1.0}, {-0.5, 2.0, 1.2}}, scene.material(0.1, 0.0, glass()));
    scene.place(geometry::Sphere{{2.0, 0.0, 0.6}, 0.2}, scene.material(0.2, 700.0));
    scene.sun({0.4, 0.1, 1.0}, 3000.0, 0.5);
    scene.sky(30.0);
    scene.build();
    transport::TransportOptions options;
    options.seek_emitters = sought;
    if (!sought) options.mirror_reflections = 0;
    return scene.radiance(ray, paths, 5, options);
  };
  for (const math::Ray& ray : {math::Ray{{0.4, 0.3, 0.8}, math::normalized({0.05, 0.0, -1.0})},
                               math::Ray{{1.8, 0.9, 0.8}, {0.0, 0.0, -1.0}},
                               math::Ray{{-1.2, 0.3, 0.8}, math::normalized({0.02, 0.0, -1.0})}}) {
    const auto at_random = yard(false, 1 << 15, ray), sought = yard(true, 1 << 13, ray);
    const double error = std::hypot(at_random.standard_error, sought.standard_error);
    EXPECT_NEAR(sought.mean, at_random.mean, 4.0 * error + 1e-6 * sought.mean);
    EXPECT_LT(error, 0.02 * sought.mean);
  }
}

TEST(Panes, CausticsOfABallAreToldAsUnseen) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(kFloor));
  scene.place(geometry::Sphere{{0.0, 0.0, 1.0}, 0.5}, scene.material(0.1, 0.0, glass()));
  scene.sun({0.1, 0.0, 1.0}, kIrradiance, kHalfAngle);
  const transport::SpectralScene& spectral = scene.build();
  ASSERT_NE(spectral.sun_mirrors(), nullptr);
  EXPECT_TRUE(spectral.sun_mirrors()->may_hide());
  transport::TransportOptions options;
  options.sought_only = true;
  transport::PathTracer tracer(spectral, options);
  std::vector<math::Ray> rays(256, {{0.0, 0.1, 0.3}, math::normalized({0.0, 0.0, -1.0})});
  std::vector<transport::PathKey> keys(rays.size());
  for (std::uint32_t k = 0; k < keys.size(); ++k) keys[k] = {1, k};
  std::vector<geometry::SurfacePoint> hits(rays.size());
  sampling::RayCounts counts;
  const transport::PathRecord& paths = tracer.trace(rays, keys, hits, counts);
  double unseen = 0.0;
  for (std::size_t k = 0; k < rays.size(); ++k) unseen += static_cast<double>(paths.paths[k].unseen) / 256.0;
  // Right under the ball the floor is in its shadow, and what the ball gathers is a good part of direct sunlight, kFloor / pi.
  EXPECT_GT(unseen, 0.1 * kFloor / pi);
}

TEST(Panes, LightReflectedWholeManyTimesIsNotToldAsMoreThanArrives) {
  // From a lit floor paths enter a bar of glass and are reflected in it many times before they leave it for the Sun. What
  // they are told to bring in the mean over all directions can be no more than what a Sun of pi steradians throws on a white floor.
  const auto unseen = [](bool polarized) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(kFloor));
    scene.place(geometry::Box{{-2.0, -2.0, 0.5}, {2.0, 2.0, 0.7}}, scene.material(0.1, 0.0, glass()));
    scene.sun({0.8, 0.3, 1.0}, kIrradiance, kHalfAngle);
    const transport::SpectralScene& spectral = polarized ? scene.build_polarized() : scene.build();
    transport::TransportOptions options;
    options.sought_only = true;
    transport::PathTracer tracer(spectral, options);
    std::vector<math::Ray> rays(4096, {{0.3, 0.1, 0.4}, math::normalized({0.5, 0.2, -1.0})});
    std::vector<transport::PathKey> keys(rays.size());
    for (std::uint32_t k = 0; k < keys.size(); ++k) keys[k] = {1, k};
    std::vector<geometry::SurfacePoint> hits(rays.size());
    sampling::RayCounts counts;
    const transport::PathRecord& paths = tracer.trace(rays, keys, hits, counts);
    double sum = 0.0;
    for (std::size_t k = 0; k < rays.size(); ++k) sum += static_cast<double>(paths.paths[k].unseen);
    return sum / static_cast<double>(rays.size());
  };
  const double plain = unseen(false), polarized = unseen(true);
  EXPECT_GT(plain, 1e-4);
  EXPECT_LT(plain, 1.0 / pi);
  // What a boundary polarized, the next may send on twice as much of: no less is allowed for, and not again and again.
  EXPECT_GE(polarized, plain);
  EXPECT_LT(polarized, 1.0 / pi);
}

TEST(Panes, FrontAndBackOfASheetAreTwo) {
  constexpr double kFront = 0.8, kBack = 0.1;
  const auto seen = [&](bool front, bool lit_from_front) {
    SmallScene scene;
    const std::uint32_t face = scene.material(kFront), other = scene.material(kBack);
    scene.scene().assignments[face].back_states = {other};
    // Its front looks to +x.
    scene.place(geometry::Polygon{{{0.0, -3.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 3.0, 6.0}, {0.0, -3.0, 6.0}}},
                face);
    scene.sun({lit_from_front ? 1.0 : -1.0, 0.0, 1.0}, kIrradiance, 0.0);
    scene.build();
    const double side = front ? 1.0 : -1.0;
    return scene.radiance({{2.0 * side, 0.1, 2.0}, {-side, 0.0, 0.0}}, 4).mean;
  };
  const double lit = kIrradiance * std::sqrt(0.5) / pi;
  EXPECT_NEAR(seen(true, true), kFront * lit, 1e-5 * lit);
  EXPECT_NEAR(seen(false, false), kBack * lit, 1e-5 * lit);
  // A back that is lit through the sheet would be a fault.
  EXPECT_EQ(seen(false, true), 0.0);
  EXPECT_EQ(seen(true, false), 0.0);
}

}  // namespace
}  // namespace ifov::test_panes
