#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/facet_distribution.h"
#include "materials/bsdf/microfacet/facet_reflection.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/microfacet/gaussian_slopes.h"
#include "materials/reflectance_events.h"
#include "radiometry/fresnel.h"
#include "support/truth_data.h"

namespace ifov::materials::test_microfacet {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;
using test::kDegree;

double unpolarized(std::complex<double> index, double cosine) {
  const auto r = radiometry::fresnel_reflection_amplitudes(index, cosine);
  return 0.5 * (std::norm(r.p) + std::norm(r.s));
}

struct Widths {
  double x, y;
};
constexpr Widths kWidths[] = {{0.02, 0.02}, {0.1, 0.1}, {0.4, 0.4}, {1.0, 1.0}, {0.02, 0.3}, {0.8, 0.1}};
constexpr FacetShape kShapes[] = {FacetShape::ggx, FacetShape::beckmann};

/// Integral over the facets' normals of f, by slopes in units of the widths.
template <class F>
double over_facets(Widths w, const F& f) {
  constexpr int kRadii = 1500, kAzimuths = 360;
  double sum = 0.0;
  for (int i = 0; i < kRadii; ++i)
    for (int j = 0; j < kAzimuths; ++j) {
      const double t = (i + 0.5) / kRadii, r = t / (1.0 - t), azimuth = 2.0 * pi * (j + 0.5) / kAzimuths;
      const Vec3 h = math::normalized({r * std::cos(azimuth) * w.x, r * std::sin(azimuth) * w.y, 1.0});
      sum += f(h) * h.z * h.z * h.z * w.x * w.y * r / ((1.0 - t) * (1.0 - t));
    }
  return sum * 2.0 * pi / (kRadii * kAzimuths);
}

TEST(FacetDistribution, FacetsCoverTheMeanSurfaceAndWhatIsSeenOfThem) {
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const FacetDistribution facets(shape, w.x, w.y);
      EXPECT_NEAR(over_facets(w, [&](Vec3 h) { return facets.density(h) * h.z; }), 1.0, 1e-4) << w.x;
      for (const Vec3 view : {at(0.0, 0.0), at(0.9, 0.4), at(1.4, 2.0)})
        EXPECT_NEAR(
            over_facets(w, [&](Vec3 h) { return facets.density(h) * std::max(0.0, math::dot(view, h)); }) /
                facets.projected_area(view),
            1.0, 2e-4)
            << w.x;
    }
}

TEST(FacetDistribution, InvertsItsWarp) {
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const FacetDistribution facets(shape, w.x, w.y);
      for (const Vec3 view : {at(0.0, 0.0), at(0.5, 2.0), at(1.2, -1.0), at(1.5, 0.3)})
        for (int i = 0; i < 25; ++i)
          for (int j = 0; j < 25; ++j) {
            const sampling::Point2 u{(i + 0.5) / 25, (j + 0.5) / 25};
            const sampling::Point2 found = facets.invert_visible(view, facets.sample_visible(view, u));
            EXPECT_NEAR(found.x, u.x, 1e-10) << w.x << ' ' << w.y;
            EXPECT_NEAR(found.y, u.y, 1e-10) << w.x << ' ' << w.y;
          }
    }
}

TEST(GaussianSlopes, QuantilesAreInverses) {
  for (const double share : {1e-12, 1e-6, 0.01, 0.3, 0.5, 0.7, 0.999, 1.0 - 1e-9}) {
    EXPECT_NEAR(gaussian_slopes::share(gaussian_slopes::quantile(share)) / share, 1.0, 1e-12) << share;
    for (const double angle : {0.0, 0.3, 1.0, 1.5, 1.57})
      EXPECT_NEAR(gaussian_slopes::seen_share(
                      std::cos(angle), std::sin(angle),
                      gaussian_slopes::seen_quantile(std::cos(angle), std::sin(angle), share)) /
                      share,
                  1.0, 1e-12)
          << share << ' ' << angle;
  }
}

TEST(FacetReflection, SeesNoMoreThanItsDensityTimesOne) {
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const FacetDistribution facets(shape, w.x, w.y);
      for (const double out : {0.0, 0.7, 1.4, 1.55})
        for (const double in : {0.1, 0.8, 1.5})
          for (const double azimuth : {0.0, 1.0, 3.0}) {
            const Vec3 o = at(out, 0.3), i = at(in, azimuth);
            const FacetReflection there(facets, o, i), back(facets, i, o);
            EXPECT_EQ(there.bsdf, back.bsdf);
            EXPECT_EQ(there.cosine, back.cosine);
            EXPECT_LE(there.bsdf * i.z, there.density * (1.0 + 1e-12));
          }
    }
}

