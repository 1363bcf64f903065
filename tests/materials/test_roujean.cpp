#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/reflection_angles.h"
#include "materials/bsdf/ross_li.h"
#include "materials/bsdf/roujean.h"
#include "materials/material.h"
#include "materials/reflectance_events.h"

namespace ifov::materials::test_roujean {
namespace {

using radiometry::Spectrum;
using std::numbers::pi;
using test::event_of;
using test::kDegree;
using test::reflectance_factor;

Roujean model(double k0, double k1, double k2) {
  return {Spectrum::constant(k0), Spectrum::constant(k1), Spectrum::constant(k2)};
}

/// What f1 stands for, by its picture: long thin walls of unit height that look everywhere. Mean over their azimuth of the
/// part of them that is lit and seen, over the light and the ground's projection, less the ground that is in shadow or
/// hidden.
double walls(double in_deg, double out_deg, double azimuth_deg, double overlap = 1.0) {
  constexpr int kAzimuths = 20000;
  const double tan_in = std::tan(in_deg * kDegree), tan_out = std::tan(out_deg * kDegree);
  double sum = 0.0;
  for (int k = 0; k < kAzimuths; ++k) {
    const double normal = 2.0 * pi * (k + 0.5) / kAzimuths;
    const double in = tan_in * std::cos(normal), out = tan_out * std::cos(azimuth_deg * kDegree - normal);
    // Two sides; shadow and hidden ground start at the same line, and overlap where they lie on one side of it.
    const double same = in * out > 0.0 ? 1.0 : 0.0;
    sum += same * in * out -
           (std::abs(in) + std::abs(out) - overlap * same * std::min(std::abs(in), std::abs(out)));
  }
  return sum / kAzimuths;
}

TEST(Roujean, TheGeometricKernelIsThatOfWalls) {
  for (const double in : {0.0, 30.0, 60.0})
    for (const double out : {0.0, 30.0, 45.0, 70.0})
      for (const double azimuth : {0.0, 20.0, 90.0, 150.0, 180.0}) {
        const double kernel = Roujean::kernels(event_of(out, in, azimuth))[0];
        EXPECT_NEAR(kernel, walls(in, out, azimuth), 1e-6 * (1.0 + std::abs(kernel)))
            << in << ' ' << out << ' ' << azimuth;
      }
  EXPECT_GT(std::abs(Roujean::kernels(event_of(30.0, 30.0, 20.0))[0] - walls(30.0, 30.0, 20.0, 0.0)), 0.1)
      << "planted: shadows are never hidden";
}

TEST(Roujean, TheVolumeKernelIsThatOfRoss) {
  // 4 / (3 pi) of RossThick: their white-sky integrals, too (Lucht et al. 2000, table I: 0.189184).
  const RossLi ross(Spectrum::constant(0.1), Spectrum::constant(0.1), Spectrum::constant(0.1));
  for (const double out : {0.0, 40.0, 75.0})
    for (const double azimuth : {0.0, 70.0, 180.0}) {
      const BsdfEvent event = event_of(out, 35.0, azimuth);
      EXPECT_NEAR(Roujean::kernels(event)[1], 4.0 / (3.0 * pi) * ross.kernels(event)[0], 1e-12);
    }
  const double with =
      directional_hemispherical(model(0.3, 0.0, 0.2), Side::reflected, kBihemispherical).values()[0];
  EXPECT_NEAR(with, 0.3 + 0.2 * 4.0 / (3.0 * pi) * 0.189184, 6e-4);
}

TEST(Roujean, UprightKernelsAreZero) {
  for (const double kernel : Roujean::kernels(event_of(0.0, 0.0, 0.0))) EXPECT_NEAR(kernel, 0.0, 1e-12);
  EXPECT_NEAR(reflectance_factor(model(0.23, 0.1, 0.4), event_of(0.0, 0.0, 0.0)), 0.23, 1e-6);
}

TEST(Roujean, IsReciprocalAndNeverNegative) {
  const Roujean bsdf = model(0.2, 0.05, 0.3);
  for (const double out : {0.0, 20.0, 70.0, 89.5})
    for (const double in : {10.0, 60.0, 89.9})
      for (const double azimuth : {0.0, 50.0, 180.0}) {
        const double there = reflectance_factor(bsdf, event_of(out, in, azimuth));
        EXPECT_NEAR(there, reflectance_factor(bsdf, event_of(in, out, -azimuth)), 1e-6 * there + 1e-9);
        EXPECT_GE(there, 0.0);
        const std::array<double, 2> a = Roujean::kernels(event_of(out, in, azimuth)),
                                    b = Roujean::kernels(event_of(in, out, -azimuth));
        for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(a[k], b[k], 1e-9 * (1.0 + std::abs(a[k])));
      }
  EXPECT_EQ(reflectance_factor(model(0.03, 0.05, 0.0), event_of(75.0, 60.0, 180.0)), 0.0);
}

TEST(Roujean, AMaterialThatSendsBackMoreThanArrivesIsRefused) {
  Material m{"field", Spectrum::constant(0.2)};
  m.bsdf = std::make_shared<Roujean>(model(0.2, 0.03, 0.2));
  EXPECT_NO_THROW(check(m));
  m.bsdf = std::make_shared<Roujean>(model(0.9, 0.0, 0.9));
  EXPECT_THROW(check(m), InputError);
}

}  // namespace
}  // namespace ifov::materials::test_roujean
