#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/reflection_angles.h"
#include "materials/bsdf/snow.h"
#include "materials/indices/ice.h"
#include "materials/material.h"
#include "materials/reflectance_events.h"

namespace ifov::materials::test_snow {
namespace {

using radiometry::Spectrum;
using std::numbers::pi;
using test::event_of;
using test::kDegree;

Spectrum white() { return Spectrum::constant(1.0); }

/// A BRDF of R0 alone.
class White final : public Bsdf {
 public:
  explicit White(double (*r0)(const ReflectionAngles&)) : r0_(r0) {}
  void evaluate(const BsdfEvent& event, ParameterSpectra, std::size_t count, float* bsdf) const override {
    std::fill_n(bsdf, count, static_cast<float>(r0_(ReflectionAngles(event)) / pi));
  }

 private:
  double (*r0_)(const ReflectionAngles&);
};

/// Directional-hemispherical reflectance of a BRDF of R0 alone.
double whole(double (*r0)(const ReflectionAngles&), double cosine) {
  float found = 0.0f;
  directional_hemispherical(White(r0), Side::reflected, {}, 1, cosine, &found);
  return static_cast<double>(found);
}

TEST(Snow, IceAbsorbsAsMeasured) {
  // Warren and Brandt 2008, as the snow products of Sentinel-3 list it for their channels.
  EXPECT_NEAR(ice_extinction_index().at(0.4), 2.365e-11, 1e-14);
  EXPECT_NEAR(ice_extinction_index().at(0.560), 2.839e-9, 1e-12);
  EXPECT_NEAR(ice_extinction_index().at(0.865), 2.4e-7, 0.02e-7);
  EXPECT_NEAR(ice_extinction_index().at(1.02), 2.25e-6, 0.01e-6);
}

TEST(Snow, TheFitOfWhiteSnowIsThePublishedOne) {
  // By hand: upright, where light is turned by 180 deg, and at 60 deg on both sides, where it is turned by 60 deg past the light.
  EXPECT_NEAR(Snow::fitted_r0(ReflectionAngles(event_of(0.0, 0.0, 0.0))),
              (1.247 + 2.0 * 1.186 + 5.157 + 1.1 * std::exp(-2.52)) / 8.0, 1e-6);
  EXPECT_NEAR(
      Snow::fitted_r0(ReflectionAngles(event_of(60.0, 60.0, 180.0))),
      (1.247 + 1.186 + 0.25 * 5.157 + 11.1 * std::exp(-0.087 * 60.0) + 1.1 * std::exp(-0.014 * 60.0)) / 4.0,
      1e-6);
}

TEST(Snow, WhiteSnowSendsBackWhatArrives) {
  for (const double cosine : {1.0, 0.8, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02}) {
    EXPECT_NEAR(whole(Snow::white_r0, cosine), 1.0, 2e-3) << cosine;
    if (cosine >= 0.2) {
      EXPECT_NEAR(whole(Snow::fitted_r0, cosine), 1.0, 0.015) << cosine;
    }
  }
  EXPECT_GT(whole(Snow::fitted_r0, 0.02), 1.1) << "planted: the fit as it is";
  // To 78 deg both are the same to 2.4 %.
  for (const double out : {0.0, 30.0, 60.0, 78.0})
    for (const double azimuth : {0.0, 90.0, 180.0}) {
      const ReflectionAngles a(event_of(out, 50.0, azimuth));
      EXPECT_NEAR(Snow::white_r0(a) / Snow::fitted_r0(a), 1.0, 0.024);
    }
}

TEST(Snow, AlbedoFollowsGrainSize) {
  // ln^2 r = 4 pi 16.36 d k / wavelength: 0.5 mm at 1.02 um.
  const Spectrum r = snow_albedo(0.5e-3, 0.0);
  EXPECT_NEAR(r.at(1.02), std::exp(-std::sqrt(4.0 * pi * 16.36 * 0.5e-3 * 2.25e-6 / 1.02e-6)), 2e-3);
  EXPECT_GT(r.at(0.5), 0.98);
  EXPECT_LT(r.at(1.5), 0.02);
  for (const double um : {0.8, 1.03, 1.3}) {
    const double once = std::log(snow_albedo(0.1e-3, 0.0).at(um)),
                 twice = std::log(snow_albedo(0.4e-3, 0.0).at(um));
    EXPECT_NEAR(twice, 2.0 * once, 0.01 * std::abs(twice)) << "four times the size, twice the logarithm";
  }
}

TEST(Snow, SootAbsorbsAsMeasured) {
  // Bond and Bergstrom 2006 (Aerosol Sci. Technol. 40): 7.5 +- 1.2 m2/g at 0.55 um. Absorption by soot of mass q in a unit
  // volume of ice over that by ice is 0.9 k / (1.6 k_ice) by volume: from the albedo back to the cross section.
  const double grain = 0.5e-3, q = 1e-6, um = 0.55;
  const auto absorption = [&](double soot) {
    const double log = std::log(snow_albedo(grain, soot).at(um));
    return log * log / (16.36 * grain);  // 1/m of ice
  };
  const double m2_per_g = 1.6 * (absorption(q) - absorption(0.0)) / (q * 917.0) / 1000.0;
  EXPECT_NEAR(m2_per_g, 7.5, 1.2);
  // 0.1 ppm takes some per cent away in the visible, nothing in the near infrared.
  EXPECT_NEAR(snow_albedo(grain, 1e-7).at(um), 0.93, 0.03);
  EXPECT_NEAR(snow_albedo(grain, 1e-7).at(1.03) / snow_albedo(grain, 0.0).at(1.03), 1.0, 0.01);
}

TEST(Snow, AlbedoByAngleIsThatOfTheTheory) {
  // Kokhanovsky and Zege: plane albedo r^u, u = 3/7 (1 + 2 cos); R0 and u belong together only about.
  const Snow bsdf(white(), 0.3e-3);
  for (const double um : {0.5, 0.8, 0.95, 1.02})
    for (const double cosine : {1.0, 0.7, 0.5, 0.3}) {
      const double r = bsdf.spectra()[1].at(um);
      const double expected = std::pow(r, 3.0 / 7.0 * (1.0 + 2.0 * cosine));
      const double found = directional_hemispherical(bsdf, Side::reflected, cosine).at(um);
      EXPECT_NEAR(found, expected, 0.02) << um << ' ' << cosine;
    }
  for (const double um : {0.5, 0.8, 1.02})
    EXPECT_NEAR(directional_hemispherical(bsdf, Side::reflected, kBihemispherical).at(um),
                bsdf.spectra()[1].at(um), 0.01)
        << um;
}

TEST(Snow, IsBrighterPastTheLight) {
  const Snow bsdf(white(), 0.3e-3);
  const float rows[] = {1.0f, 0.7f};
  const float* const parameters[] = {&rows[0], &rows[1]};
  const auto at = [&](double azimuth) {
    float found = 0.0f;
    bsdf.evaluate(event_of(60.0, 60.0, azimuth), parameters, 1, &found);
    return found;
  };
  EXPECT_GT(at(180.0), 1.1f * at(0.0));
}

TEST(Snow, IsReciprocal) {
  for (const double out : {0.0, 20.0, 70.0, 89.5})
    for (const double in : {10.0, 60.0, 89.9})
      for (const double azimuth : {0.0, 50.0, 180.0}) {
        const double there = Snow::white_r0(ReflectionAngles(event_of(out, in, azimuth)));
        EXPECT_NEAR(there, Snow::white_r0(ReflectionAngles(event_of(in, out, -azimuth))), 1e-9 * there);
      }
}

TEST(Snow, AnyGrainIsAMaterial) {
  Material m{"snow", white()};
  for (const double grain : {0.02e-3, 0.2e-3, 5e-3}) {
    m.bsdf = std::make_shared<Snow>(white(), grain);
    EXPECT_NO_THROW(check(m)) << grain;
  }
  m.bsdf = std::make_shared<White>(Snow::fitted_r0);
  EXPECT_THROW(check(m), InputError) << "planted: the fit as it is";
}

}  // namespace
}  // namespace ifov::materials::test_snow
