// Light that joins pixels when the sampler is done: an error in percent is one of the whole.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "accuracy_scenes.h"
#include "sampling/hash.h"
#include "sampling/pixel_limits.h"

namespace ifov::test::test_later_light {
namespace {

/// Three by three pixels of 1 with noise of half of it, which will have `later` each, known to `uncertain`.
sampling::TileResult noisy(double later, double uncertain, std::uint64_t seed) {
  ShapeField field([](double, double) { return sampling::Label{1}; },
                   [](sampling::Label, double x, double y, int) {
                     const std::uint64_t key = sampling::hash(static_cast<std::uint64_t>(1e9 * x),
                                                              static_cast<std::uint64_t>(1e9 * y));
                     return static_cast<float>(0.5 + sampling::unit_double(key));
                   });
  const Percent percent;
  const sampling::PixelFootprint box = sampling::PixelFootprint::box(1.0);
  const int steering_channels[] = {0};
  sampling::LaterLight light;
  light.columns = 1;
  light.mean.assign(9, static_cast<float>(later));
  light.half_width.assign(9, static_cast<float>(uncertain));
  sampling::TileProblem problem;
  problem.tile = {0, 0, 3, 3};
  problem.image = {-4, -4, 7, 7};
  problem.seed = seed;
  problem.footprint = &box;
  problem.tolerance = &percent;
  problem.steering_channels = steering_channels;
  if (later > 0.0) problem.later = &light;
  sampling::TileResult result;
  sampling::AccuracySampler(sampling::AccuracyOptions()).sample(problem, field, result);
  return result;
}

TEST(LaterLight, AnErrorInPercentIsOneOfTheWholePixel) {
  const sampling::TileResult alone = noisy(0.0, 0.0, 1), lit = noisy(4.0, 0.0, 1);
  for (std::size_t p = 0; p < 9; ++p) {
    EXPECT_TRUE(alone.converged(p) && lit.converged(p));
    EXPECT_LE(alone.half_width[p], 0.0101F);
    EXPECT_LE(lit.half_width[p], 0.0505F);
    EXPECT_NEAR(lit.mean[p], 1.0, 0.1);  // what joins is no business of the sampler
  }
  EXPECT_LT(5 * lit.samples[4], alone.samples[4]);
}

TEST(LaterLight, RoomIsLeftForWhatItIsUncertainBy) {
  int held = 0, wide = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const sampling::TileResult left = noisy(4.0, 0.04, seed), none = noisy(4.0, 0.0, seed);
    for (std::size_t p = 0; p < 9; ++p) {
      held += std::hypot(static_cast<double>(left.half_width[p]), 0.04) <= 0.0505;
      wide += std::hypot(static_cast<double>(none.half_width[p]), 0.04) > 0.0505;  // planted fault: no room
    }
  }
  EXPECT_EQ(held, 180);
  EXPECT_GT(wide, 20);
}

}  // namespace
}  // namespace ifov::test::test_later_light
