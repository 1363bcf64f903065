// The polarized contract of scattering models: matrices, frames, emission.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "materials/bsdf/mirror.h"
#include "materials/bsdf/node_bsdf.h"
#include "materials/bsdf/rough_conductor.h"
#include "materials/bsdf/rough_dielectric.h"
#include "radiometry/coherency.h"
#include "radiometry/fresnel.h"
#include "radiometry/polarization_frame.h"
#include "support/truth_data.h"

namespace ifov::materials::test_polarizing_models {
namespace {

using math::Vec3;
using radiometry::MuellerMatrix;
using radiometry::Spectrum;
using radiometry::StokesVector;

constexpr double kDegree = std::numbers::pi / 180.0;
const math::Normal3 kUp{0.0, 0.0, 1.0};

Vec3 direction(double zenith_rad, double azimuth_rad) {
  const double s = std::sin(zenith_rad);
  return {s * std::cos(azimuth_rad), s * std::sin(azimuth_rad), std::cos(zenith_rad)};
}

/// A model's spectra in one wavelength.
struct OneWavelength {
  explicit OneWavelength(const Bsdf& bsdf, double um = 0.6) {
    for (const auto& list : {bsdf.spectra(), bsdf.polarization_spectra()})
      for (const Spectrum& spectrum : list) values.push_back(static_cast<float>(spectrum.at(um)));
    for (const float& value : values) pointers.push_back(&value);
  }
  std::vector<float> values;
  std::vector<const float*> pointers;
};

MuellerMatrix matrix(const Bsdf& bsdf, const OneWavelength& at, const BsdfEvent& event) {
  float values[16];
  bsdf.evaluate_mueller(event, at.pointers, 1, {values, 1, true});
  std::array<double, 16> m{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) m[4 * r + c] = static_cast<double>(values[4 * c + r]);
  return MuellerMatrix(m);
}

/// Models that polarize and are no delta, in the middle of their parameters' ranges.
std::vector<std::pair<std::string, std::shared_ptr<const Bsdf>>> polarizing_models() {
  std::vector<std::pair<std::string, std::shared_ptr<const Bsdf>>> list;
  for (const BsdfModel* model : bsdf_models()) {
    BsdfInputs inputs{Spectrum({0.4, 1.0}, {0.3, 0.6}), {}};
    bool can = true;
    for (const BsdfParameter& p : model->parameters) {
      if (p.key == "proteins" || p.key == "carbon") continue;  // in place of dry matter
      const double middle = 0.5 * (p.low + p.high);
      switch (p.form) {
        case BsdfParameter::Form::word:
          if (!p.optional) inputs.values.emplace_back(p.key, std::string(p.choices().front()));
          break;
        case BsdfParameter::Form::spectrum:
          inputs.values.emplace_back(p.key, Spectrum({0.4, 1.0}, {p.low + 0.2, p.low + 0.7}));
          break;
        case BsdfParameter::Form::brdf_file: can = false; break;
        case BsdfParameter::Form::angle: inputs.values.emplace_back(p.key, middle * kDegree); break;
        case BsdfParameter::Form::length: inputs.values.emplace_back(p.key, middle * 1e-3); break;
        default: inputs.values.emplace_back(p.key, middle);
      }
    }
    if (!can) continue;
    auto bsdf = model->make(inputs);
    if (bsdf->polarizes() && !bsdf->is_delta()) list.emplace_back(model->key, std::move(bsdf));
  }
  return list;
}

TEST(PolarizingModels, AllOfTheRegistryHaveMatricesThatCanBe) {
  const auto models = polarizing_models();
  ASSERT_GE(models.size(), 2u);
  for (const auto& [name, bsdf] : models) {
    const OneWavelength at(*bsdf);
    for (const double out : {0.0, 0.4, 1.1, 1.5})
      for (const double in : {0.0, 0.5, 1.2})
        for (const double azimuth : {0.0, 0.8, 2.5, 3.1416}) {
          BsdfEvent event{direction(out, 0.3), direction(in, 0.3 + azimuth), kUp, {1.0, 0.0, 0.0}};
          const MuellerMatrix m = matrix(*bsdf, at, event);
          float whole = 0.0f, column[4];
          bsdf->evaluate(event, at.pointers, 1, &whole);
          const double scale = static_cast<double>(whole);
          ASSERT_GT(scale, 0.0);
          EXPECT_NEAR(m(0, 0), scale, 1e-6 * scale) << name;
          bsdf->evaluate_mueller(event, at.pointers, 1, {column, 1, false});
          for (std::size_t r = 0; r < 4; ++r)
            EXPECT_NEAR(static_cast<double>(column[r]), m(r, 0), 1e-6 * scale) << name;
          EXPECT_GT(test::coherency_eigenvalues(m)[0], -1e-4 * scale) << name << " " << out << " " << in;
          // Reciprocity: both frames keep their x and turn their y with the direction.
          BsdfEvent back = event;
          std::swap(back.outgoing, back.incoming);
          const MuellerMatrix reversed = matrix(*bsdf, at, back).reversed();
          for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t c = 0; c < 4; ++c)
              EXPECT_NEAR(m(r, c), reversed(r, c), 2e-6 * scale) << name << " " << r << c;
        }
  }
}

TEST(PolarizingModels, AnIdealMirrorKeepsAll) {
  const Vec3 out = direction(0.7, 0.2), in = direction(0.7, 0.2 + std::numbers::pi);
  const MuellerMatrix m = matrix(*Mirror::shared(), OneWavelength(*Mirror::shared()), {out, in, kUp, {}});
  // As of a metal without end: r_p = -r_s.
  const MuellerMatrix metal = radiometry::fresnel_reflection({1e3, 1e6}, std::cos(0.7));
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(m(r, c), metal(r, c), 1e-5);
}

constexpr const char* kFacets = "atmosphere/pbrdf_scatmech/facet_gaussian_mueller.csv";

struct Difference {
  double worst = 0.0;
  int rows = 0;
};

/// All elements of all matrices of SCATMECH's Gaussian facets, without shadow and with that of Torrance and
/// Sparrow: Fresnel's matrix of the facet halfway, turned to the event's frames as models turn theirs. `turn`
/// multiplies the angles' sines.
Difference against_scatmech(float turn) {
  std::ifstream file(*ifov::test::truth_file(kFacets));
  Difference found;
  for (std::string line; std::getline(file, line);) {
    std::istringstream stream(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 24 || cells[0] == "material") continue;
    std::vector<double> x(24, 0.0);
    for (std::size_t k = 1; k < 24; ++k)
      if (k != 3) x[k] = std::strtod(cells[k].c_str(), nullptr);
    const double in = x[5] * kDegree, out = x[6] * kDegree, azimuth = x[7] * kDegree;
    const Vec3 before{std::sin(in), 0.0, -std::cos(in)}, after = direction(out, azimuth);
    const BsdfEvent event{after, -before, kUp, {}};
    const Vec3 facet = math::normalized(after - before);
    const double beta = std::min(1.0, math::dot(facet, after)), lean = std::tan(std::acos(facet.z));
    const double density =
        std::exp(-lean * lean / (x[4] * x[4])) / (std::numbers::pi * x[4] * x[4] * std::pow(facet.z, 4));
    double seen = 1.0;
    if (cells[3] != "none")
      seen = std::min({1.0, 2.0 * facet.z * std::cos(in) / beta, 2.0 * facet.z * std::cos(out) / beta});
    const double scale = density * seen / (4.0 * std::cos(in) * std::cos(out));
    const MuellerMatrix fresnel = scale * radiometry::fresnel_reflection({x[1], x[2]}, beta);
    const float whole = static_cast<float>(fresnel(0, 0)), along = static_cast<float>(fresnel(0, 1)),
                cosine = static_cast<float>(fresnel(2, 2)), sine = static_cast<float>(fresnel(2, 3));
    FacetPlane plane(event);
    plane.sin_in *= static_cast<double>(turn);
    plane.sin_out *= static_cast<double>(turn);
    float values[16];
    write_facets(plane, {&whole, &along, &cosine, &sine}, 1, {values, 1, true});
    std::array<double, 16> ours{};
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c) ours[4 * r + c] = static_cast<double>(values[4 * c + r]);
    // SCATMECH has Q = I_s - I_p: x is s, which is level; at the vertical the azimuth settles it.
    radiometry::PolarizationFrame first = radiometry::meridional_frame(before.z, 0.0),
                                  last = radiometry::meridional_frame(after.z, azimuth);
    first.x = first.y();
    last.x = last.y();
    const Vec3 normal = kUp.as_vector();
    const MuellerMatrix m = turned(radiometry::surface_frame(after, normal), last) * MuellerMatrix(ours) *
                            turned(first, radiometry::surface_frame(before, normal));
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        found.worst = std::max(found.worst, std::abs(m(r, c) - x[8 + 4 * r + c]) / std::max(1.0, x[8]));
    ++found.rows;
  }
  return found;
}

