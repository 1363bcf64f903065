#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/polarized/facet_brdf.h"
#include "materials/bsdf/polarized/maignan.h"
#include "materials/lobe_checks.h"
#include "materials/material.h"
#include "radiometry/fresnel.h"
#include "radiometry/polarization_frame.h"
#include "support/truth_data.h"

namespace ifov::materials::test_facet_brdf {
namespace {

using math::Vec3;
using radiometry::MuellerMatrix;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;
using test::kDegree;

constexpr FacetBrdf::Obscuration kObscuration{8.0 * kDegree, 20.0 * kDegree};

std::shared_ptr<const FacetBrdf> target(const FacetBrdf::Surface& surface, std::complex<double> index,
                                        double diffuse = 0.0, double volume = 0.0) {
  return std::make_shared<FacetBrdf>(surface, Spectrum::constant(index.real()),
                                     Spectrum::constant(index.imag()), Spectrum::constant(diffuse),
                                     Spectrum::constant(volume));
}

MuellerMatrix matrix_of(const Bsdf& bsdf, const BsdfEvent& event) {
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const auto& list : {bsdf.spectra(), bsdf.polarization_spectra()})
    for (const Spectrum& spectrum : list) values.push_back(static_cast<float>(spectrum.at(1.0)));
  for (const float& value : values) rows.push_back(&value);
  float found[16];
  bsdf.evaluate_mueller(event, rows, 1, {found, 1, true});
  std::array<double, 16> m{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) m[4 * r + c] = static_cast<double>(found[4 * c + r]);
  return MuellerMatrix(m);
}

/// Largest difference of priest_germer from the matrices of NIST's SCATMECH with the shadow of Torrance and
/// Sparrow, of their element 0, 0. SCATMECH has Q = I_s - I_p: x of its frames is s, which is level.
double worst_of_scatmech(FacetBrdf::Masking masking, int& count) {
  std::ifstream file(*ifov::test::truth_file("atmosphere/pbrdf_scatmech/facet_gaussian_mueller.csv"));
  std::map<std::string, std::shared_ptr<const FacetBrdf>> models;
  double worst = 0.0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream stream(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 24 || cells[0] == "material" || cells[3] == "none") continue;
    const auto value = [&](std::size_t k) { return std::strtod(cells[k].c_str(), nullptr); };
    std::shared_ptr<const FacetBrdf>& model = models[cells[0] + cells[4]];
    if (!model)
      model =
          target({FacetBrdf::Slopes::gaussian, value(4) / std::numbers::sqrt2, masking, std::nullopt, 1.0},
                 {value(1), value(2)});
    const double in = value(5) * kDegree, azimuth = value(7) * kDegree;
    const Vec3 before{std::sin(in), 0.0, -std::cos(in)}, after = at(value(6) * kDegree, azimuth);
    radiometry::PolarizationFrame first = radiometry::meridional_frame(before.z, 0.0),
                                  last = radiometry::meridional_frame(after.z, azimuth);
    first.x = first.y();
    last.x = last.y();
    const Vec3 up{0.0, 0.0, 1.0};
    const MuellerMatrix m = radiometry::turned(radiometry::surface_frame(after, up), last) *
                            matrix_of(*model, {after, -before, {0, 0, 1}, {}}) *
                            radiometry::turned(first, radiometry::surface_frame(before, up));
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        worst = std::max(worst, std::abs(m(r, c) - value(8 + 4 * r + c)) / (value(8) + 1e-6));
    ++count;
  }
  return worst;
}

TEST(FacetBrdf, PriestGermerIsThatOfScatmech) {
  if (!ifov::test::truth_file("atmosphere/pbrdf_scatmech/facet_gaussian_mueller.csv"))
    GTEST_SKIP() << "no reference data";
  int count = 0;
  EXPECT_LT(worst_of_scatmech(FacetBrdf::Masking::torrance_sparrow, count), 1e-3);
  EXPECT_EQ(count, 420);
  EXPECT_GT(worst_of_scatmech(FacetBrdf::Masking::smith, count), 0.01);
}

