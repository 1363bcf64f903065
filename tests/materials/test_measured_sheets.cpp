#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/tabulated.h"
#include "materials/bsdf/ward.h"
#include "materials/lobe_checks.h"
#include "materials/material.h"

namespace ifov::materials::test_measured_sheets {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;
using test::brdf_at;
using test::kDegree;

constexpr BsdfTable::Kind kThrough = BsdfTable::Kind::transmitted;

/// f of the zenith angles and azimuths of light and view, measured on a grid of all of them, in deg.
using Function = std::function<double(double, double, double, double)>;
MeasuredBrdf measured(const Function& f, double zenith_deg, double azimuth_deg) {
  MeasuredBrdf table;
  for (double zenith = 0.0; zenith < 85.0; zenith += zenith_deg)
    table.zenith_in_rad.push_back(zenith * kDegree);
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += azimuth_deg)
    table.azimuth_in_rad.push_back(azimuth * kDegree);
  table.zenith_out_rad = table.zenith_in_rad;
  table.azimuth_out_rad = table.azimuth_in_rad;
  table.wavelength_um = {1.0};
  for (const double a : table.zenith_in_rad)
    for (const double p : table.azimuth_in_rad)
      for (const double b : table.zenith_out_rad)
        for (const double q : table.azimuth_out_rad) table.brdf.push_back(f(a, p, b, q));
  return table;
}

MeasuredBrdf constant(double value) {
  MeasuredBrdf table{{0.0, 0.7, 1.4}, {0.0, 0.7, 1.4}, {0.0, pi}, {1.0}, {}, {}, {}};
  table.brdf.assign(18, value);
  return table;
}

std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// Zenith angles and azimuths in deg, seen from the front; a view at more than 90 deg is behind.
BsdfEvent event_at(double in_deg, double in_azimuth, double out_deg, double out_azimuth) {
  BsdfEvent event;
  event.incoming = at(in_deg * kDegree, in_azimuth * kDegree);
  event.outgoing = at(out_deg * kDegree, out_azimuth * kDegree);
  event.normal = {0.0, 0.0, event.outgoing.z > 0.0 ? 1.0 : -1.0};
  event.tangent = {1.0, 0.0, 0.0};
  event.side = event.incoming.z * event.outgoing.z > 0.0 ? Side::reflected : Side::transmitted;
  return event;
}

std::shared_ptr<const BsdfTable> table(const MeasuredBrdf& from,
                                       BsdfTable::Kind kind = BsdfTable::Kind::reflected) {
  return std::make_shared<BsdfTable>(from, false, kind);
}

TEST(MeasuredSheets, WardAsATableIsWard) {
  const Ward ward(Spectrum::constant(0.2), Spectrum::constant(0.3), 0.4, 0.7, 0.0);
  const Function f = [&](double a, double p, double b, double q) {
    return brdf_at(ward, event_at(a / kDegree, p / kDegree, b / kDegree, q / kDegree));
  };
  const Tabulated bsdf(Spectrum::constant(1.0), table(measured(f, 10.0, 15.0)));
  EXPECT_FALSE(bsdf.is_isotropic());
  for (const double p : {0.0, 45.0, 195.0})
    for (const double q : {0.0, 90.0, 345.0})
      for (const double b : {10.0, 60.0, 80.0}) {
        const BsdfEvent event = event_at(30.0, p, b, q);
        EXPECT_NEAR(brdf_at(bsdf, event), brdf_at(ward, event), 1e-5 * brdf_at(ward, event));
      }
  // Between its points, and in the mean.
  for (const double q : {7.0, 100.0, 250.0, 352.0}) {
    const BsdfEvent event = event_at(35.0, 20.0, 25.0, q);
    EXPECT_NEAR(brdf_at(bsdf, event), brdf_at(ward, event), 0.03 * brdf_at(ward, event)) << q;
  }
  const double whole = test::hemispherical_at(ward, 0.8);
  EXPECT_NEAR(test::hemispherical_at(bsdf, 0.8), whole, 0.01 * whole);
  // A table whose azimuths are 45 deg off is another surface.
  const Tabulated turned(Spectrum::constant(1.0), table(measured(f, 10.0, 15.0)), nullptr, 45.0 * kDegree);
  const BsdfEvent event = event_at(30.0, 0.0, 60.0, 180.0), other = event_at(30.0, 45.0, 60.0, 225.0);
  EXPECT_GT(std::abs(brdf_at(turned, event) / brdf_at(ward, event) - 1.0), 0.1);
  EXPECT_NEAR(brdf_at(turned, other), brdf_at(ward, event), 1e-5);
}

