#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/rough_dielectric.h"
#include "materials/lobe_checks.h"

namespace ifov::materials::test_rough_dielectric {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;

constexpr double kWidths[] = {0.02, 0.1, 0.4, 1.0};
constexpr FacetShape kShapes[] = {FacetShape::ggx, FacetShape::beckmann};

RoughDielectric coat(double n, double base, FacetShape shape, double width) {
  return {Spectrum::constant(n), Spectrum::constant(base), shape, width};
}

TEST(RoughDielectric, OverAWhiteBaseAllComesBack) {
  for (const FacetShape shape : kShapes)
    for (const double width : kWidths)
      for (const double n : {1.0, 1.33, 1.5, 2.4}) {
        const RoughDielectric bsdf = coat(n, 1.0, shape, width);
        for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1, 0.05, 0.02})
          EXPECT_NEAR(test::hemispherical_at(bsdf, cosine), 1.0, 1e-3)
              << width << ' ' << n << ' ' << cosine << ' ' << static_cast<int>(shape);
      }
}

TEST(RoughDielectric, WithoutLightToAndFroMuchWouldBeMissing) {
  // The first passage alone would leave 1 - r = T_mean / n^2 of it: 0.40 for 1.5.
  const RoughDielectric white = coat(1.5, 1.0, FacetShape::beckmann, 0.02),
                        grey = coat(1.5, 0.5, FacetShape::beckmann, 0.02);
  const double whole = test::hemispherical_at(white, 1.0), half = test::hemispherical_at(grey, 1.0);
  // (1 - r) base / (1 - r base) of what is let in: by hand, with r = 1 - 0.90822 / 2.25.
  const double out = 0.90822 / 2.25;
  EXPECT_NEAR(half, 0.04 + 0.96 * out * 0.5 / (1.0 - (1.0 - out) * 0.5), 2e-3);
  EXPECT_LT(half, 0.6 * whole);
}

TEST(RoughDielectric, AlmostSmoothItIsSaundersonsCorrection) {
  // Facets of width 0.001: T is that of Fresnel, at 45 deg 1 - 0.05024.
  const RoughDielectric bsdf = coat(1.5, 0.3, FacetShape::beckmann, 0.001);
  const double out = 0.90822 / 2.25;
  EXPECT_NEAR(test::hemispherical_at(bsdf, std::sqrt(0.5)),
              0.05024 + (1.0 - 0.05024) * out * 0.3 / (1.0 - (1.0 - out) * 0.3), 2e-4);
}

TEST(RoughDielectric, SamplesFollowTheDensity) {
  const double least = 1e-3 / 24.0;
  for (const FacetShape shape : kShapes)
    for (const double width : kWidths) {
      const RoughDielectric bsdf = coat(1.5, 0.5, shape, width);
      for (const Vec3 out : {at(0.0, 0.0), at(0.8, 0.5), at(1.45, 2.0)})
        EXPECT_GT(test::samples_against_density(bsdf, out, width, width, 40000), least)
            << width << ' ' << out.z << ' ' << static_cast<int>(shape);
    }
}

TEST(RoughDielectric, IsReciprocalAndInvertsItsWarp) {
  for (const FacetShape shape : kShapes)
    for (const double width : kWidths) {
      const RoughDielectric bsdf = coat(1.5, 0.4, shape, width);
      for (const double out : {0.0, 0.5, 1.3, 1.55})
        for (const double in : {0.2, 0.5, 1.4}) {
          BsdfEvent event{at(out, 0.0), at(in, 2.5), {0, 0, 1}, {}, Side::reflected};
          const double there = test::brdf_at(bsdf, event);
          std::swap(event.outgoing, event.incoming);
          EXPECT_NEAR(test::brdf_at(bsdf, event), there, 2e-7 * there);  // float
        }
      double heaviest = 0.0;
      for (const double out : {0.3, 1.2, 1.5})
        for (int i = 0; i < 20; ++i)
          for (int j = 0; j < 20; ++j) {
            BsdfEvent event = test::view_of(at(out, 0.4));
            const BsdfSample sample = bsdf.sample(event, (i + 0.5) / 20, (j + 0.5) / 20);
            if (!(sample.weight > 0.0)) continue;
            event.incoming = sample.incoming;
            const UnitSquarePoint u = bsdf.invert(event);
            EXPECT_LT(math::length(bsdf.sample(event, u.u1, u.u2).incoming - sample.incoming), 1e-10);
            heaviest = std::max(heaviest, sample.weight * bsdf.grey(event));
          }
      EXPECT_LT(heaviest, 2.0) << width;
      EXPECT_GT(heaviest, 0.5) << width;
    }
}

TEST(RoughDielectric, ACoatHasAnIndexOfOneOrMore) {
  try {
    coat(0.9, 0.5, FacetShape::ggx, 0.1);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "the refractive index of a coat is 1 or more; here it falls to 0.9");
  }
}

}  // namespace
}  // namespace ifov::materials::test_rough_dielectric
