#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "scene/solved_temperature.h"
#include "transport/small_scene.h"

namespace ifov::test_light_by_chance {
namespace {

/// Asked for by chance: `times` what it sends more than at 290 K.
struct Estimated final : scene::SolvedTemperature {
  scene::EstimatedTemperature estimate;
  scene::EstimatedTemperature at(const geometry::SurfacePoint&, std::uint64_t, double) const override {
    return estimate;
  }
  double coldest_k() const override { return 280.0; }
  double hottest_k() const override { return 320.0; }
};

/// Planck's law with CODATA's second constant, of 2 h c^2 for 1.
double planck(double kelvin) {
  return 1.191042972e8 / std::pow(test::SmallScene::kWavelength_um, 5) /
         (std::exp(14387.76877 / (test::SmallScene::kWavelength_um * kelvin)) - 1.0);
}

double radiance_of(const scene::EstimatedTemperature& estimate) {
  test::SmallScene scene;
  const std::uint32_t material = scene.material(0.3);
  auto solved = std::make_shared<Estimated>();
  solved->estimate = estimate;
  scene.scene().solved = {solved};
  scene.scene().states[material].solved = 1;
  scene.place(geometry::Plane{}, material);
  scene.build();
  return scene.radiance({.origin_m = {0.0, 0.0, 5.0}, .direction = {0.0, 0.0, -1.0}}, 2).mean;
}

TEST(LightByChance, CountsByTheInverseOfTheChance) {
  constexpr double kEmissivity = 0.7;
  const double other = planck(290.0), light = planck(310.0);
  EXPECT_NEAR(radiance_of({310.0}), kEmissivity * light, 1e-4 * light);
  EXPECT_NEAR(radiance_of({310.0, 0.0, 290.0, 4.0}), kEmissivity * (other + 4.0 * (light - other)),
              5e-4 * light);
  // Of an estimate that scatters by 3 K what the bend of Planck's law brings is taken away first.
  const double straight = 2.0 * light - 0.5 * (planck(307.0) + planck(313.0));
  EXPECT_NEAR(radiance_of({310.0, 3.0, 290.0, 4.0}), kEmissivity * (other + 4.0 * (straight - other)),
              5e-4 * light);
}

}  // namespace
}  // namespace ifov::test_light_by_chance
