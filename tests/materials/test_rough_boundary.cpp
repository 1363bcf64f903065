// Rough boundaries of media: energy, reciprocity, densities, and the smooth boundary that they come to.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/boundary/rough_boundary.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/microfacet/facet_reflection.h"
#include "materials/bsdf/microfacet/facet_refraction.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/lobe_checks.h"
#include "radiometry/fresnel.h"

namespace ifov::materials::test_rough_boundary {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;

constexpr double kGlass = 1.5;

Spectrum one(double value) { return Spectrum::constant(value); }

std::shared_ptr<const Bsdf> rough(double width, FacetShape shape = FacetShape::ggx, double n = kGlass,
                                  double factor = 1.0) {
  return RoughBoundary::make(one(n), one(0.0), one(factor), {shape, width});
}

Vec3 at_cosine(double cosine) { return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }

/// Share of light from everywhere that leaves towards `cosine` by way of `side`.
double leaves(const Bsdf& bsdf, Side side, double cosine) {
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const Spectrum& spectrum : bsdf.spectra()) values.push_back(static_cast<float>(spectrum.at(1.0)));
  for (const float& value : values) rows.push_back(&value);
  float found = 0.0f;
  directional_hemispherical(bsdf, side, rows, 1, cosine, &found);
  return static_cast<double>(found);
}

TEST(RoughBoundary, AllLightGoesOnWhereNothingAbsorbs) {
  for (const FacetShape shape : {FacetShape::ggx, FacetShape::beckmann})
    for (const double width : {0.02, 0.2, 1.0}) {
      const auto outside = rough(width, shape), within = outside->behind();
      for (const auto& side : {outside, within})
        for (const double cosine : {1.0, 0.74, 0.3, 0.05})
          EXPECT_NEAR(leaves(*side, Side::reflected, cosine) + leaves(*side, Side::transmitted, cosine), 1.0,
                      cosine < 0.1 ? 2e-3 : 1e-3)
              << width << ' ' << cosine << (side == within ? " within" : " outside");
    }
}

TEST(RoughBoundary, WhatFacetsSendToOthersIsMuchOfIt) {
  // The twin that forgets it: facets that reflect and refract once, by samples of theirs.
  const double width = 1.0;
  const FacetDistribution facets(FacetShape::ggx, width, width);
  const Vec3 out = at_cosine(0.3);
  double sum = 0.0;
  constexpr int kDraws = 1 << 14;
  for (int k = 0; k < kDraws; ++k) {
    const auto key = static_cast<std::uint64_t>(k);
    const Vec3 facet =
        facets.sample_visible(out, {sampling::unit_double(2 * key), sampling::unit_double(2 * key + 1)});
    const double cosine = math::dot(out, facet);
    const radiometry::FresnelAmplitudes r = radiometry::fresnel_reflection_amplitudes({kGlass, 0.0}, cosine);
    const double fresnel = 0.5 * (std::norm(r.p) + std::norm(r.s));
    const Vec3 back = 2.0 * cosine * facet - out, bent = refracted_by(facet, out, kGlass);
    if (back.z > 0.0) {
      const FacetReflection once(facets, out, back);
      sum += fresnel * once.bsdf * back.z / once.density / kDraws;
    }
    if (bent.z < 0.0) {
      const FacetRefraction once(facets, out, bent, kGlass);
      ASSERT_LE(once.bsdf * -bent.z, once.density * (1.0 + 1e-9));
      sum += (1.0 - fresnel) * once.bsdf * -bent.z / once.density / kDraws;
    }
  }
  EXPECT_LT(sum, 0.9);
  EXPECT_GT(sum, 0.2);
}

