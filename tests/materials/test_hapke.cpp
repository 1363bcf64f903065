#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hapke.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/reflection_angles.h"
#include "materials/material.h"
#include "materials/reflectance_events.h"
#include "support/truth_data.h"

namespace ifov::materials::test_hapke {
namespace {

using radiometry::Spectrum;
using std::numbers::pi;
using test::event_of;
using test::kDegree;
using test::reflectance_factor;

constexpr const char* kUvspec = "atmosphere/libradtran/UVSPEC_BRDF_HAPKE.OUT";

HapkeParameters parameters(double b0, double h, double b, double c = 0.0, double roughness_deg = 0.0) {
  HapkeParameters p;
  p.b0 = b0;
  p.h = h;
  p.b = b;
  p.c = c;
  p.roughness_rad = roughness_deg * kDegree;
  return p;
}

Hapke model(double w, const HapkeParameters& p) { return {Spectrum::constant(w), p}; }

/// Largest deviation of the radiance from uvspec's, relative; the Sun at 30 deg, at azimuth 180 deg.
double from_uvspec(const Bsdf& bsdf, const std::filesystem::path& file) {
  const std::vector<test::UvspecRow> rows = test::read_uvspec(file);
  EXPECT_EQ(rows.size(), 4u);
  double worst = 0.0;
  for (const test::UvspecRow& row : rows) {
    EXPECT_EQ(row.radiance.size(), 3u);
    for (std::size_t k = 0; k < row.radiance.size(); ++k) {
      const BsdfEvent event =
          event_of(std::acos(row.cosine) / kDegree, 30.0, 180.0 - 90.0 * static_cast<double>(k));
      const double radiance = reflectance_factor(bsdf, event) * std::cos(30.0 * kDegree) / pi;
      worst = std::max(worst, std::abs(row.radiance[k] / radiance - 1.0));
    }
  }
  return worst;
}

TEST(Hapke, IsThatOfLibradtran) {
  const auto file = ifov::test::truth_file(kUvspec);
  if (!file) GTEST_SKIP() << "reference data not found: " << kUvspec;
  // uvspec's phase function is 1 + cos(g) / 2.
  EXPECT_LT(from_uvspec(model(0.6, parameters(1.0, 0.06, 0.5)), *file), 1e-4);
  EXPECT_GT(from_uvspec(model(0.6, parameters(1.0, 0.06, -0.5)), *file), 0.1) << "planted: light goes on";
  EXPECT_GT(from_uvspec(model(0.602, parameters(1.0, 0.06, 0.5)), *file), 1e-3) << "planted: another albedo";
  EXPECT_GT(from_uvspec(model(0.6, parameters(1.0, 0.061, 0.5)), *file), 5e-4) << "planted: another width";
  EXPECT_GT(from_uvspec(model(0.6, parameters(1.0, 0.06, 0.5, 0.0, 5.0)), *file), 1e-3) << "planted: relief";
}

TEST(Hapke, DarkIsotropicGrainsFollowLommelAndSeeliger) {
  // To first order in w the BRDF is w / (4 pi (m + m')), and light that comes from m is sent back by w/2 (1 - m ln(1 + 1/m)).
  const Hapke bsdf = model(1e-4, parameters(0.0, 0.05, 0.0));
  for (const double out : {0.0, 50.0, 80.0}) {
    const double expected = 0.25e-4 / (std::cos(out * kDegree) + std::cos(40.0 * kDegree));
    EXPECT_NEAR(reflectance_factor(bsdf, event_of(out, 40.0, 70.0)), expected, 3e-4 * expected);
  }
  for (const double m : {1.0, 0.6, 0.3}) {
    const double expected = 0.5e-4 * (1.0 - m * std::log(1.0 + 1.0 / m));
    EXPECT_NEAR(directional_hemispherical(bsdf, Side::reflected, m).values()[0], expected, 2e-3 * expected);
  }
}

TEST(Hapke, WhiteGrainsSendBackAboutAll) {
  // Without absorption the H function is 1 + 2 m, two streams' approximation: at the zenith 3/2 ln 2 = 1.0397 comes back. Above
  // w = 0.99 some of that is more than arrives.
  const Hapke white = model(1.0, parameters(0.0, 0.05, 0.0));
  EXPECT_NEAR(directional_hemispherical(white, Side::reflected, 1.0).values()[0], 1.5 * std::numbers::ln2,
              1e-3);
  Material m{"moon", Spectrum::constant(0.5)};
  for (const double w : {0.1, 0.5, 0.9, 0.97}) {
    m.bsdf = std::make_shared<Hapke>(model(w, parameters(0.0, 0.05, 0.0)));
    EXPECT_NO_THROW(check(m)) << w;
  }
  for (const double roughness : {0.0, 20.0, 45.0})
    for (const double w : {0.2, 0.6}) {
      m.bsdf = std::make_shared<Hapke>(model(w, parameters(1.0, 0.06, 0.5, 0.3, roughness)));
      EXPECT_NO_THROW(check(m)) << w << ' ' << roughness;
    }
  m.bsdf = std::make_shared<Hapke>(white);
  EXPECT_THROW(check(m), InputError);
}

TEST(Hapke, TheMeanOfThePhaseFunctionIsOne) {
  HapkeParameters p = parameters(0.0, 0.05, 0.4, 0.2);
  p.lobe = 0.5;
  for (const double backward : {-1.0, -0.3, 0.8, 1.0}) {
    p.backward = backward;
    if (backward < -0.5) p.b = 0.0;
    const Hapke bsdf = model(0.5, p);
    double sum = 0.0;
    constexpr int kSteps = 4000;
    for (int k = 0; k < kSteps; ++k) sum += bsdf.phase_function(2.0 * (k + 0.5) / kSteps - 1.0) / kSteps;
    EXPECT_NEAR(sum, 1.0, 1e-5) << backward;
  }
  p.b = 0.0;
  p.backward = 1.0;
  EXPECT_GT(model(0.5, p).phase_function(1.0), 5.0 * model(0.5, p).phase_function(-1.0));
}

TEST(Hapke, APhaseFunctionBelowZeroIsRefused) {
  EXPECT_NO_THROW(model(0.5, parameters(0.0, 0.05, 1.0)));
  try {
    model(0.5, parameters(0.0, 0.05, 1.2));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "hapke: the phase function would be -0.2, below 0, at a phase angle of 180 deg; with b = 1.2 and c = 0 "
        "there is more taken away than there is");
  }
  EXPECT_THROW(model(0.5, parameters(0.0, 0.05, 0.0, -1.0 / 0.9)), InputError);
}

TEST(Hapke, TheSurgeHasItsHeightAndWidth) {
  const Hapke flat = model(0.1, parameters(0.0, 0.1, 0.0)), surge = model(0.1, parameters(0.8, 0.1, 0.0));
  const auto gain = [&](double phase_deg) {
    const BsdfEvent event = event_of(30.0 + phase_deg, 30.0, 0.0);
    const ReflectionAngles a(event);
    return pi * (reflectance_factor(surge, event) - reflectance_factor(flat, event)) * 4.0 *
           (a.cos_in + a.cos_out) / (0.1 * pi);
  };
  EXPECT_NEAR(gain(0.0), 0.8, 1e-5);
  EXPECT_NEAR(gain(2.0 * std::atan(0.1) / kDegree), 0.4, 1e-5);
}

/// With Hapke's own symbols and cases, written down a second time: factor on the BRDF of the effective cosines.
double published_relief(double i, double e, double psi, double theta, double* effective_cosines) {
  const double t = std::tan(theta), chi = 1.0 / std::sqrt(1.0 + pi * t * t);
  const auto e1 = [&](double x) { return std::exp(-2.0 / pi / t / std::tan(x)); };
  const auto e2 = [&](double x) { return std::exp(-1.0 / pi / (t * t * std::tan(x) * std::tan(x))); };
  const auto eta = [&](double x) { return chi * (std::cos(x) + std::sin(x) * t * e2(x) / (2.0 - e1(x))); };
  const double f = std::exp(-2.0 * std::tan(0.5 * psi)), s2 = std::sin(0.5 * psi) * std::sin(0.5 * psi);
  double mu0e = 0.0, mue = 0.0, s = 0.0;
  if (i <= e) {
    const double d = 2.0 - e1(e) - psi / pi * e1(i);
    mu0e = chi * (std::cos(i) + std::sin(i) * t * (std::cos(psi) * e2(e) + s2 * e2(i)) / d);
    mue = chi * (std::cos(e) + std::sin(e) * t * (e2(e) - s2 * e2(i)) / d);
    s = mue / eta(e) * std::cos(i) / eta(i) * chi / (1.0 - f + f * chi * std::cos(i) / eta(i));
  } else {
    const double d = 2.0 - e1(i) - psi / pi * e1(e);
    mu0e = chi * (std::cos(i) + std::sin(i) * t * (e2(i) - s2 * e2(e)) / d);
    mue = chi * (std::cos(e) + std::sin(e) * t * (std::cos(psi) * e2(i) + s2 * e2(e)) / d);
    s = mue / eta(e) * std::cos(i) / eta(i) * chi / (1.0 - f + f * chi * std::cos(e) / eta(e));
  }
  effective_cosines[0] = mu0e;
  effective_cosines[1] = mue;
  return s * mu0e / std::cos(i);
}

TEST(Hapke, ReliefIsThePublishedOneOnBothSides) {
  for (const double theta : {5.0, 20.0, 40.0})
    for (const double i : {10.0, 45.0, 75.0})
      for (const double e : {20.0, 45.0, 80.0})
        for (const double psi : {1.0, 60.0, 120.0, 179.0}) {
          double cosines[2];
          const double factor =
              published_relief(i * kDegree, e * kDegree, psi * kDegree, theta * kDegree, cosines);
          const Hapke::Relief found = model(0.3, parameters(0.0, 0.05, 0.0, 0.0, theta))
                                          .relief(ReflectionAngles(event_of(e, i, psi)));
          EXPECT_NEAR(found.cos_in, cosines[0], 1e-9);
          EXPECT_NEAR(found.cos_out, cosines[1], 1e-9);
          EXPECT_NEAR(found.factor, factor, 1e-9);
        }
}

TEST(Hapke, ReliefSeenFromTheLightHasNoShadows) {
  // The viewer has the light in the back and sees nothing that is not lit: S = 1. Upright the facets' mean cosine is left.
  const double theta = 25.0, chi = 1.0 / std::sqrt(1.0 + pi * std::pow(std::tan(theta * kDegree), 2));
  const Hapke bsdf = model(0.3, parameters(0.0, 0.05, 0.0, 0.0, theta));
  for (const double zenith : {0.0, 30.0, 70.0}) {
    const ReflectionAngles a(event_of(zenith, zenith, 0.0));
    const Hapke::Relief found = bsdf.relief(a);
    EXPECT_NEAR(found.factor * a.cos_in / found.cos_in, 1.0, 1e-6) << zenith;
    EXPECT_NEAR(found.cos_in, found.cos_out, 1e-12);
  }
  EXPECT_NEAR(bsdf.relief(ReflectionAngles(event_of(0.0, 0.0, 0.0))).cos_in, chi, 1e-9);
  // Past the light shadows are seen, and the surface is darker than without relief.
  const BsdfEvent past = event_of(60.0, 60.0, 180.0);
  EXPECT_LT(reflectance_factor(bsdf, past),
            0.7 * reflectance_factor(model(0.3, parameters(0.0, 0.05, 0.0)), past));
}

TEST(Hapke, LittleReliefIsNone) {
  const Hapke flat = model(0.4, parameters(0.5, 0.1, 0.3)),
              little = model(0.4, parameters(0.5, 0.1, 0.3, 0.0, 0.1));
  for (const double out : {0.0, 40.0, 75.0})
    for (const double azimuth : {0.0, 80.0, 180.0}) {
      const BsdfEvent event = event_of(out, 35.0, azimuth);
      EXPECT_NEAR(reflectance_factor(little, event), reflectance_factor(flat, event),
                  1e-4 * reflectance_factor(flat, event));
    }
}

TEST(Hapke, IsReciprocal) {
  const Hapke bsdf = model(0.4, parameters(0.8, 0.05, 0.4, 0.2, 30.0));
  for (const double out : {0.0, 20.0, 70.0, 89.5})
    for (const double in : {10.0, 60.0, 89.9})
      for (const double azimuth : {0.0, 50.0, 180.0}) {
        const BsdfEvent there = event_of(out, in, azimuth), back = event_of(in, out, -azimuth);
        const double value = reflectance_factor(bsdf, there);
        EXPECT_GT(value, 0.0);
        EXPECT_NEAR(value, reflectance_factor(bsdf, back), 1e-6 * value);
        const Hapke::Relief a = bsdf.relief(ReflectionAngles(there)), b = bsdf.relief(ReflectionAngles(back));
        EXPECT_NEAR(a.factor, b.factor, 1e-9 * a.factor);
        EXPECT_NEAR(a.cos_in, b.cos_out, 1e-9);
      }
}

}  // namespace
}  // namespace ifov::materials::test_hapke