TEST(FacetBrdf, MaxwellAndBeardsScanShowsTheFacets) {
  // Light and view together: no obscuration, F(0) B / (4 cos^2 cos^3 (slope^2 + tan^2)).
  const double slope = 0.15, bias = FacetBrdf::covering_bias(slope);
  const auto model =
      target({FacetBrdf::Slopes::maxwell_beard, slope, FacetBrdf::Masking::smith, kObscuration, bias}, 1.5);
  for (const double deg : {0.0, 20.0, 60.0}) {
    BsdfEvent event = test::view_of(at(deg * kDegree, 0.4));
    event.incoming = event.outgoing;
    const double cosine = std::cos(deg * kDegree), tangent = std::tan(deg * kDegree);
    const double scan = 0.04 * bias / (4.0 * std::pow(cosine, 5) * (slope * slope + tangent * tangent));
    EXPECT_NEAR(test::brdf_at(*model, event), scan, 1e-3 * scan) << deg;
  }
  // Facets that cover the surface, added up.
  for (const double width : {0.1, 0.5, 1.0}) {
    double covered = 0.0;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
      const double tilt = 0.5 * pi * (k + 0.5) / kSteps;
      const double d = 1.0 / (std::pow(std::cos(tilt), 3) * (width * width + std::pow(std::tan(tilt), 2)));
      covered += d * std::cos(tilt) * std::sin(tilt) * pi * pi / kSteps;
    }
    EXPECT_NEAR(FacetBrdf::covering_bias(width) * covered, 1.0, 1e-4) << width;
  }
}

TEST(FacetBrdf, ObscurationIsThatOfMaxwellAndBeard) {
  // By hand, with t = 0.2, b = 0.5: (1 + 0.2/0.7 exp(-1/0.25)) / (1 + 0.2/0.7).
  EXPECT_NEAR((FacetBrdf::Obscuration{0.25, 0.7}).share(0.2, 0.5), 0.781847920, 1e-9);
  EXPECT_EQ(kObscuration.share(0.0, 1.0), 1.0);
  EXPECT_EQ(kObscuration.share(0.7, 0.0), 1.0);
  const FacetBrdf::Surface open{FacetBrdf::Slopes::gaussian, 0.2, FacetBrdf::Masking::smith, std::nullopt,
                                1.0};
  FacetBrdf::Surface obscured = open;
  obscured.obscuration = kObscuration;
  BsdfEvent event = test::view_of(at(0.9, 0.0));
  event.incoming = at(0.5, 2.0);
  const Vec3 facet = math::normalized(event.outgoing + event.incoming);
  const double share = kObscuration.share(std::acos(facet.z), std::acos(math::dot(facet, event.incoming)));
  EXPECT_NEAR(test::brdf_at(*target(obscured, 1.5), event), share * test::brdf_at(*target(open, 1.5), event),
              1e-8);
  EXPECT_LT(share, 0.7);
}

TEST(FacetBrdf, VolumeAndDiffusePartsAddUp) {
  // Facets of air: 4 (1 - ln 2) of the volume part comes back of light from above, all of the diffuse one.
  const auto model =
      target({FacetBrdf::Slopes::gaussian, 0.2, FacetBrdf::Masking::smith, kObscuration, 1.0}, 1.0, 0.3, 0.2);
  EXPECT_NEAR(test::hemispherical_at(*model, 1.0), 0.3 + 0.2 * 4.0 * (1.0 - std::numbers::ln2), 3e-4);
}

