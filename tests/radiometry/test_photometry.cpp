#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "radiometry/photometry.h"
#include "radiometry/planck.h"

namespace ifov::radiometry::test_photometry {
namespace {

TEST(Photometry, EfficiencyHasTheIntegralOfTheStandard) {
  const Spectrum& eye = luminous_efficiency();
  EXPECT_NEAR(1e3 * integral(eye, eye.first_um(), eye.last_um()), 106.857, 1e-3);
  EXPECT_EQ(eye.at(0.555), 1.0);
}

// What the candela was until 1979: 60 cd/cm2 of a blackbody at the freezing point of platinum, then 1769 deg C; 683 lm/W was
// chosen so that it stays within 0.3 %.
TEST(Photometry, PlatinumShinesAsTheOldCandelaSaid) {
  std::vector<double> um, radiance;
  for (int k = 0; k <= 900; ++k) {
    um.push_back(0.3 + 0.001 * k);
    radiance.push_back(planck_w_m2_sr_um(um.back(), 2042.15));
  }
  EXPECT_NEAR(luminous(Spectrum(um, radiance)), 6.0e5, 0.018e5);
}

TEST(Photometry, FluxOfKnownIntensities) {
  EXPECT_NEAR(LuminousIntensity({0.0, 180.0}, {0.0}, {100.0, 100.0}).flux_lm(), 400.0 * std::numbers::pi,
              0.01);
  std::vector<double> angle, cosine;
  for (int k = 0; k <= 180; ++k) {
    angle.push_back(0.5 * k);
    cosine.push_back(k == 180 ? 0.0 : std::cos(angle.back() * std::numbers::pi / 180.0));
  }
  const LuminousIntensity disk(angle, {0.0}, cosine);
  EXPECT_NEAR(disk.flux_lm(), std::numbers::pi, 1e-4);
  EXPECT_EQ(disk.at(2.0, 0.0), 0.0);
  EXPECT_NEAR(disk.at(std::numbers::pi / 3.0, 1.0), 0.5, 1e-6);
}

TEST(Photometry, PlanesAreMirroredAsTheirAnglesSay) {
  const auto one = [](std::vector<double> about, std::vector<double> values, double deg) {
    std::vector<double> candela;
    for (const double value : values) candela.insert(candela.end(), {value, value});
    return LuminousIntensity({0.0, 180.0}, std::move(about), std::move(candela))
        .at(1.0, deg * std::numbers::pi / 180.0);
  };
  EXPECT_NEAR(one({0.0, 90.0}, {1.0, 3.0}, 135.0), 2.0, 1e-9);
  EXPECT_NEAR(one({0.0, 90.0}, {1.0, 3.0}, -45.0), 2.0, 1e-9);
  EXPECT_NEAR(one({0.0, 90.0, 180.0}, {1.0, 3.0, 5.0}, 270.0), 3.0, 1e-9);
  EXPECT_NEAR(one({0.0, 90.0, 180.0}, {1.0, 3.0, 5.0}, 200.0), 1.0 + 4.0 * 160.0 / 180.0, 1e-9);
  EXPECT_NEAR(one({90.0, 180.0, 270.0}, {1.0, 3.0, 5.0}, 0.0), 3.0, 1e-9);
  EXPECT_NEAR(one({90.0, 180.0, 270.0}, {1.0, 3.0, 5.0}, 300.0), 5.0 - 2.0 * 30.0 / 90.0, 1e-9);
  EXPECT_NEAR(one({0.0, 180.0, 360.0}, {1.0, 3.0, 1.0}, 270.0), 2.0, 1e-9);
}

TEST(Photometry, BadTablesAreRefused) {
  EXPECT_THROW(LuminousIntensity({0.0, 90.0}, {0.0, 45.0}, {1, 1, 1, 1}), InputError);
  EXPECT_THROW(LuminousIntensity({90.0, 0.0}, {0.0}, {1, 1}), InputError);
  EXPECT_THROW(LuminousIntensity({0.0, 90.0}, {0.0}, {1, -1}), InputError);
  EXPECT_THROW(LuminousIntensity({0.0, 90.0}, {0.0}, {0, 0}), InputError);
  EXPECT_THROW(LuminousIntensity({0.0, 90.0}, {0.0}, {1}), InputError);
}

}  // namespace
}  // namespace ifov::radiometry::test_photometry
