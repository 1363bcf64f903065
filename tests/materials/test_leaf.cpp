#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/leaf/leaf.h"
#include "materials/bsdf/leaf/prospect.h"
#include "materials/bsdf/leaf/waxed_leaf.h"
#include "materials/lobe_checks.h"
#include "radiometry/fresnel.h"
#include "support/truth_data.h"

namespace ifov::materials::test_leaf {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;

double both_sides_at(const Bsdf& bsdf, double cosine, double um) {
  const Spectrum back = directional_hemispherical(bsdf, Side::reflected, cosine),
                 through = directional_hemispherical(bsdf, Side::transmitted, cosine);
  return back.at(um) + through.at(um);
}

/// Largest difference from the leaf of the project's own page of PROSPECT-5, which is written to 1e-4.
double worst_of(ProspectVersion version, double layers) {
  const std::filesystem::path path = std::filesystem::path(IFOV_SOURCE_DIR) /
                                     "../shared/truth/atmosphere/leaf_prospect/prospect5_spectrum.txt";
  std::ifstream file(path);
  if (!file) return -1.0;
  LeafContents leaf;
  leaf.layers = layers;
  leaf.chlorophyll = 40.0;
  leaf.carotenoids = 10.0;
  leaf.brown = 0.1;
  leaf.water = 0.015;
  leaf.dry_matter = 0.009;
  const LeafOptics found = prospect(version, leaf);
  double worst = 0.0;
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    double nm = 0.0, r = 0.0, t = 0.0;
    if (!(words >> nm >> r >> t)) continue;
    ++rows;
    worst = std::max({worst, std::abs(found.reflectance.at(nm * 1e-3) - r),
                      std::abs(found.transmittance.at(nm * 1e-3) - t)});
  }
  EXPECT_EQ(rows, 2101);
  return worst;
}

TEST(Leaf, IsTheLeafOfProspect5) {
  const double worst = worst_of(ProspectVersion::five, 2.1);
  if (worst < 0.0) GTEST_SKIP() << "no reference data";
  EXPECT_LT(worst, 1e-4);
  EXPECT_GT(worst_of(ProspectVersion::five, 2.11), 2e-4);
  EXPECT_GT(worst_of(ProspectVersion::d, 2.1), 1e-2);
}

TEST(Leaf, ConesPassASurfaceAsFresnelsEquationsAddUp) {
  for (const double index : {1.2, 1.5, 2.0})
    for (const double angle : {0.2, 40.0 * pi / 180.0, 1.2, 0.5 * pi}) {
      constexpr int kSteps = 4000;
      double sum = 0.0;
      for (int k = 0; k < kSteps; ++k) {
        const double theta = angle * (k + 0.5) / kSteps;
        const auto r = radiometry::fresnel_reflection_amplitudes(index, std::cos(theta));
        sum += (1.0 - 0.5 * (std::norm(r.p) + std::norm(r.s))) * std::sin(2.0 * theta) * angle / kSteps;
      }
      EXPECT_NEAR(cone_transmittance(index, angle), sum / std::pow(std::sin(angle), 2), 2e-6)
          << index << ' ' << angle;
    }
}

TEST(Leaf, PlatesThatAbsorbNothingKeepNothing) {
  for (const double layers : {1.0, 1.5, 3.0}) {
    const PlateOptics clear = plates(1.45, 0.0, layers, 0.7);
    EXPECT_NEAR(clear.reflectance + clear.transmittance, 1.0, 1e-9);
    const PlateOptics grey = plates(1.45, 1e-6, layers, 0.7);
    EXPECT_NEAR(grey.reflectance, clear.reflectance, 1e-4);  // the limit is smooth
    const PlateOptics black = plates(1.45, 800.0, layers, 0.7);
    EXPECT_NEAR(black.reflectance, black.surface, 1e-9);
    EXPECT_EQ(black.transmittance, 0.0);
  }
  // Two plates on each other, by all reflections between them.
  const PlateOptics one = plates(1.45, 0.3, 1.0, 0.5 * pi), two = plates(1.45, 0.3, 2.0, 0.5 * pi);
  const double between = 1.0 - one.reflectance * one.reflectance;
  EXPECT_NEAR(two.transmittance, one.transmittance * one.transmittance / between, 1e-12);
  EXPECT_NEAR(two.reflectance,
              one.reflectance + one.transmittance * one.transmittance * one.reflectance / between, 1e-12);
}

