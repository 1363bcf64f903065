// Light through rough boundaries of media: furnaces, the smooth plate that they come to, and suns against a sky.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf/boundary/rough_boundary.h"
#include "materials/bsdf/boundary/slab.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/rough_conductor.h"
#include "radiometry/planck.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_rough_boundaries {
namespace {

using materials::Bsdf;
using materials::FacetShape;
using materials::RoughBoundary;
using materials::Side;
using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::SmallScene;

constexpr double kGlass = 1.5;

Spectrum one(double value) { return Spectrum::constant(value); }

std::shared_ptr<const Bsdf> rough(double width, double k = 0.0) {
  return RoughBoundary::make(one(kGlass), one(k), one(1.0), {FacetShape::ggx, width});
}

double planck() { return radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0); }

/// A ball that absorbs in a glossy room, all at one temperature.
SmallScene::Estimate warm_room(const std::shared_ptr<const Bsdf>& ball, Vec3 towards) {
  SmallScene scene;
  const auto gloss = std::make_shared<materials::RoughConductor>(
      one(2.0), one(1.0), one(1.0), materials::RoughConductor::Facets{FacetShape::ggx, 0.3, 0.3, 0.0});
  scene.place(geometry::Box{{-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}}, scene.material(0.1, 300.0, gloss));
  scene.place(geometry::Sphere{{0.0, 0.0, -0.5}, 0.5}, scene.material(0.1, 300.0, ball));
  scene.build();
  return scene.radiance({{0.0, 0.0, 1.0}, math::normalized(towards)}, 1 << 13);
}

TEST(RoughBoundaries, WarmRoomReturnsPlanck) {
  for (const double width : {0.02, 1.0}) {
    const auto found = warm_room(rough(width, 1e-6), {0.2, 0.1, -1.0});
    EXPECT_LT(found.standard_error, 1.5e-2 * planck());
    EXPECT_NEAR(found.mean, planck(), 3.0 * found.standard_error + 1e-3 * planck()) << width;
  }
}

/// A cold ball in a warm one: what it does not lose.
SmallScene::Estimate cold_ball(const std::shared_ptr<const Bsdf>& ball) {
  SmallScene scene;
  scene.place(geometry::Sphere{{0.0, 0.0, 0.0}, 0.5}, scene.material(0.1, 0.0, ball));
  scene.place(geometry::Sphere{{0.0, 0.0, 0.0}, 9.0}, scene.material(0.0, 300.0));
  scene.build();
  return scene.radiance({{0.0, 0.0, 3.0}, math::normalized({0.08, 0.0, -1.0})}, 1 << 12);
}

TEST(RoughBoundaries, PlantedFaultOfTheSquareOfTheIndexIsSeen) {
  // From within as if the index were another: n^2 is not taken back.
  class Wrong final : public Bsdf {
   public:
    bool may_transmit() const override { return true; }
    materials::Passage passage() const override { return materials::Passage::into; }
    std::shared_ptr<const Bsdf> behind() const override { return right_->behind(); }
    double bending_index() const override { return kGlass; }
    materials::BsdfSample sample(const materials::BsdfEvent& view, double a, double b) const override {
      return right_->sample(view, a, b);
    }
    double pdf(const materials::BsdfEvent& event) const override { return right_->pdf(event); }
    std::span<const Spectrum> spectra() const override { return right_->spectra(); }
    void evaluate(const materials::BsdfEvent& event, materials::ParameterSpectra rows, std::size_t count,
                  float* bsdf) const override {
      right_->evaluate(event, rows, count, bsdf);
      if (event.side == Side::transmitted)
        for (std::size_t n = 0; n < count; ++n) bsdf[n] /= static_cast<float>(kGlass * kGlass);
    }

   private:
    std::shared_ptr<const Bsdf> right_ = rough(0.2);
  };
  // What it does not pass on it emits: the fault shows in a cold ball.
  EXPECT_LT(cold_ball(std::make_shared<Wrong>()).mean, 0.8 * planck());
}

TEST(RoughBoundaries, ColdBallInAWarmOneLooksAsWarm) {
  for (const double width : {0.02, 0.5}) {
    const auto found = cold_ball(rough(width));
    EXPECT_NEAR(found.mean, planck(), 3.0 * found.standard_error + 1e-3 * planck()) << width;
    EXPECT_LT(found.standard_error, 0.03 * planck());
  }
}

TEST(RoughBoundaries, AlmostSmoothPlateIsAPane) {
  const auto pane = materials::slab::make(one(kGlass), one(0.0), 4e-3, one(1.0));
  const auto share = [&](Side side, double cosine) {
    return materials::directional_hemispherical(*pane, side, cosine).at(SmallScene::kWavelength_um);
  };
  const auto rough_plate = rough(0.01);
  for (const Vec3 towards : {Vec3{0.8, 0.0, -1.0}}) {
    const Vec3 down = math::normalized(towards);
    for (const bool through : {true, false}) {
      SmallScene scene;
      scene.place(geometry::Plane{}, scene.material(0.0, through ? 300.0 : 0.0));
      scene.place(geometry::Box{{-90.0, -90.0, 2.0}, {90.0, 90.0, 2.3}},
                  scene.material(0.1, 0.0, rough_plate));
      if (!through) scene.sky(planck());
      scene.build();
      const auto found = scene.radiance({{0.1, 0.2, 4.0}, down}, 1 << 14);
      const double expected = planck() * share(through ? Side::transmitted : Side::reflected, -down.z);
      EXPECT_LT(found.standard_error, 0.04 * expected);
      EXPECT_NEAR(found.mean, expected, 3.0 * found.standard_error + 5e-3 * expected) << through;
    }
  }
}

/// A grey bed under a rough surface, seen from above.
SmallScene::Estimate bed(double sun_cosine, double irradiance, double sky, std::uint32_t paths,
                         const std::shared_ptr<const Bsdf>& glass) {
  SmallScene scene;
  scene.place(geometry::Plane{-0.5}, scene.material(0.8));
  scene.place(geometry::Box{{-500.0, -500.0, -1.0}, {500.0, 500.0, 0.0}}, scene.material(0.1, 0.0, glass));
  if (irradiance > 0.0)
    scene.sun({std::sqrt(1.0 - sun_cosine * sun_cosine), 0.0, sun_cosine}, irradiance, 0.0);
  if (sky > 0.0) scene.sky(sky);
  scene.build();
  return scene.radiance({{0.1, 0.2, 4.0}, {0.0, 0.0, -1.0}}, paths);
}

TEST(RoughBoundaries, SunsOfAllDirectionsAreASky) {
  // Gauss and Legendre over the cosine: a sky of radiance 1 is suns of irradiance 2 pi.
  constexpr double kNode[] = {0.1127016653792583, 0.5, 0.8872983346207417},
                   kWeight[] = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
  const auto glass = rough(0.6);
  double suns = 0.0, variance = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto found = bed(kNode[k], 2.0 * pi, 0.0, 1 << 13, glass);
    suns += kWeight[k] * found.mean;
    variance += std::pow(kWeight[k] * found.standard_error, 2);
  }
  const auto sky = bed(1.0, 0.0, 1.0, 1 << 13, glass);
  const double error = std::hypot(std::sqrt(variance), sky.standard_error);
  EXPECT_LT(error, 0.035 * sky.mean);
  EXPECT_NEAR(suns, sky.mean, 3.0 * error + 0.01 * sky.mean);
}

}  // namespace
}  // namespace ifov::test_rough_boundaries
