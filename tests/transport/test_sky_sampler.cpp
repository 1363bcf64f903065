#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sampling/sequence.h"
#include "transport/sky/sky_sampler.h"

namespace ifov::transport::test_sky_sampler {
namespace {

constexpr double kPi = std::numbers::pi;

/// A sky ten times brighter about the Sun, which stands in the north-east.
SkySampler uneven_sky() {
  std::vector<double> zenith, azimuth, brightness;
  for (int i = 0; i <= 9; ++i) zenith.push_back(0.5 * kPi * i / 9.0);
  for (int k = 0; k <= 6; ++k) azimuth.push_back(kPi * k / 6.0);
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 6; ++k) brightness.push_back(i >= 4 && i <= 5 && k == 0 ? 10.0 : 1.0 + 0.1 * i);
  return {zenith, azimuth, math::normalized(math::Vec3{1.0, 1.0, 1.0}), brightness};
}

template <class Value>
double over_hemisphere(const Value& value) {
  constexpr int kRings = 900, kTurns = 720;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kTurns; ++k) {
      const double zenith = 0.5 * kPi * (i + 0.5) / kRings, azimuth = 2.0 * kPi * (k + 0.5) / kTurns;
      const math::Vec3 d{std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth),
                         std::cos(zenith)};
      sum += value(d) * std::sin(zenith) * (0.5 * kPi / kRings) * (2.0 * kPi / kTurns);
    }
  return sum;
}

TEST(SkySampler, DensityIntegratesToOne) {
  const SkySampler sky = uneven_sky();
  EXPECT_NEAR(over_hemisphere([&](math::Vec3 d) { return sky.density(d); }), 1.0, 2e-3);
}

/// Means over drawn directions, weighted by 1 / density, are integrals; with a density that is wrong they are not.
TEST(SkySampler, DrawsWhatItsDensitySays) {
  const SkySampler sky = uneven_sky();
  const auto f = [](math::Vec3 d) { return d.z * (1.0 + d.x + 0.5 * d.x * d.y); };
  const double expected = over_hemisphere(f);
  constexpr std::uint32_t kCount = 1u << 16;
  double mean = 0.0, wrong = 0.0;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const math::Vec3 d = sky.sample(sampling::sequence_point(17, k, 0));
    EXPECT_NEAR(math::length(d), 1.0, 1e-12);
    ASSERT_GT(d.z, 0.0);
    mean += f(d) / sky.density(d) / kCount;
    wrong += f(d) / (d.z / kPi) / kCount;  // as if directions were drawn by the cosine alone
  }
  EXPECT_NEAR(mean, expected, 2e-3 * expected);
  EXPECT_GT(std::abs(wrong - expected), 5e-2 * expected);
}

TEST(SkySampler, NothingBelowTheHorizon) {
  const SkySampler sky = uneven_sky();
  EXPECT_EQ(sky.density({0.6, 0.0, -0.8}), 0.0);
  EXPECT_TRUE(SkySampler().empty());
}

}  // namespace
}  // namespace ifov::transport::test_sky_sampler