BsdfInputs inputs_of(const std::string& version) {
  BsdfInputs inputs{Spectrum::constant(1.0), {}};
  for (const BsdfParameter& p : Leaf::kModel.parameters)
    if (p.key == "version")
      inputs.values.emplace_back(p.key, version);
    else if (p.key == "wax_index")
      inputs.values.emplace_back(p.key, Spectrum::constant(1.45));
    else if (!p.optional)
      inputs.values.emplace_back(p.key, std::stod(std::string(p.default_json)));
  return inputs;
}

std::shared_ptr<const Bsdf> leaf_of(BsdfInputs inputs,
                                    std::vector<std::pair<std::string, BsdfInputs::Value>> more) {
  for (auto& value : more) inputs.values.push_back(value);
  return Leaf::kModel.make(inputs);
}

TEST(Leaf, ReflectsAndTransmitsEvenly) {
  const auto leaf = leaf_of(inputs_of("D"), {{"dry_matter", 0.009}});
  const LeafOptics optics = prospect(ProspectVersion::d, {});
  EXPECT_NEAR(directional_hemispherical(*leaf, Side::reflected, 0.6).at(0.8), optics.reflectance.at(0.8),
              3e-4);
  EXPECT_NEAR(directional_hemispherical(*leaf, Side::transmitted, 0.6).at(0.8), optics.transmittance.at(0.8),
              3e-4);
  // A healthy leaf: dark in blue and red, bright beyond 0.75 um.
  EXPECT_LT(optics.reflectance.at(0.67), 0.06);
  EXPECT_GT(optics.reflectance.at(0.8), 0.4);
  EXPECT_GT(optics.reflectance.at(0.55), 1.5 * optics.reflectance.at(0.67));
  // Proteins and the rest in place of dry matter: nearly the same leaf (Feret et al. 2021).
  const auto pro = leaf_of(inputs_of("PRO"), {{"proteins", 0.0009}, {"carbon", 0.0081}});
  EXPECT_NEAR(directional_hemispherical(*pro, Side::reflected, 0.6).at(1.7), optics.reflectance.at(1.7),
              0.02);
}

TEST(Leaf, WithoutAbsorptionAllGoesOn) {
  for (const double width : {0.1, 0.3, 0.8})
    for (const double back : {0.0, 0.4, 1.0}) {
      const WaxedLeaf leaf(Spectrum::constant(1.45), width, Spectrum::constant(back),
                           Spectrum::constant(1.0 - back));
      for (const double cosine : {1.0, 0.6, 0.2, 0.05})
        EXPECT_NEAR(both_sides_at(leaf, cosine, 1.0), 1.0, 2e-3) << width << ' ' << back << ' ' << cosine;
    }
  const WaxedLeaf grey(Spectrum::constant(1.45), 0.3, Spectrum::constant(0.4), Spectrum::constant(0.5));
  EXPECT_LT(both_sides_at(grey, 0.6, 1.0), 0.95);
}

TEST(Leaf, WaxShinesOnTheReflectanceOfTheLeaf) {
  const auto dull = leaf_of(inputs_of("D"), {{"dry_matter", 0.009}}),
             waxed = leaf_of(inputs_of("D"), {{"dry_matter", 0.009}, {"wax_roughness", 0.3}});
  for (const double um : {0.45, 0.67, 0.8, 1.45})
    EXPECT_NEAR(directional_hemispherical(*waxed, Side::reflected, 1.0).at(um),
                directional_hemispherical(*dull, Side::reflected, 1.0).at(um), 0.012);
  BsdfEvent event = test::view_of(at(0.7, 0.0));
  event.incoming = at(0.7, pi);
  EXPECT_GT(test::brdf_at(*waxed, event, 0.67), 3.0 * test::brdf_at(*dull, event, 0.67));
}