TEST(PolarizingModels, FacetsAreThoseOfAnotherProgram) {
  if (!ifov::test::truth_file(kFacets)) GTEST_SKIP() << "reference data not found: " << kFacets;
  const Difference right = against_scatmech(1.0f);
  EXPECT_EQ(right.rows, 840);
  EXPECT_LT(right.worst, 1e-6);
  EXPECT_GT(against_scatmech(-1.0f).worst, 0.01) << "frames turned the other way pass";
}

std::shared_ptr<const Bsdf> metal(double n, double k, double width, FacetShape shape = FacetShape::ggx) {
  return std::make_shared<RoughConductor>(Spectrum::constant(n), Spectrum::constant(k),
                                          Spectrum::constant(1.0),
                                          RoughConductor::Facets{shape, width, width, 0.0});
}

// In the plane of incidence a facet's matrix is Fresnel's of half the angle between light and view.
TEST(PolarizingModels, GlassIsPolarizedAsFresnelHasIt) {
  const auto glass = metal(1.5, 0.0, 0.1);
  const OneWavelength at(*glass);
  const auto degree = [&](double angle_deg) {
    const MuellerMatrix m = matrix(
        *glass, at,
        {direction(angle_deg * kDegree, 0.0), direction(angle_deg * kDegree, std::numbers::pi), kUp, {}});
    EXPECT_LT(m(1, 0), 0.0);  // s is reflected
    return radiometry::degree_of_linear_polarization(m * StokesVector{1.0, 0.0, 0.0, 0.0});
  };
  // Light between facets is unpolarized: 1e-3 of all at this width.
  EXPECT_NEAR(degree(45.0), 0.83148, 2e-3);
  EXPECT_GT(degree(56.310), 0.995);
}