TEST(MeasuredSheets, ALambertianTransmitterIsLamberts) {
  const Tabulated bsdf(Spectrum::constant(1.0), table(constant(0.3 / pi)),
                       table(constant(0.5 / pi), kThrough));
  ASSERT_TRUE(bsdf.may_transmit());
  const BsdfEvent through = event_at(20.0, 10.0, 140.0, 200.0), back = event_at(20.0, 10.0, 50.0, 200.0);
  EXPECT_NEAR(brdf_at(bsdf, through), 0.5 / pi, 1e-6);
  EXPECT_NEAR(brdf_at(bsdf, back), 0.3 / pi, 1e-6);
  EXPECT_NEAR(directional_hemispherical(bsdf, Side::reflected, 0.6).at(1.0), 0.3, 2e-4);
  EXPECT_NEAR(directional_hemispherical(bsdf, Side::transmitted, 0.6).at(1.0), 0.5, 2e-4);
  Material sheet{"paper", Spectrum::constant(1.0)};
  sheet.bsdf = std::make_shared<Tabulated>(bsdf);
  EXPECT_NO_THROW(check(sheet));
}

TEST(MeasuredSheets, WhatGoesStraightOnIsOpposite) {
  // A forward peak in an isotropic table: azimuth 180 deg, alike zenith angles.
  MeasuredBrdf peak{{0.0, 0.7, 1.4}, {0.0, 0.7, 1.4}, {0.0, 0.5 * pi, pi}, {1.0}, {}, {}, {}};
  for (const double in : peak.zenith_in_rad)
    for (const double out : peak.zenith_out_rad)
      for (const double azimuth : peak.azimuth_rad)
        peak.brdf.push_back(in == out && azimuth == pi ? 0.3 : 0.02);
  const Tabulated bsdf(Spectrum::constant(1.0), table(constant(0.01)), table(peak, kThrough));
  const double deg = 0.7 / kDegree;
  EXPECT_NEAR(brdf_at(bsdf, event_at(deg, 40.0, 180.0 - deg, 220.0)), 0.3, 1e-6) << "straight on";
  EXPECT_NEAR(brdf_at(bsdf, event_at(deg, 40.0, 180.0 - deg, 40.0)), 0.02, 1e-6) << "bent back";
}

/// A sheet that is skew: its azimuths tell left from right, and which side they are seen from.
double skew(double a, double p, double b, double q) {
  const double light = std::sin(a) * (std::cos(p) + 0.5 * std::sin(p));
  const double view = std::sin(b) * (std::cos(q) - 0.5 * std::sin(q));  // of its own side, where q is -q
  return 0.1 * (1.0 + 0.3 * (light + view) + 0.4 * light * view);
}

TEST(MeasuredSheets, AzimuthsAreSeenFromTheSideOfTheLight) {
  const double direction_deg = 30.0;
  const auto front =
      std::make_shared<Tabulated>(Spectrum::constant(1.0), table(constant(0.01)),
                                  table(measured(skew, 10.0, 15.0), kThrough), direction_deg * kDegree);
  const std::shared_ptr<const Bsdf> behind = front->behind();
  ASSERT_NE(behind, nullptr);
  for (const double p : {0.0, 45.0, 285.0})
    for (const double q : {15.0, 120.0, 330.0}) {
      // Light in front, view behind: azimuths as seen from the front.
      const BsdfEvent event = event_at(40.0, p + direction_deg, 150.0, q + direction_deg);
      const double expected = skew(40.0 * kDegree, p * kDegree, 30.0 * kDegree, q * kDegree);
      EXPECT_NEAR(brdf_at(*behind, event), expected, 1e-5);
      // And the other way round.
      BsdfEvent other = event;
      std::swap(other.incoming, other.outgoing);
      other.normal = {0.0, 0.0, 1.0};
      EXPECT_NEAR(brdf_at(*front, other), brdf_at(*behind, event), 1e-7) << "reciprocal";
    }
  // The front in place of the back is a twin that must fail: its direction lies elsewhere.
  const BsdfEvent event = event_at(40.0, 45.0 + direction_deg, 150.0, 120.0 + direction_deg);
  EXPECT_GT(std::abs(brdf_at(*front, event) -
                     skew(40.0 * kDegree, 45.0 * kDegree, 30.0 * kDegree, 120.0 * kDegree)),
            0.003);
}