TEST(Leaf, SamplesFollowTheDensityAndReciprocity) {
  const WaxedLeaf leaf(Spectrum::constant(1.45), 0.3, Spectrum::constant(0.4), Spectrum::constant(0.5));
  for (const Vec3 out : {at(0.0, 0.0), at(0.8, 0.5), at(1.45, 2.0)}) {
    EXPECT_GT(test::samples_against_density(leaf, out, 0.3, 0.3, 40000), 1e-3 / 3.0);
    for (int k = 0; k < 100; ++k) {
      BsdfEvent event = test::view_of(out);
      const BsdfSample sample = leaf.sample(event, (k % 10 + 0.5) / 10, (k / 10 + 0.5) / 10);
      if (!(sample.weight > 0.0)) continue;
      event.incoming = sample.incoming;
      const UnitSquarePoint u = leaf.invert(event);
      EXPECT_LT(math::length(leaf.sample(event, u.u1, u.u2).incoming - sample.incoming), 1e-10);
      const double there = test::brdf_at(leaf, event);
      std::swap(event.outgoing, event.incoming);
      EXPECT_NEAR(test::brdf_at(leaf, event), there, 4e-7 * there);
    }
  }
}

TEST(Leaf, BeyondProspectItIsGivenOrAnError) {
  const auto bare = leaf_of(inputs_of("D"), {{"dry_matter", 0.009}});
  EXPECT_THROW(bare->spectra()[0].at(3.0), InputError);
  const auto leaf = leaf_of(inputs_of("D"), {{"dry_matter", 0.009},
                                             {"reflectance_beyond", Spectrum::constant(0.04)},
                                             {"transmittance_beyond", Spectrum({2.6, 14.0}, {0.02, 0.0})}});
  EXPECT_NEAR(leaf->spectra()[0].at(10.0), 0.04, 1e-12);
  EXPECT_NEAR(leaf->spectra()[0].at(0.38), 0.04, 1e-12);
  EXPECT_NEAR(leaf->spectra()[0].at(2.4), bare->spectra()[0].at(2.4), 1e-12);
  EXPECT_NEAR(leaf->spectra()[1].at(14.0), 0.0, 1e-12);
  EXPECT_THROW(leaf->spectra()[1].at(15.0), InputError);
}

TEST(Leaf, SaysWhatItsVersionLacks) {
  const auto said = [](const std::string& version,
                       std::vector<std::pair<std::string, BsdfInputs::Value>> more) {
    try {
      leaf_of(inputs_of(version), std::move(more));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said("D", {}), "");
  EXPECT_EQ(
      said("PRO", {{"proteins", 0.001}}),
      "'carbon' is missing: version PRO of PROSPECT needs 'proteins' and 'carbon', such as 0.001 and 0.008");
  EXPECT_EQ(said("PRO", {{"dry_matter", 0.01}, {"proteins", 0.001}, {"carbon", 0.009}}),
            "version PRO of PROSPECT has no 'dry_matter', but 'proteins' and 'carbon'");
  EXPECT_EQ(said("5", {{"dry_matter", 0.01}, {"carbon", 0.009}}),
            "version 5 of PROSPECT has no 'carbon', but 'dry_matter'");
  EXPECT_EQ(
      said("D", {{"dry_matter", 0.01}, {"reflectance_beyond", Spectrum::constant(0.1)}}),
      "'transmittance_beyond' is missing: beyond what PROSPECT knows, 0.4 to 2.5 um, a leaf needs both its reflectance "
      "and its transmittance");
}

}  // namespace
}  // namespace ifov::materials::test_leaf