TEST(FacetBrdf, AreReciprocalInvertTheirWarpAndDrawByTheirDensity) {
  const FacetBrdf::Surface surfaces[] = {
      {FacetBrdf::Slopes::gaussian, 0.1, FacetBrdf::Masking::torrance_sparrow, std::nullopt, 1.0},
      {FacetBrdf::Slopes::gaussian, 0.3, FacetBrdf::Masking::smith, kObscuration, 1.0},
      {FacetBrdf::Slopes::maxwell_beard, 0.2, FacetBrdf::Masking::smith, kObscuration, 0.05}};
  for (const FacetBrdf::Surface& surface : surfaces) {
    const auto model = target(surface, {1.4, 0.4}, 0.1, 0.05);
    const double width = model->lobe_slopes().least;
    for (const Vec3 out : {at(0.2, 0.0), at(0.9, 0.5), at(1.45, 2.0)}) {
      EXPECT_GT(test::samples_against_density(*model, out, width, width, 20000), 1e-3 / 9.0);
      for (int k = 0; k < 100; ++k) {
        BsdfEvent event = test::view_of(out);
        const BsdfSample sample = model->sample(event, (k % 10 + 0.5) / 10, (k / 10 + 0.5) / 10);
        if (!(sample.weight > 0.0)) continue;
        event.incoming = sample.incoming;
        EXPECT_LT(sample.weight * model->grey(event), 4.0);
        const UnitSquarePoint u = model->invert(event);
        EXPECT_LT(math::length(model->sample(event, u.u1, u.u2).incoming - sample.incoming), 1e-10);
        const double there = test::brdf_at(*model, event);
        std::swap(event.outgoing, event.incoming);
        EXPECT_NEAR(test::brdf_at(*model, event), there, 4e-7 * there);
      }
    }
  }
}

TEST(FacetBrdf, SendBackNoMoreThanArrives) {
  // Mirrors for facets, which lose what they send to each other.
  for (const double slope : {0.08, 0.2, 0.5})
    for (const FacetBrdf::Surface& surface :
         {FacetBrdf::Surface{FacetBrdf::Slopes::gaussian, slope, FacetBrdf::Masking::torrance_sparrow,
                             std::nullopt, 1.0},
          FacetBrdf::Surface{FacetBrdf::Slopes::gaussian, slope, FacetBrdf::Masking::smith, kObscuration,
                             1.0},
          FacetBrdf::Surface{FacetBrdf::Slopes::maxwell_beard, slope, FacetBrdf::Masking::smith, kObscuration,
                             FacetBrdf::covering_bias(slope)}}) {
      const auto model = target(surface, {0.1, 50.0});
      for (const double cosine : {1.0, 0.5, 0.1, 0.02})
        EXPECT_LT(test::hemispherical_at(*model, cosine), 1.001)
            << slope << ' ' << cosine << ' ' << static_cast<int>(surface.slopes);
    }
}

TEST(Maignan, IsItsFormulaWithFresnelsMatrix) {
  const Maignan model(Spectrum::constant(0.2), 6.0, 0.5, Spectrum::constant(1.5));
  for (const double out_deg : {0.0, 50.0, 70.0}) {
    BsdfEvent event = test::view_of(at(out_deg * kDegree, 0.3));
    event.incoming = at(40.0 * kDegree, pi);
    const double angle = 0.5 * std::acos(math::dot(event.outgoing, event.incoming));
    const auto r = radiometry::fresnel_reflection_amplitudes(1.5, std::cos(angle));
    const double level = 6.0 * std::exp(-std::tan(angle) - 0.5) /
                         (4.0 * (std::cos(out_deg * kDegree) + std::cos(40.0 * kDegree)));
    const double whole = 0.5 * (std::norm(r.p) + std::norm(r.s)),
                 across = 0.5 * (std::norm(r.s) - std::norm(r.p));
    EXPECT_NEAR(pi * test::brdf_at(model, event), 0.2 + level * whole, 2e-5);
    const MuellerMatrix m = matrix_of(model, event);
    EXPECT_NEAR(pi * std::hypot(m(1, 0), m(2, 0)), level * across, 2e-5);
    EXPECT_NEAR(pi * m(0, 0), 0.2 + level * whole, 2e-5);
    if (out_deg == 0.0) {  // R_s - R_p, not their sum
      EXPECT_GT(std::abs(pi * std::hypot(m(1, 0), m(2, 0)) - level * whole), 1e-3);
    }
  }
  Material grass{"grass", Spectrum::constant(0.5)};
  grass.bsdf = std::make_shared<Maignan>(Spectrum::constant(0.5), 7.0, 0.0, Spectrum::constant(1.5));
  EXPECT_NO_THROW(check(grass));
}

}  // namespace
}  // namespace ifov::materials::test_facet_brdf