/// The nodes of one wavelength.
radiometry::SpectralNodes one_node() {
  const std::vector<radiometry::Channel> channels = {radiometry::Channel::monochromatic("only", 10.0)};
  return radiometry::SpectralNodes::build(channels, Spectrum(), {});
}

/// The Stokes vector towards a cosine in a room of radiance 1: what is emitted and what is reflected of the
/// room, by a finer integral than the model's own.
StokesVector in_a_room(const std::shared_ptr<const Bsdf>& bsdf, const NodeBsdf& own, double cosine) {
  float column[4];
  const OneWavelength at(*bsdf, 10.0);
  BsdfEvent event{{std::sqrt(1.0 - cosine * cosine), 0.0, cosine}, {}, kUp, {1.0, 0.0, 0.0}};
  StokesVector sum;
  constexpr int kAcross = 320;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const BsdfSample sample = bsdf->sample(event, (i + 0.5) / kAcross, (j + 0.5) / kAcross);
      if (!(sample.weight > 0.0)) continue;
      event.incoming = sample.incoming;
      bsdf->evaluate_mueller(event, at.pointers, 1, {column, 1, false});
      sum += (sample.weight / (kAcross * kAcross)) * StokesVector{static_cast<double>(column[0]),
                                                                  static_cast<double>(column[1]),
                                                                  static_cast<double>(column[2]), 0.0};
    }
  radiometry::SpectrumBlock work(3, 1);
  own.emissivity(cosine, work.row(0), work.row(2));
  sum.i += static_cast<double>(work.row(0)[0]);
  if (own.polarized_emission(cosine, work.row(1))) sum.q += static_cast<double>(work.row(1)[0]);
  return sum;
}

TEST(PolarizingModels, EmissionOffsetsWhatARoomOfOneTemperatureSends) {
  const radiometry::SpectralNodes nodes = one_node();
  for (const auto& bsdf :
       {metal(1.5, 0.1, 0.2), std::shared_ptr<const Bsdf>(std::make_shared<RoughDielectric>(
                                  Spectrum::constant(1.5), Spectrum::constant(0.4), FacetShape::ggx, 0.2))}) {
    const NodeBsdf own(bsdf, nodes, true);
    for (const double cosine : {0.25, 0.5, 0.75}) {
      const StokesVector all = in_a_room(bsdf, own, cosine);
      EXPECT_NEAR(all.i, 1.0, 3e-4);
      EXPECT_NEAR(all.q, 0.0, 1e-4) << cosine;
      EXPECT_NEAR(all.u, 0.0, 1e-4) << cosine;
    }
  }
}

TEST(PolarizingModels, EmissionIsAcrossWhatReflects) {
  const auto glass = metal(1.5, 0.05, 0.1, FacetShape::beckmann);
  float whole = 0.0f, reflected = 0.0f;
  polarized_hemispherical(*glass, Side::reflected, OneWavelength(*glass).pointers, 1, 0.5, &whole,
                          &reflected);
  // Smooth glass at 60 degrees: (R_s - R_p) / 2; facets of 0.1 are near it.
  const double smooth = -radiometry::fresnel_reflection({1.5, 0.05}, 0.5)(1, 0);
  EXPECT_NEAR(-static_cast<double>(reflected), smooth, 0.03 * smooth);
  EXPECT_GT(smooth, 0.08);
}

}  // namespace
}  // namespace ifov::materials::test_polarizing_models
