#include <gtest/gtest.h>

#include <cmath>

#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "radiometry/planck.h"
#include "studies/common/study_document.h"
#include "studies/common/texture_map.h"
#include "studies/thermal_scene.h"

namespace ifov::studies::test_thermal_scene {
namespace {

TEST(ThermalScene, RadiancesOfThePaper) {
  EXPECT_NEAR(hot_radiance(), 12.113897, 5e-7);
  EXPECT_NEAR(cold_radiance(), 8.366091, 5e-7);
  EXPECT_NEAR(dome_scene(paper_dome()).truth, 10.239994, 1e-6);
  EXPECT_NEAR(error_c(0.01), 0.05303, 1e-5);
  EXPECT_NEAR(error_c(hot_radiance() - cold_radiance()), 19.873, 1e-3);
  EXPECT_EQ(radiance_of_error(0.1).value, 0.0188585314);
  EXPECT_EQ(radiance_of_error(0.1).unit, io::ErrorSize::Unit::radiance);
}

TEST(ThermalScene, FamiliesFillThePixelAsTheySay) {
  const TextureMap texture(1, 5.0);
  for (int trial = 0; trial < 50; ++trial) {
    EXPECT_NEAR(random_scene(Family::dome, 1, trial, texture).hot_fraction, 0.5, 1e-12);
    EXPECT_NEAR(random_scene(Family::small_target, 1, trial, texture).hot_fraction, 0.005, 1e-12);
    const double square = random_scene(Family::square, 1, trial, texture).hot_fraction;
    EXPECT_GT(square, 0.4);
    EXPECT_LE(square, 0.5 + 1e-12);
    const double rod = random_scene(Family::rod, 1, trial, texture).hot_fraction;
    EXPECT_GE(rod, 0.0);
    EXPECT_LT(rod, 0.1);
  }
}

TEST(ThermalScene, DocumentsAreValid) {
  const TextureMap texture(1, 5.0);
  for (Family family : {Family::dome, Family::square, Family::rod, Family::small_target, Family::large_target,
                        Family::textured_dome}) {
    const ThermalScene scene = random_scene(family, 1, 0, texture);
    for (const io::SamplingDocument& sampling :
         {single_sampling(), grid_sampling(3),
          adaptive_sampling(3, 100, {0.01, io::ErrorSize::Unit::fraction}),
          accuracy_sampling({0.1, io::ErrorSize::Unit::kelvin},
                            [](io::AccuracySampling& a) { a.pilot_rays = false; })}) {
      const io::Document document = io::parse_document(study_text(scene.document(sampling, 7)), "study.json");
      EXPECT_EQ(document.seed, 7u);
      EXPECT_EQ(document.scene.objects.size(), 2u);
    }
  }
}

TEST(ThermalScene, TextureOnUniformGroundIsTheMeanOfItsRadiance) {
  const TextureMap texture(3, 5.0);
  const Disc nowhere{10.0, 10.0, 0.1};
  const ThermalScene scene = textured_dome_scene(nowhere, texture, 0.5, 4.5);
  double sum = 0.0;
  constexpr int kFine = 700;
  for (int j = 0; j < kFine; ++j)
    for (int i = 0; i < kFine; ++i)
      sum +=
          radiometry::planck_w_m2_sr_um(
              kThermalWavelength_um, kCold_k + texture.at(1.5 + (i + 0.5) / kFine, 3.5 - (j + 0.5) / kFine)) /
          (kFine * kFine);
  EXPECT_NEAR(scene.truth, sum, 1e-5);
}

TEST(TextureMap, HasItsRms) {
  const TextureMap texture(5, 5.0);
  double squares = 0.0;
  for (int j = 0; j < 200; ++j)
    for (int i = 0; i < 200; ++i)
      squares += std::pow(texture.at(0.02 + i * 0.0245, 0.02 + j * 0.0245), 2) / 40000.0;
  EXPECT_NEAR(std::sqrt(squares), 2.0, 0.2);
}

}  // namespace
}  // namespace ifov::studies::test_thermal_scene
