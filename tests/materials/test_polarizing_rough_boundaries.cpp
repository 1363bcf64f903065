// Mueller matrices of rough boundaries: the smooth one's as roughness vanishes, matrices that can be, reciprocity into the medium.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "materials/bsdf/boundary/rough_boundary.h"
#include "materials/bsdf/hemisphere.h"
#include "radiometry/coherency.h"
#include "radiometry/fresnel.h"

namespace ifov::materials::test_polarizing_rough_boundaries {
namespace {

using math::Vec3;
using radiometry::MuellerMatrix;
using radiometry::Spectrum;

constexpr double kIndex = 1.5;

std::shared_ptr<const Bsdf> frosted(double width, FacetShape shape = FacetShape::ggx) {
  return RoughBoundary::make(Spectrum::constant(kIndex), Spectrum::constant(0.0), Spectrum::constant(1.0),
                             {shape, width});
}

struct InOneWavelength {
  explicit InOneWavelength(const Bsdf& bsdf) {
    for (const auto& list : {bsdf.spectra(), bsdf.polarization_spectra()})
      for (const Spectrum& spectrum : list) values.push_back(static_cast<float>(spectrum.at(1.0)));
    for (const float& value : values) pointers.push_back(&value);
  }
  std::vector<float> values;
  std::vector<const float*> pointers;
};

MuellerMatrix matrix_of(const Bsdf& bsdf, const InOneWavelength& at, const BsdfEvent& event) {
  float values[16];
  bsdf.evaluate_mueller(event, at.pointers, 1, {values, 1, true});
  std::array<double, 16> m{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) m[4 * r + c] = static_cast<double>(values[4 * c + r]);
  return MuellerMatrix(m);
}

/// Of what the narrow lobe sends towards an angle, integrated over where light comes from.
MuellerMatrix lobe_matrix(const Bsdf& bsdf, Side side, double angle) {
  constexpr int kAcross = 48;
  const InOneWavelength at(bsdf);
  BsdfEvent event{{std::sin(angle), 0.0, std::cos(angle)}, {}, {0, 0, 1}, {}, side};
  const double seam = bsdf.seam(event);
  std::array<double, 16> sum{};
  for (int k = 0; k < kAcross * kAcross; ++k) {
    const BsdfSample sample = bsdf.sample(event, seam + (1.0 - seam) * (k % kAcross + 0.5) / kAcross,
                                          (k / kAcross + 0.5) / kAcross);
    if (!(sample.weight > 0.0)) continue;
    event.incoming = sample.incoming;
    const MuellerMatrix m = matrix_of(bsdf, at, event);
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        sum[4 * r + c] += (1.0 - seam) * sample.weight * m(r, c) / (kAcross * kAcross);
  }
  return MuellerMatrix(sum);
}

double worst_difference(const MuellerMatrix& a, const MuellerMatrix& b) {
  double worst = 0.0;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(a(r, c) - b(r, c)));
  return worst;
}

TEST(PolarizingRoughBoundaries, OfNoRoughnessMatricesAreFresnels) {
  const auto outside = frosted(0.005, FacetShape::beckmann), within = outside->behind();
  for (const double angle : {0.3, 0.6, std::atan(kIndex), 1.2}) {
    const double cosine = std::cos(angle), inside = std::asin(std::sin(angle) / kIndex);
    const MuellerMatrix back = radiometry::fresnel_reflection(kIndex, cosine),
                        on = radiometry::fresnel_transmission(kIndex, cosine);
    EXPECT_LT(worst_difference(lobe_matrix(*outside, Side::reflected, angle), back), 5e-3 * back(0, 0))
        << angle;
    EXPECT_LT(worst_difference(lobe_matrix(*outside, Side::transmitted, angle), on), 5e-3 * on(0, 0))
        << angle;
    EXPECT_LT(worst_difference(lobe_matrix(*within, Side::reflected, inside), back), 5e-3 * back(0, 0))
        << angle;
    EXPECT_LT(worst_difference(lobe_matrix(*within, Side::transmitted, inside), on), 5e-3 * on(0, 0))
        << angle;
    // Planted fault: p and s taken for each other.
    const MuellerMatrix swapped = radiometry::fresnel_reflection(1.0 / kIndex, cosine);
    EXPECT_GT(worst_difference(lobe_matrix(*outside, Side::reflected, angle), swapped),
              angle > 0.8 ? 0.1 : 0.0);
  }
  // Beyond the limit all comes back, turned in phase.
  const double beyond = 0.95;
  const MuellerMatrix total = radiometry::fresnel_reflection(1.0 / kIndex, std::cos(beyond));
  EXPECT_GT(std::abs(total(2, 3)), 0.5);
  EXPECT_LT(worst_difference(lobe_matrix(*within, Side::reflected, beyond), total), 5e-3);
}

TEST(PolarizingRoughBoundaries, MatricesCanBeAndAreReciprocalIntoTheMedium) {
  for (const double width : {0.05, 0.6}) {
    const auto outside = frosted(width), within = outside->behind();
    const InOneWavelength at(*outside);
    double of_u = 0.0, without_sign = 0.0;
    for (const double out : {0.1, 0.7, 1.3})
      for (const double in : {0.2, 0.6, 1.1})
        for (const double azimuth : {0.4, 2.2, 3.1}) {
          BsdfEvent event{{std::sin(out), 0.0, std::cos(out)},
                          {std::sin(in) * std::cos(azimuth), std::sin(in) * std::sin(azimuth), -std::cos(in)},
                          {0, 0, 1},
                          {},
                          Side::transmitted};
          BsdfEvent back{event.incoming, event.outgoing, {0, 0, -1}, {}, Side::transmitted};
          const MuellerMatrix there = matrix_of(*outside, at, event), other = matrix_of(*within, at, back),
                              reversed = other.reversed();
          float whole = 0.0f;
          outside->evaluate(event, at.pointers, 1, &whole);
          const double scale = static_cast<double>(whole);
          ASSERT_GT(scale, 0.0);
          EXPECT_EQ(static_cast<float>(there(0, 0)), whole);
          EXPECT_GT(test::coherency_eigenvalues(there)[0], -1e-5 * scale);
          EXPECT_LT(worst_difference(there, kIndex * kIndex * reversed), 5e-6 * scale) << out << ' ' << in;
          of_u = std::max(of_u, std::abs(there(2, 0)) / scale);
          without_sign =
              std::max(without_sign, std::abs(there(0, 2) - kIndex * kIndex * other(2, 0)) / scale);
          event.incoming.z = -event.incoming.z;
          event.side = Side::reflected;
          for (const auto& side : {outside, within})
            EXPECT_GT(test::coherency_eigenvalues(matrix_of(*side, at, event))[0],
                      -1e-5 * matrix_of(*side, at, event)(0, 0));
        }
    EXPECT_GT(of_u, 0.01) << "nothing turned";
    EXPECT_GT(without_sign, 0.01) << "reciprocity without its sign passes";
  }
}

// What a boundary in a room of one temperature emits is across what it reflects and lets through.
TEST(PolarizingRoughBoundaries, WhatIsLetThroughSwingsAcrossWhatIsReflected) {
  const auto outside = frosted(0.3);
  const InOneWavelength at(*outside);
  for (const double cosine : {0.9, 0.5, 0.2}) {
    float whole[2], q[2];
    polarized_hemispherical(*outside, Side::reflected, at.pointers, 1, cosine, &whole[0], &q[0]);
    polarized_hemispherical(*outside, Side::transmitted, at.pointers, 1, cosine, &whole[1], &q[1]);
    EXPECT_NEAR(whole[0] + whole[1], 1.0f, 1e-3f) << cosine;
    EXPECT_LT(q[0], 0.0f);
    EXPECT_GT(q[1], 0.0f);
  }
}

}  // namespace
}  // namespace ifov::materials::test_polarizing_rough_boundaries