TEST(RoughBoundary, OfNoRoughnessItIsSmooth) {
  const auto outside = rough(0.01, FacetShape::beckmann),
             smooth = smooth::make(one(kGlass), one(0.0), one(1.0), true);
  for (const double angle : {0.0, 0.5, 0.9, 1.2}) {
    const double cosine = std::cos(angle);
    EXPECT_NEAR(leaves(*outside, Side::reflected, cosine), leaves(*smooth, Side::reflected, cosine), 5e-4)
        << angle;
    EXPECT_NEAR(leaves(*outside, Side::transmitted, cosine), leaves(*smooth, Side::transmitted, cosine),
                5e-3 * leaves(*smooth, Side::transmitted, cosine));
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (kGlass * kGlass));
    EXPECT_NEAR(leaves(*outside->behind(), Side::transmitted, inside),
                leaves(*smooth, Side::transmitted, cosine), 5e-3 * leaves(*smooth, Side::transmitted, cosine))
        << angle;
    // Bent as Snell has it, in the mean.
    BsdfEvent view{at_cosine(cosine), {}, {0, 0, 1}, {}, Side::transmitted};
    Vec3 mean;
    for (int i = 0; i < 64; ++i)
      for (int j = 0; j < 64; ++j) {
        const double seam = outside->seam(view);
        mean =
            mean +
            outside->sample(view, seam + (1.0 - seam) * (i + 0.5) / 64.0, (j + 0.5) / 64.0).incoming / 4096.0;
      }
    EXPECT_NEAR(mean.x, -std::sin(angle) / kGlass, 1e-3) << angle;
    EXPECT_NEAR(mean.y, 0.0, 1e-3);
  }
  EXPECT_NEAR(leaves(*outside->behind(), Side::reflected, 0.5), 1.0, 1e-3) << "totally";
}

TEST(RoughBoundary, IsReciprocal) {
  const FacetDistribution facets(FacetShape::ggx, 0.4, 0.4);
  for (const double out : {0.95, 0.5, 0.1})
    for (const double in : {0.99, 0.6, 0.3})
      for (const double azimuth : {0.0, 2.0, pi}) {
        const double sine = std::sqrt(1.0 - in * in);
        const Vec3 a = at_cosine(out), b{sine * std::cos(azimuth), sine * std::sin(azimuth), -in};
        const FacetRefraction there(facets, a, b, kGlass);
        const FacetRefraction back(facets, {b.x, b.y, -b.z}, {a.x, a.y, -a.z}, 1.0 / kGlass);
        EXPECT_NEAR(there.bsdf, kGlass * kGlass * back.bsdf, 1e-9 * there.bsdf);
      }
  // The whole of it, with what is sent to other facets.
  const auto outside = rough(0.7);
  const BsdfEvent there{
      at_cosine(0.6), {-0.3, 0.2, -std::sqrt(1.0 - 0.13)}, {0, 0, 1}, {}, Side::transmitted};
  const BsdfEvent back{there.incoming, there.outgoing, {0, 0, -1}, {}, Side::transmitted};
  const double one_way = test::brdf_at(*outside, there), other = test::brdf_at(*outside->behind(), back);
  EXPECT_NEAR(one_way, kGlass * kGlass * other, 1e-6 * one_way);
  EXPECT_GT(std::abs(one_way - other), 0.5 * other) << "n^2 is seen";
}

