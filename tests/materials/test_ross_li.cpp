#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/ross_li.h"
#include "materials/material.h"
#include "materials/reflectance_events.h"
#include "support/truth_data.h"

namespace ifov::materials::test_ross_li {
namespace {

using radiometry::Spectrum;
using std::numbers::pi;
using test::event_of;
using test::kDegree;
using test::reflectance_factor;

using Kernels = std::array<double, 2>;

RossLi model(double isotropic, double volumetric, double geometric, double hot_spot_deg = 0.0) {
  return {Spectrum::constant(isotropic), Spectrum::constant(volumetric), Spectrum::constant(geometric),
          hot_spot_deg * kDegree};
}

/// Integrals of the kernels over light from all sides against cosine / pi, towards a view: midpoint rule, crowded at the horizon.
Kernels black_sky(const RossLi& bsdf, double view_deg, int rings = 200, int sectors = 180) {
  Kernels sum{};
  for (int i = 0; i < rings; ++i) {
    const double x = (i + 0.5) / rings, cosine = x * x, weight = 2.0 * cosine * 2.0 * x / rings / sectors;
    for (int j = 0; j < sectors; ++j) {
      const Kernels found =
          bsdf.kernels(event_of(view_deg, std::acos(cosine) / kDegree, 180.0 * (j + 0.5) / sectors));
      for (std::size_t k = 0; k < 2; ++k) sum[k] += weight * found[k];
    }
  }
  return sum;
}

Kernels white_sky(const RossLi& bsdf) {
  constexpr int kViews = 60;
  Kernels sum{};
  for (int i = 0; i < kViews; ++i) {
    const double x = (i + 0.5) / kViews, cosine = x * x, weight = 2.0 * cosine * 2.0 * x / kViews;
    const Kernels found = black_sky(bsdf, std::acos(cosine) / kDegree, 60, 60);
    for (std::size_t k = 0; k < 2; ++k) sum[k] += weight * found[k];
  }
  return sum;
}

/// Polynomials of the angle of the Sun in radians that Lucht et al. 2000 fit to the integrals (table I).
Kernels lucht(double sun_deg) {
  const double s = sun_deg * kDegree;
  return {-0.007574 - 0.070987 * s * s + 0.307588 * s * s * s,
          -1.284909 - 0.166314 * s * s + 0.041840 * s * s * s};
}

TEST(RossLi, KernelsHaveThePublishedWhiteSkyIntegrals) {
  // Lucht et al. 2000, table I; MODIS's albedo products use them.
  const Kernels found = white_sky(model(0.1, 0.1, 0.1));
  EXPECT_NEAR(found[0], 0.189184, 5e-4);
  EXPECT_NEAR(found[1], -1.377622, 1e-3);
  EXPECT_GT(std::abs(white_sky(model(0.1, 0.1, 0.1, 1.5))[0] - 0.189184), 5e-4) << "planted: with hot spot";
}

TEST(RossLi, KernelsFollowThePublishedBlackSkyPolynomials) {
  // The polynomials are fits: to 75 deg within 0.03 of the integrals.
  const RossLi bsdf = model(0.1, 0.1, 0.1);
  for (const double sun : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0}) {
    const Kernels found = black_sky(bsdf, sun), fit = lucht(sun);
    EXPECT_NEAR(found[0], fit[0], 0.03) << sun;
    EXPECT_NEAR(found[1], fit[1], 0.03) << sun;
  }
  EXPECT_GT(std::abs(black_sky(bsdf, 45.0)[0] - lucht(60.0)[0]), 0.03) << "planted: another angle";
}

TEST(RossLi, UprightKernelsAreZero) {
  for (const double kernel : model(0.1, 0.1, 0.1).kernels(event_of(0.0, 0.0, 0.0)))
    EXPECT_NEAR(kernel, 0.0, 1e-12);
  // In the hot spot of equal angles: (pi/2) / (2 cos) - pi/4, and 1 / cos^2 - 1 / cos.
  const double c = std::cos(50.0 * kDegree);
  const Kernels hot = model(0.1, 0.1, 0.1).kernels(event_of(50.0, 50.0, 0.0));
  EXPECT_NEAR(hot[0], 0.25 * pi / c - 0.25 * pi, 1e-7);
  EXPECT_NEAR(hot[1], 1.0 / (c * c) - 1.0 / c, 1e-7);
  // Maignan's factor is 2 there.
  EXPECT_NEAR(model(0.1, 0.1, 0.1, 1.5).kernels(event_of(50.0, 50.0, 0.0))[0], 0.5 * pi / c - 0.25 * pi,
              1e-5);
}

/// Largest deviation of the radiance from uvspec's, relative; the Sun at 30 deg.
double from_uvspec(const Bsdf& bsdf, const std::filesystem::path& file) {
  const std::vector<test::UvspecRow> rows = test::read_uvspec(file);
  EXPECT_EQ(rows.size(), 4u);
  double worst = 0.0;
  for (const test::UvspecRow& row : rows)
    for (std::size_t k = 0; k < row.radiance.size(); ++k) {
      const BsdfEvent event =
          event_of(std::acos(row.cosine) / kDegree, 30.0, 180.0 - 45.0 * static_cast<double>(k));
      // In this file (case 14d of DISORT 3) the sum of the kernels is the BRDF, without the 1 / pi.
      const double radiance = reflectance_factor(bsdf, event) * std::cos(30.0 * kDegree);
      worst = std::max(worst, std::abs(row.radiance[k] / radiance - 1.0));
    }
  return worst;
}

TEST(RossLi, IsThatOfLibradtran) {
  constexpr const char* kUvspec = "atmosphere/libradtran/UVSPEC_BRDF_ROSSLI.OUT";
  const auto file = ifov::test::truth_file(kUvspec);
  if (!file) GTEST_SKIP() << "reference data not found: " << kUvspec;
  // Its volume kernel is Maignan's, 4 / (3 pi) times that of Ross.
  constexpr double kMaignan = 4.0 / (3.0 * pi);
  EXPECT_LT(from_uvspec(model(0.091, 0.02 * kMaignan, 0.0086, 1.5), *file), 5e-5);
  EXPECT_GT(from_uvspec(model(0.091, 0.02 * kMaignan, 0.0086), *file), 3e-3) << "planted: no hot spot";
  EXPECT_GT(from_uvspec(model(0.091, 0.02, 0.0086, 1.5), *file), 3e-3) << "planted: Ross's kernel";
  EXPECT_GT(from_uvspec(model(0.091, 0.02 * kMaignan, 0.0090, 1.5), *file), 3e-3) << "planted: other crowns";
}

TEST(RossLi, IsReciprocal) {
  const RossLi bsdf = model(0.2, 0.1, 0.03, 1.5);
  for (const double out : {0.0, 20.0, 70.0, 89.5})
    for (const double in : {10.0, 60.0, 89.9})
      for (const double azimuth : {0.0, 50.0, 180.0}) {
        const double there = reflectance_factor(bsdf, event_of(out, in, azimuth));
        EXPECT_NEAR(there, reflectance_factor(bsdf, event_of(in, out, -azimuth)), 1e-6 * there + 1e-9);
      }
}

TEST(RossLi, IsNeverNegative) {
  const RossLi bsdf = model(0.03, 0.0, 0.03);
  const BsdfEvent past = event_of(75.0, 60.0, 180.0);
  EXPECT_LT(0.03 + 0.03 * bsdf.kernels(past)[1], -0.01);
  EXPECT_EQ(reflectance_factor(bsdf, past), 0.0);
}

TEST(RossLi, TheHotSpotIsWhereTheViewerHasTheLightInTheBack) {
  const RossLi bsdf = model(0.2, 0.1, 0.02, 1.5);
  double highest = 0.0;
  int azimuth = -1;
  for (int a = -180; a < 180; ++a)
    if (const double found = reflectance_factor(bsdf, event_of(40.0, 40.0, a)); found > highest) {
      highest = found;
      azimuth = a;
    }
  EXPECT_EQ(azimuth, 0);
  EXPECT_GT(highest, 1.1 * reflectance_factor(bsdf, event_of(40.0, 40.0, 5.0)));
}

TEST(RossLi, AMaterialHasTheAlbedoOfItsKernels) {
  // Where nothing is cut off at 0, MODIS's sum f_iso + 0.189184 f_vol - 1.377622 f_geo.
  const RossLi bsdf = model(0.3, 0.15, 0.02);
  EXPECT_NEAR(directional_hemispherical(bsdf, Side::reflected, kBihemispherical).values()[0],
              0.3 + 0.189184 * 0.15 - 1.377622 * 0.02, 2e-3);
  Material m{"meadow", Spectrum::constant(0.3)};
  m.bsdf = std::make_shared<RossLi>(bsdf);
  EXPECT_NO_THROW(check(m));
  m.bsdf = std::make_shared<RossLi>(model(0.9, 0.9, 0.0));
  EXPECT_THROW(check(m), InputError);
}

}  // namespace
}  // namespace ifov::materials::test_ross_li
