#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "materials/lambertian.h"
#include "materials/scattering.h"

namespace ifov::materials {
namespace {

using math::Vec3;

/// Points of a regular grid, shifted off its edges: deterministic, and finer than any random set of that
/// size.
double grid(int i, int n) { return (i + 0.5) / n; }

const math::Normal3 kTilted = math::as_normal(math::normalized({0.3, -0.5, 0.7}));

/// Largest relative deviation of sample() from pdf() over 64 cells of equal solid angle, for a grid of
/// `draws` x `draws` numbers, which leaves no noise but that of the cells' edges.
double worst_cell(const Scattering& shape, int draws) {
  constexpr int kRings = 8, kSectors = 8;
  const Vec3 n = kTilted.as_vector(), outgoing = n;
  const Vec3 a = math::normalized(math::cross(n, {1.0, 0.0, 0.0})), b = math::cross(n, a);
  std::vector<double> counted(kRings * kSectors, 0.0), expected(kRings * kSectors, 0.0);
  const auto cell = [&](Vec3 d) {
    const double azimuth = std::atan2(math::dot(d, b), math::dot(d, a)) / (2.0 * std::numbers::pi) + 0.5;
    const int ring = std::min(kRings - 1, static_cast<int>(math::dot(d, n) * kRings));
    const int sector = std::min(kSectors - 1, static_cast<int>(azimuth * kSectors));
    return static_cast<std::size_t>(ring * kSectors + sector);
  };
  for (int i = 0; i < draws; ++i)
    for (int j = 0; j < draws; ++j) {
      const ScatterSample s = shape.sample(outgoing, kTilted, grid(i, draws), grid(j, draws));
      EXPECT_GT(math::dot(s.incoming, n), 0.0);
      EXPECT_NEAR(s.pdf, shape.pdf(outgoing, s.incoming, kTilted), 1e-12);
      counted[cell(s.incoming)] += 1.0 / draws / draws;
    }
  constexpr int kFine = 40;
  for (int i = 0; i < kRings * kFine; ++i)
    for (int j = 0; j < kSectors * kFine; ++j) {
      const double z = grid(i, kRings * kFine),
                   azimuth = 2.0 * std::numbers::pi * (grid(j, kSectors * kFine) - 0.5);
      const double r = std::sqrt(1.0 - z * z);
      const Vec3 d = r * std::cos(azimuth) * a + r * std::sin(azimuth) * b + z * n;
      expected[cell(d)] +=
          shape.pdf(outgoing, d, kTilted) * 2.0 * std::numbers::pi / (kRings * kSectors * kFine * kFine);
    }
  double worst = 0.0, total = 0.0;
  for (std::size_t c = 0; c < counted.size(); ++c) {
    worst = std::max(worst, std::abs(counted[c] - expected[c]) / expected[c]);
    total += expected[c];
  }
  EXPECT_NEAR(total, 1.0, 1e-3);
  return worst;
}

/// A fault: directions uniform over the hemisphere with the density of a cosine.
class Skewed final : public Scattering {
 public:
  bool is_delta() const override { return false; }
  ScatterSample sample(Vec3, math::Normal3 normal, double u1, double u2) const override {
    const Vec3 n = normal.as_vector();
    const Vec3 a = math::normalized(math::cross(n, {1.0, 0.0, 0.0})), b = math::cross(n, a);
    const double r = std::sqrt(1.0 - u1 * u1), azimuth = 2.0 * std::numbers::pi * u2;
    return {r * std::cos(azimuth) * a + r * std::sin(azimuth) * b + u1 * n, 1.0, u1 / std::numbers::pi,
            false};
  }
  double evaluate(Vec3 o, Vec3 i, math::Normal3 n) const override { return Lambertian().evaluate(o, i, n); }
  double pdf(Vec3 o, Vec3 i, math::Normal3 n) const override { return Lambertian().pdf(o, i, n); }
  UnitSquarePoint invert(Vec3, Vec3, math::Normal3) const override { return {}; }
};

TEST(Lambertian, SamplesFollowTheDensity) {
  EXPECT_LT(worst_cell(scattering(ScatteringKind::lambertian), 1000), 0.05);
}

TEST(Lambertian, AWrongDensityIsSeen) { EXPECT_GT(worst_cell(Skewed(), 1000), 0.2); }

TEST(Lambertian, ScattersAllAndWeightsAreTheBrdf) {
  const Scattering& shape = scattering(ScatteringKind::lambertian);
  double sum = 0.0;
  constexpr int kDraws = 64;
  for (int i = 0; i < kDraws; ++i)
    for (int j = 0; j < kDraws; ++j) {
      const auto s = shape.sample(kTilted.as_vector(), kTilted, grid(i, kDraws), grid(j, kDraws));
      const double cosine = math::dot(kTilted, s.incoming);
      EXPECT_NEAR(s.weight, shape.evaluate(kTilted.as_vector(), s.incoming, kTilted) * cosine / s.pdf, 1e-12);
      sum += s.weight / kDraws / kDraws;
    }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_EQ(shape.evaluate(kTilted.as_vector(), -kTilted.as_vector(), kTilted), 0.0);
}

TEST(Lambertian, InvertsItsWarp) {
  const Scattering& shape = scattering(ScatteringKind::lambertian);
  for (const math::Normal3 n :
       {kTilted, math::Normal3{0, 0, 1}, math::Normal3{0, 0, -1}, math::Normal3{1, 0, 0}})
    for (int i = 0; i < 17; ++i)
      for (int j = 0; j < 17; ++j) {
        const auto s = shape.sample(n.as_vector(), n, grid(i, 17), grid(j, 17));
        const UnitSquarePoint u = shape.invert(n.as_vector(), s.incoming, n);
        if (i == 8 && j == 8) continue;  // the centre of the disk has no azimuth
        EXPECT_NEAR(u.u1, grid(i, 17), 1e-9);
        EXPECT_NEAR(u.u2, grid(j, 17), 1e-9);
      }
}

TEST(Mirror, ReflectsAboutTheNormal) {
  const Scattering& shape = scattering(ScatteringKind::mirror);
  const double r = std::numbers::sqrt2 / 2.0;
  const auto s = shape.sample({r, 0.0, r}, {0.0, 0.0, 1.0}, 0.3, 0.9);
  EXPECT_NEAR(s.incoming.x, -r, 1e-15);
  EXPECT_NEAR(s.incoming.z, r, 1e-15);
  EXPECT_TRUE(s.delta);
  EXPECT_EQ(s.weight, 1.0);
  EXPECT_TRUE(shape.is_delta());
  EXPECT_EQ(shape.evaluate({r, 0.0, r}, s.incoming, {0.0, 0.0, 1.0}), 0.0);
  const auto grazing = shape.sample(math::normalized({1.0, 0.2, 1e-6}), kTilted, 0.0, 0.0);
  EXPECT_NEAR(math::length(grazing.incoming), 1.0, 1e-14);
}

TEST(Scattering, EveryKindHasItsRow) {
  const auto entries = scattering_entries();
  ASSERT_EQ(entries.size(), 2u);
  for (std::size_t i = 0; i < entries.size(); ++i) EXPECT_EQ(static_cast<std::size_t>(entries[i].kind), i);
  EXPECT_EQ(entries[0].name, "lambertian");
  EXPECT_EQ(entries[1].name, "mirror");
  EXPECT_FALSE(scattering(ScatteringKind::lambertian).is_delta());
}

}  // namespace
}  // namespace ifov::materials