/// Chi-square of samples against the density, as a probability, over cells of cosine and azimuth and what is not sent.
double samples_fit(const Bsdf& bsdf, Side side, double cosine, double bias = 0.0) {
  constexpr int kRings = 12, kSectors = 12, kFine = 24, kDraws = 1 << 16;
  BsdfEvent event{at_cosine(cosine), {}, {0, 0, 1}, {}, side};
  const double sign = side == Side::reflected ? 1.0 : -1.0;
  std::vector<double> counted(kRings * kSectors + 1, 0.0), expected(kRings * kSectors + 1, 0.0);
  for (int k = 0; k < kDraws; ++k) {
    const auto key = static_cast<std::uint64_t>(k);
    const BsdfSample s =
        bsdf.sample(event, sampling::unit_double(2 * key), sampling::unit_double(2 * key + 1));
    std::size_t cell = kRings * kSectors;
    if (s.weight > 0.0) {
      const double z = std::min(1.0, std::abs(s.incoming.z + bias));
      const int ring = std::min(kRings - 1, static_cast<int>(kRings * z));
      const double turn = std::atan2(s.incoming.y, s.incoming.x) / (2.0 * pi) + 0.5;
      cell = static_cast<std::size_t>(ring * kSectors +
                                      std::min(kSectors - 1, static_cast<int>(kSectors * turn)));
    }
    counted[cell] += 1.0;
  }
  double whole = 0.0;
  for (int ring = 0; ring < kRings * kFine; ++ring)
    for (int sector = 0; sector < kSectors * kFine; ++sector) {
      const double z = (ring + 0.5) / (kRings * kFine),
                   azimuth = 2.0 * pi * ((sector + 0.5) / (kSectors * kFine) - 0.5);
      const double r = std::sqrt(1.0 - z * z);
      event.incoming = {r * std::cos(azimuth), r * std::sin(azimuth), sign * z};
      const double share = bsdf.pdf(event) * 2.0 * pi / (kRings * kSectors * kFine * kFine);
      expected[static_cast<std::size_t>(ring / kFine * kSectors + sector / kFine)] += share * kDraws;
      whole += share;
    }
  expected.back() = std::max(0.0, 1.0 - whole) * kDraws;
  for (double& count : expected) count = std::max(count, 1e-9);
  return ifov::test::chi_square_test(counted, expected);
}

TEST(RoughBoundary, SamplesFollowTheDensity) {
  for (const FacetShape shape : {FacetShape::ggx, FacetShape::beckmann}) {
    const auto outside = rough(0.45, shape), within = outside->behind();
    for (const Side side : {Side::reflected, Side::transmitted})
      for (const double cosine : {0.7}) {
        EXPECT_GT(samples_fit(*outside, side, cosine), 1e-4) << cosine;
        EXPECT_GT(samples_fit(*within, side, cosine), 1e-4) << cosine << " within";
      }
  }
  EXPECT_LT(samples_fit(*rough(0.45), Side::transmitted, 0.95, 0.01), 1e-4) << "a planted shift";
}

TEST(RoughBoundary, InvertsItsWarp) {
  for (const auto& bsdf : {rough(0.1), rough(0.1)->behind(), rough(0.8, FacetShape::beckmann)})
    for (const Side side : {Side::reflected, Side::transmitted}) {
      BsdfEvent event{at_cosine(0.8), {}, {0, 0, 1}, {}, side};
      for (int k = 0; k < 200; ++k) {
        const auto key = static_cast<std::uint64_t>(k);
        const BsdfSample s =
            bsdf->sample(event, sampling::unit_double(2 * key), sampling::unit_double(2 * key + 1));
        if (!(s.weight > 0.0)) continue;
        event.incoming = s.incoming;
        const UnitSquarePoint u = bsdf->invert(event);
        EXPECT_LT(math::length(bsdf->sample(event, u.u1, u.u2).incoming - s.incoming), 1e-9);
      }
    }
}

TEST(RoughBoundary, KnowsWhatItCannotDo) {
  EXPECT_TRUE(passes_rarely(*rough(0.3)));
  EXPECT_FALSE(passes_rarely(*rough(0.5)));
  try {
    rough(0.5, FacetShape::ggx, 1.0);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "a medium of index 1 behind a rough boundary: it has to be 1.01 or more, or its facets would bend nothing");
  }
  // Dirt takes of what is reflected alone.
  const auto clean = rough(0.5), dirty = rough(0.5, FacetShape::ggx, kGlass, 0.5);
  EXPECT_NEAR(leaves(*dirty, Side::reflected, 0.8), 0.5 * leaves(*clean, Side::reflected, 0.8), 1e-6);
  EXPECT_NEAR(leaves(*dirty, Side::transmitted, 0.8), leaves(*clean, Side::transmitted, 0.8), 1e-6);
}

}  // namespace
}  // namespace ifov::materials::test_rough_boundary
