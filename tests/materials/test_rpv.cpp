#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/reflection_angles.h"
#include "materials/bsdf/rpv.h"
#include "materials/material.h"
#include "materials/reflectance_events.h"
#include "support/truth_data.h"

namespace ifov::materials::test_rpv {
namespace {

using radiometry::Spectrum;
using test::event_of;
using test::kDegree;
using test::reflectance_factor;

constexpr const char* kUvspec = "atmosphere/libradtran/UVSPEC_BRDF.OUT";
constexpr double kSun_deg = 30.0;

Rpv ploughed_field() { return {Spectrum::constant(0.076), 0.648, -0.290}; }

struct Deviations {
  double near = 0.0,
         away = 0.0;  ///< largest, relative: to 5 deg from the zenith angle of the Sun, and elsewhere
};

/// From uvspec, whose azimuth 180 deg is that of the Sun, as far as the model's own formula goes.
Deviations from_uvspec(const Bsdf& bsdf, const std::filesystem::path& file) {
  const std::vector<test::UvspecRow> rows = test::read_uvspec(file);
  EXPECT_EQ(rows.size(), 34u);
  Deviations worst;
  for (const test::UvspecRow& row : rows) {
    if (row.cosine < ReflectionAngles::kLeastCosine) continue;
    const double zenith_deg = std::acos(row.cosine) / kDegree;
    for (std::size_t k = 0; k < row.radiance.size(); ++k) {
      const BsdfEvent event = event_of(zenith_deg, kSun_deg, 180.0 - 90.0 * static_cast<double>(k));
      const double radiance =
          reflectance_factor(bsdf, event) * std::cos(kSun_deg * kDegree) / std::numbers::pi;
      double& deviation = std::abs(zenith_deg - kSun_deg) < 5.0 ? worst.near : worst.away;
      deviation = std::max(deviation, std::abs(row.radiance[k] / radiance - 1.0));
    }
  }
  return worst;
}

TEST(Rpv, IsThatOfLibradtran) {
  const auto file = ifov::test::truth_file(kUvspec);
  if (!file) GTEST_SKIP() << "reference data not found: " << kUvspec;
  // With 16 streams uvspec rounds the hot spot off.
  const Deviations worst = from_uvspec(ploughed_field(), *file);
  EXPECT_LT(worst.away, 5e-4);
  EXPECT_LT(worst.near, 0.01);
}

TEST(Rpv, PlantedFaultsAreSeenBesideLibradtran) {
  const auto file = ifov::test::truth_file(kUvspec);
  if (!file) GTEST_SKIP() << "reference data not found: " << kUvspec;
  const Spectrum rho0 = Spectrum::constant(0.076);
  EXPECT_GT(from_uvspec(Rpv(rho0, 0.648, 0.290), *file).away, 0.3) << "asymmetry of the other sign";
  EXPECT_GT(from_uvspec(Rpv(rho0, 0.652, -0.290), *file).away, 1e-3) << "another bowl";
  EXPECT_GT(from_uvspec(Rpv(rho0, 0.648, -0.290, Spectrum::constant(0.086)), *file).away, 1e-3)
      << "another rho_c";
}

TEST(Rpv, UprightItIsTheProductOfItsFactors) {
  for (const double g : {-0.5, 0.0, 0.3})
    for (const double k : {0.5, 1.0, 1.4})
      for (const double rho_c : {0.0, 0.4, 1.0}) {
        const Rpv bsdf(Spectrum::constant(0.2), k, g, Spectrum::constant(rho_c));
        const double expected =
            0.2 * std::pow(2.0, k - 1.0) * (1.0 - g) / ((1.0 + g) * (1.0 + g)) * (2.0 - rho_c);
        EXPECT_NEAR(reflectance_factor(bsdf, event_of(0.0, 0.0, 0.0)), expected, 1e-6 * expected);
      }
}

TEST(Rpv, WithoutRhoCItIsTheReflectance) {
  const Rpv given(Spectrum::constant(0.3), 0.8, -0.1, Spectrum::constant(0.3)),
      absent(Spectrum::constant(0.3), 0.8, -0.1),
      other(Spectrum::constant(0.3), 0.8, -0.1, Spectrum::constant(1.0));
  const BsdfEvent event = event_of(50.0, 30.0, 70.0);
  EXPECT_EQ(reflectance_factor(absent, event), reflectance_factor(given, event));
  EXPECT_GT(reflectance_factor(absent, event), 1.1 * reflectance_factor(other, event));
}

TEST(Rpv, WithoutHotSpotAndAsymmetryItIsMinnaertsLaw) {
  // With k = 2 the integral over the hemisphere is one of powers: of R = rho0 m' m (m' + m) against 2 m', where m' does not fall
  // below the least cosine.
  const Rpv bsdf(Spectrum::constant(0.2), 2.0, 0.0, Spectrum::constant(1.0));
  constexpr double c = ReflectionAngles::kLeastCosine;
  for (const double m : {1.0, 0.6, 0.2}) {
    const double below = c * m * (c + m) * c * c,
                 above = 2.0 * m * ((1.0 - c * c * c * c) / 4.0 + m * (1.0 - c * c * c) / 3.0);
    const double expected = 0.2 * (below + above);
    EXPECT_NEAR(directional_hemispherical(bsdf, Side::reflected, m).values()[0], expected, 3e-4 * expected)
        << m;
  }
}

TEST(Rpv, TheHotSpotIsWhereTheViewerHasTheLightInTheBack) {
  const Rpv bsdf(Spectrum::constant(0.2), 1.0, 0.0, Spectrum::constant(0.2));
  double highest = 0.0, zenith = 0.0, azimuth = 0.0;
  for (int z = 0; z <= 80; ++z)
    for (int a = -180; a < 180; a += 2)
      if (const double found = reflectance_factor(bsdf, event_of(z, 40.0, a)); found > highest) {
        highest = found;
        zenith = z;
        azimuth = a;
      }
  EXPECT_EQ(zenith, 40.0);
  EXPECT_EQ(azimuth, 0.0);
  EXPECT_NEAR(highest, 0.2 * 1.8, 1e-6);
}

TEST(Rpv, AsymmetryBelowZeroSendsLightBack) {
  const auto ratio = [](double asymmetry) {
    const Rpv bsdf(Spectrum::constant(0.2), 1.0, asymmetry, Spectrum::constant(1.0));
    return reflectance_factor(bsdf, event_of(50.0, 40.0, 0.0)) /
           reflectance_factor(bsdf, event_of(50.0, 40.0, 180.0));
  };
  EXPECT_GT(ratio(-0.2), 1.3);
  EXPECT_LT(ratio(0.2), 1.0 / 1.3);
}

TEST(Rpv, IsReciprocalAndStandsStillNearTheHorizon) {
  const Rpv bsdf(Spectrum::constant(0.1), 0.7, -0.2, Spectrum::constant(0.3));
  for (const double out : {0.0, 20.0, 70.0, 89.5})
    for (const double in : {10.0, 60.0, 89.9})
      for (const double azimuth : {0.0, 50.0, 180.0}) {
        const double there = reflectance_factor(bsdf, event_of(out, in, azimuth));
        EXPECT_NEAR(there, reflectance_factor(bsdf, event_of(in, out, -azimuth)), 1e-6 * there);
      }
  const double last_deg = std::acos(ReflectionAngles::kLeastCosine) / kDegree;
  const double there = reflectance_factor(bsdf, event_of(last_deg, 30.0, 60.0));
  EXPECT_NEAR(reflectance_factor(bsdf, event_of(89.99, 30.0, 60.0)), there, 1e-5 * there);
  EXPECT_GT(there, 1.05 * reflectance_factor(bsdf, event_of(last_deg - 1.0, 30.0, 60.0)));
}

TEST(Rpv, AMaterialThatSendsBackMoreThanArrivesIsRefused) {
  Material m{"snow", Spectrum::constant(0.076)};
  m.bsdf = std::make_shared<Rpv>(ploughed_field());
  EXPECT_NO_THROW(check(m));
  m.bsdf = std::make_shared<Rpv>(Spectrum::constant(0.6), 0.8, -0.1);
  try {
    check(m);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("material 'snow': of light that comes"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace ifov::materials::test_rpv