TEST(FresnelRows, AreFresnelsEquations) {
  const auto worst = [](std::complex<double> index) {
    const auto rows =
        FresnelRows::of_index(Spectrum::constant(index.real()), Spectrum::constant(index.imag()));
    double found = 0.0;
    for (int k = 0; k <= 5000; ++k) {
      const double cosine = k / 5000.0;
      const RowWeights w = FresnelRows::at(cosine);
      double value = 0.0;
      for (std::size_t i = 0; i < 4; ++i) value += w.weight[i] * rows[w.first + i].values()[0];
      found = std::max(found, std::abs(value - unpolarized(index, cosine)));
    }
    return found;
  };
  for (const std::complex<double> index :
       {std::complex(1.33, 0.0), {1.5, 0.0}, {2.4, 0.0}, {0.2, 3.9}, {1.28, 7.3}})
    EXPECT_LT(worst(index), 3e-5) << index.real();
  EXPECT_LT(worst({3.5, 36.0}), 2e-4);
  EXPECT_LT(worst({10.0, 60.0}), 4e-4);
}

TEST(FresnelRows, TheMeanIsThatOfAHemisphere) {
  double closed = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double cosine = (k + 0.5) / 20000;
    closed += unpolarized(1.5, cosine) * 2.0 * cosine / 20000;
  }
  const auto rows = FresnelRows::of_index(Spectrum::constant(1.5), Spectrum::constant(0.0));
  double mean = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) mean += FresnelRows::mean_weights()[k] * rows[k].values()[0];
  EXPECT_NEAR(mean, closed, 2e-5);
  // Duntley's closed form of it (Walsh 1926): 0.09178 for 1.5.
  EXPECT_NEAR(mean, 0.09178, 2e-5);
}

TEST(FresnelRows, BetweenWavelengthsTheyFollowTheIndex) {
  // Where n runs through 1 and k rises, reflectance is far from straight.
  const Spectrum n({8.0, 9.0}, {0.5, 3.0}), k({8.0, 9.0}, {0.1, 2.0});
  const auto rows = FresnelRows::of_index(n, k);
  EXPECT_GT(rows[0].values().size(), 8u);
  double refined = 0.0, coarse = 0.0;
  for (int j = 0; j <= 200; ++j) {
    const double um = 8.0 + j / 200.0;
    const double expected = unpolarized({n.at(um), k.at(um)}, 1.0);
    refined = std::max(refined, std::abs(rows[32].at(um) - expected));
    coarse = std::max(
        coarse, std::abs(rows[32].at(8.0) + (um - 8.0) * (rows[32].at(9.0) - rows[32].at(8.0)) - expected));
  }
  EXPECT_LT(refined, 5e-4);
  EXPECT_GT(coarse, 0.03);
}

/// M00 of the facet model of SCATMECH (NIST): Gaussian facets whose slope parameter is the width, no shadowing or that of Torrance
/// and Sparrow 1967. Azimuth 0 is the side of the mirror image.
TEST(FacetReflection, IsThatOfScatmech) {
  const auto file = ifov::test::truth_file("atmosphere/pbrdf_scatmech/facet_gaussian_mueller.csv");
  if (!file) GTEST_SKIP() << "reference data not found";
  std::ifstream lines(*file);
  std::string line;
  std::getline(lines, line);
  int count = 0;
  double worst = 0.0, other_width = 0.0, no_jacobian = 0.0;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
    const auto value = [&](std::size_t k) { return std::stod(cells[k]); };
    const Vec3 in = at(value(5) * kDegree, 0.0), out = at(value(6) * kDegree, pi - value(7) * kDegree);
    const Vec3 h = math::normalized(in + out);
    const double cosine = math::dot(in, h);
    const auto m00 = [&](double width) {
      double g = 1.0;
      if (cells[3] != "none") g = std::min({1.0, 2.0 * h.z * in.z / cosine, 2.0 * h.z * out.z / cosine});
      return FacetDistribution(FacetShape::beckmann, width, width).density(h) * g *
             unpolarized({value(1), value(2)}, cosine) / (4.0 * in.z * out.z);
    };
    const double expected = value(8);
    const double scale = std::max(expected, 1e-12);
    worst = std::max(worst, std::abs(m00(value(4)) - expected) / scale);
    other_width = std::max(other_width, std::abs(m00(value(4) * std::numbers::sqrt2) - expected) / scale);
    no_jacobian = std::max(no_jacobian, std::abs(m00(value(4)) * 4.0 * cosine - expected) / scale);
    ++count;
  }
  EXPECT_EQ(count, 840);
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(other_width, 0.1);
  EXPECT_GT(no_jacobian, 0.1);
}

TEST(FacetAlbedo, OneTableServesAllOfTheSameFacets) {
  const auto a = FacetAlbedo::shared(FacetShape::ggx, 0.31, 0.31),
             b = FacetAlbedo::shared(FacetShape::ggx, 0.31, 0.31),
             c = FacetAlbedo::shared(FacetShape::ggx, 0.32, 0.32);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
  // Rougher facets send more of their light to each other.
  EXPECT_LT(a->mean_lost(), FacetAlbedo::shared(FacetShape::ggx, 0.8, 0.8)->mean_lost());
}

}  // namespace
}  // namespace ifov::materials::test_microfacet