TEST(MeasuredSheets, NarrowPeaksAreTold) {
  // Lambert and Ward of a slope of 0.3 have none; of 0.06 it is 4 pi slope^2 or so wide, or as wide as a cell.
  EXPECT_GT(table(constant(0.1))->narrowest_peak_sr(), 1.0);
  const auto ward = [](double width) {
    const auto bsdf =
        std::make_shared<Ward>(Spectrum::constant(0.2), Spectrum::constant(0.2), width, width, 0.0);
    MeasuredBrdf from;
    for (double zenith = 0.0; zenith < 80.0; zenith += 3.0) from.zenith_in_rad.push_back(zenith * kDegree);
    from.zenith_out_rad = from.zenith_in_rad;
    for (double azimuth = 0.0; azimuth <= 180.0; azimuth += 4.5)
      from.azimuth_rad.push_back(azimuth * kDegree);
    from.wavelength_um = {1.0};
    for (const double in : from.zenith_in_rad)
      for (const double out : from.zenith_out_rad)
        for (const double azimuth : from.azimuth_rad)
          from.brdf.push_back(brdf_at(*bsdf, event_at(in / kDegree, 0.0, out / kDegree, azimuth / kDegree)));
    return table(from)->narrowest_peak_sr();
  };
  EXPECT_GT(ward(0.3), 0.126);
  EXPECT_LT(ward(0.06), 0.126);
  EXPECT_GT(ward(0.06), 0.01);
}

TEST(MeasuredSheets, TablesThatCannotBeAreTold) {
  const auto both = [](double back, double through, bool repair) {
    BsdfTable r(constant(back / pi), repair), t(constant(through / pi), repair, kThrough);
    BsdfTable::limit_sum(r, t, repair);
    return r;
  };
  EXPECT_EQ(complaint([&] { both(0.4, 0.5, false); }), "none");
  EXPECT_EQ(
      complaint([&] { both(0.6, 0.5, false); }),
      "at 1 um it sends back and lets through 1.1 times what comes 0 deg from the normal; \"repair\": true scales such "
      "wavelengths down");
  const BsdfTable mended = both(0.6, 0.5, true);
  EXPECT_NEAR(mended.brdf(0, 1, 0)[0], 0.6 / 1.1 / pi, 1e-4);
  ASSERT_EQ(mended.changes().size(), 1u);
  EXPECT_EQ(
      complaint([] { BsdfTable(constant(1.3 / pi), false, kThrough); }),
      "at 1 um it lets through 1.3 times what comes 0 deg from the normal; \"repair\": true scales such wavelengths down");
  EXPECT_EQ(
      complaint([] {
        BsdfTable r(constant(0.1), false);
        MeasuredBrdf other = constant(0.1);
        other.wavelength_um = {1.1};
        BsdfTable t(other, false, kThrough);
        BsdfTable::limit_sum(r, t, false);
      }),
      "what is reflected and what is transmitted are told at unlike wavelengths: 1.1 um is of one alone");
  MeasuredBrdf half = measured(skew, 40.0, 45.0);
  half.azimuth_out_rad.resize(5);  // to 180 deg alone
  half.brdf.resize(3 * 8 * 3 * 5, 0.1);
  EXPECT_EQ(
      complaint([&] { const BsdfTable made(half, false); }),
      "azimuths of the view go round and leave out no more than 90 deg; there is none between 180 and 360 deg");
  // As seen from one side skew() is not reciprocal.
  EXPECT_NE(
      complaint([] { const BsdfTable made(measured(skew, 20.0, 30.0), false); }).find("not reciprocal by"),
      std::string::npos);
}

}  // namespace
}  // namespace ifov::materials::test_measured_sheets
