#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/reflection_angles.h"
#include "materials/bsdf/rpv.h"
#include "materials/bsdf/tabulated.h"
#include "materials/material.h"
#include "materials/reflectance_events.h"

namespace ifov::materials::test_tabulated {
namespace {

using radiometry::Spectrum;
using std::numbers::pi;
using test::event_of;
using test::kDegree;
using test::reflectance_factor;

/// A model measured at angles a step apart, in two wavelengths, of which the second has `second` times the BRDF.
MeasuredBrdf measured(const Bsdf& bsdf, double step_deg, double second = 1.0) {
  MeasuredBrdf table;
  for (double zenith = 0.0; zenith < 89.0; zenith += step_deg)
    table.zenith_in_rad.push_back(zenith * kDegree);
  table.zenith_out_rad = table.zenith_in_rad;
  for (double azimuth = 0.0; azimuth <= 180.0; azimuth += 2.0 * step_deg)
    table.azimuth_rad.push_back(azimuth * kDegree);
  table.wavelength_um = {0.5, 1.5};
  for (const double in : table.zenith_in_rad)
    for (const double out : table.zenith_out_rad)
      for (const double azimuth : table.azimuth_rad) {
        const double value =
            reflectance_factor(bsdf, event_of(out / kDegree, in / kDegree, azimuth / kDegree)) / pi;
        table.brdf.push_back(value);
        table.brdf.push_back(second * value);
      }
  return table;
}

Rpv field() { return {Spectrum::constant(0.12), 0.8, -0.1, Spectrum::constant(1.0)}; }

Tabulated tabulated(const MeasuredBrdf& table, bool repair = false) {
  return {Spectrum::constant(1.0), std::make_shared<BsdfTable>(table, repair)};
}

TEST(Tabulated, GivesWhatWasMeasured) {
  const Tabulated bsdf = tabulated(measured(field(), 10.0));
  for (const double out : {0.0, 30.0, 80.0})
    for (const double in : {10.0, 50.0})
      for (const double azimuth : {0.0, 60.0, 180.0}) {
        const BsdfEvent event = event_of(out, in, azimuth);
        const double expected = reflectance_factor(field(), event);
        EXPECT_NEAR(reflectance_factor(bsdf, event), expected, 1e-5 * expected);
      }
}

TEST(Tabulated, IsLinearBetweenAnglesAndHeldBeyond) {
  const Tabulated bsdf = tabulated(measured(field(), 10.0));
  const auto at = [&](double out, double in, double azimuth) {
    return reflectance_factor(bsdf, event_of(out, in, azimuth));
  };
  EXPECT_NEAR(at(35.0, 50.0, 60.0), 0.5 * (at(30.0, 50.0, 60.0) + at(40.0, 50.0, 60.0)), 1e-6);
  EXPECT_NEAR(at(30.0, 50.0, 70.0), 0.5 * (at(30.0, 50.0, 60.0) + at(30.0, 50.0, 80.0)), 1e-6);
  EXPECT_NEAR(at(88.0, 50.0, 60.0), at(80.0, 50.0, 60.0), 1e-6);
  // Of a finer table the model itself comes back, and its reflectance.
  const Tabulated fine = tabulated(measured(field(), 4.0));
  const BsdfEvent event = event_of(36.0, 51.0, 73.0);
  EXPECT_NEAR(reflectance_factor(fine, event), reflectance_factor(field(), event),
              3e-3 * reflectance_factor(field(), event));
  const double whole = directional_hemispherical(field(), Side::reflected, 0.8).values()[0];
  EXPECT_NEAR(directional_hemispherical(fine, Side::reflected, 0.8).at(0.5), whole, 3e-3 * whole);
}

TEST(Tabulated, TheReflectanceIsAFactorAndWavelengthsAreApart) {
  const auto table = std::make_shared<BsdfTable>(measured(field(), 15.0, 0.5), false);
  const Tabulated half(Spectrum::constant(0.5), table), whole(Spectrum::constant(1.0), table);
  const double cosine = 0.7;
  const Spectrum all = directional_hemispherical(whole, Side::reflected, cosine);
  EXPECT_NEAR(directional_hemispherical(half, Side::reflected, cosine).at(0.5), 0.5 * all.at(0.5), 1e-6);
  EXPECT_NEAR(all.at(1.5), 0.5 * all.at(0.5), 1e-6);
  EXPECT_NEAR(all.at(1.0), 0.75 * all.at(0.5), 1e-6);
  EXPECT_THROW(all.at(0.4), InputError);
}

std::string complaint(const MeasuredBrdf& table) {
  try {
    const BsdfTable made(table, false);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Tabulated, ATableThatIsNotReciprocalIsRefusedOrRepaired) {
  MeasuredBrdf table = measured(Rpv(Spectrum::constant(0.1), 1.0, 0.0, Spectrum::constant(1.0)), 20.0);
  EXPECT_EQ(complaint(table), "none");
  // Light from 40 deg seen from 60 deg at 80 deg, in the second wavelength.
  const std::size_t azimuths = table.azimuth_rad.size();
  double& wrong = table.brdf[((2 * table.zenith_out_rad.size() + 3) * azimuths + 2) * 2 + 1];
  const double right = wrong;
  wrong *= 1.008;
  EXPECT_EQ(complaint(table), "none") << "within 1 %";
  wrong = 1.05 * right;
  EXPECT_EQ(
      complaint(table),
      "not reciprocal by 4.88 %: at 1.5 um light from 60 deg seen from 40 deg, azimuth 80 deg, has a BRDF of 0.03183 "
      "/sr, and with both exchanged 0.03342; \"repair\": true takes the mean");
  const BsdfTable repaired(table, true);
  ASSERT_EQ(repaired.changes().size(), 1u);
  EXPECT_NE(repaired.changes()[0].find("the mean of both directions is taken, which differ by up to 4.88 %"),
            std::string::npos)
      << repaired.changes()[0];
  EXPECT_NEAR(repaired.brdf(2, 3, 2)[1], 1.025 * right, 1e-9);
  EXPECT_NEAR(repaired.brdf(2, 3, 2)[0], right, 1e-9);
}

TEST(Tabulated, ATableThatSendsBackTooMuchIsRefusedOrRepaired) {
  const Rpv bright(Spectrum::constant(1.0), 1.0, 0.0, Spectrum::constant(1.0));  // white, Lambertian
  EXPECT_EQ(complaint(measured(bright, 15.0)), "none");
  const MeasuredBrdf table = measured(bright, 15.0, 1.2);
  EXPECT_EQ(
      complaint(table),
      "at 1.5 um it sends back 1.2 times what comes 0 deg from the normal; \"repair\": true scales such wavelengths down");
  const auto repaired = std::make_shared<BsdfTable>(table, true);
  ASSERT_EQ(repaired->changes().size(), 1u);
  EXPECT_EQ(
      repaired->changes()[0],
      "1 of 2 wavelengths are scaled down until no more comes back than arrives: at 1.5 um it sends back 1.2 times what "
      "comes 0 deg from the normal");
  EXPECT_NEAR(repaired->brdf(1, 2, 0)[0], 1.0 / pi, 1e-6);
  EXPECT_NEAR(repaired->brdf(1, 2, 0)[1], 1.0 / pi, 1e-4);
  Material m{"tile", Spectrum::constant(1.0)};
  m.bsdf = std::make_shared<Tabulated>(Spectrum::constant(1.0), repaired);
  EXPECT_NO_THROW(check(m));
}

TEST(Tabulated, LightAndViewMayHaveAnglesOfTheirOwn) {
  // Three incidences, views all over: the other direction stands in for what was not measured.
  MeasuredBrdf table;
  table.zenith_in_rad = {0.0, 30.0 * kDegree, 60.0 * kDegree};
  for (double zenith = 0.0; zenith < 85.0; zenith += 10.0) table.zenith_out_rad.push_back(zenith * kDegree);
  table.azimuth_rad = {0.0, 0.5 * pi, pi};
  table.wavelength_um = {0.6};
  for (const double in : table.zenith_in_rad)
    for (const double out : table.zenith_out_rad)
      for (std::size_t k = 0; k < 3; ++k) table.brdf.push_back(0.1 + 0.02 * (in + out));
  const Tabulated bsdf = tabulated(table);
  for (const auto& [out, in] : {std::pair{80.0, 30.0}, std::pair{30.0, 80.0}, std::pair{50.0, 15.0}})
    EXPECT_NEAR(reflectance_factor(bsdf, event_of(out, in, 40.0)), pi * (0.1 + 0.02 * kDegree * (in + out)),
                1e-5);
  // One wavelength holds for all.
  EXPECT_TRUE(directional_hemispherical(bsdf, Side::reflected, 0.5).is_constant());
}

}  // namespace
}  // namespace ifov::materials::test_tabulated
