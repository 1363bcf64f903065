// A material as the air's ground and as surroundings, against facets and papers written out once more.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/ground_monte_carlo.h"
#include "atmosphere/test_ground.h"
#include "materials/bsdf/rpv.h"
#include "materials/bsdf/sea/sea.h"
#include "materials/material.h"
#include "transport/sky/material_ground.h"
#include "transport/sky/surroundings_light.h"

namespace ifov::transport::test_material_ground {
namespace {

using namespace atmosphere::test;
using radiometry::Spectrum;

constexpr double kPi = std::numbers::pi, kBlue_um = 0.55;
constexpr double kRho0 = 0.2, kBowl = 0.7, kAsymmetry = -0.15;

radiometry::SpectralNodes one_node() {
  static const std::vector<radiometry::Channel> channels{
      radiometry::Channel::monochromatic("blue", kBlue_um)};
  return radiometry::SpectralNodes::build(channels, Spectrum(), {});
}

materials::Material land() {
  materials::Material material;
  material.bsdf = std::make_shared<const materials::Rpv>(Spectrum::constant(kRho0), kBowl, kAsymmetry);
  return material;
}
double land_of_paper(double in, double out, double azimuth) {
  return rpv_of_paper(in, out, azimuth, kRho0, kBowl, kAsymmetry);
}
/// Share that it reflects of light of one direction.
double share_of_paper(double in) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int a = 0; a < kSteps; ++a) {
      const double out = (i + 0.5) / kSteps;
      sum += land_of_paper(in, out, 2.0 * kPi * (a + 0.5) / kSteps) * out;
    }
  return sum * 2.0 * kPi / (kSteps * kSteps);
}

atmosphere::GroundMatrix in_solver(const atmosphere::DirectionalGround& ground,
                                   const atmosphere::GroundEvent& event) {
  atmosphere::GroundMatrix brdf[1];
  ground.reflect(kBlue_um, {&event, 1}, brdf);
  return brdf[0];
}
atmosphere::GroundMatrix in_nodes(const atmosphere::GroundAtNodes& ground,
                                  const atmosphere::GroundEvent& event) {
  atmosphere::GroundMatrix brdf{};
  for (std::size_t column = 0; column < 3; ++column) {
    double incoming[3] = {}, light[3] = {};
    incoming[column] = 1.0;
    ground.add_reflected(event, incoming, light);
    for (std::size_t row = 0; row < 3; ++row) brdf[row][column] = light[row];
  }
  return brdf;
}

}  // namespace

TEST(MaterialGround, LandIsThatOfThePaper) {
  const auto ground = material_ground(land(), 0.3);
  const radiometry::SpectralNodes nodes = one_node();
  const auto at_node = ground->at(nodes, false);
  for (const auto& [in, out, azimuth] : {std::array{0.8, 0.4, 0.0}, {0.3, 0.9, 1.2}, {0.6, 0.6, -2.6}}) {
    const double wanted = land_of_paper(in, out, azimuth);
    const atmosphere::GroundEvent event{out, -in, azimuth + 0.9, 0.9};
    EXPECT_NEAR(in_solver(*ground, event)[0][0] / wanted, 1.0, 1e-4);
    const double incoming[1] = {1.0};
    double light[1] = {};
    at_node->add_reflected(event, incoming, light);
    EXPECT_NEAR(light[0] / wanted, 1.0, 1e-4);
  }
  for (const double in : {0.25, 0.6, 1.0}) {
    double share[1];
    at_node->albedo(in, share);
    EXPECT_NEAR(share[0] / share_of_paper(in), 1.0, 2e-3) << in;
  }
}

// Facets that reflect fields: Q and U have neither light of other facets nor of whitecaps.
TEST(MaterialGround, SeaPolarizesAsItsFacets) {
  constexpr double kWind = 6.0, kVariance = 0.003 + 0.00512 * kWind;
  materials::Material sea;
  const materials::Sea::Surface surface{kWind, materials::SlopeStatistics::isotropic, 0.0, 34.3, 0.0};
  sea.bsdf =
      std::make_shared<const materials::Sea>(surface, Spectrum::constant(0.0), Spectrum::constant(0.0));
  const auto ground = material_ground(sea, 1.0);
  const radiometry::SpectralNodes nodes = one_node();
  const auto at_node = ground->at(nodes, true);
  const GroundOfFields facets =
      facets_of_fields(materials::sea_water_index(34.3).at(kBlue_um), 0.5 * kVariance);
  for (const auto& [in_mu, out_mu, azimuth] :
       {std::array{0.8, 0.75, 0.3}, {0.7, 0.85, -0.8}, {0.65, 0.6, 0.2}, {0.95, 0.75, 2.0}}) {
    const atmosphere::GroundEvent event{out_mu, -in_mu, azimuth + 0.4, 0.4};
    const Vector in = towards(-in_mu, 0.4), out = towards(out_mu, azimuth + 0.4);
    const atmosphere::GroundMatrix solver = in_solver(*ground, event), node = in_nodes(*at_node, event);
    for (std::size_t column = 0; column < 3; ++column) {
      std::array<double, 3> unit{};
      unit[column] = 1.0;
      const auto made = stokes_of(facets(dyad_of(unit, in), in, out), out);
      for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_NEAR(solver[row][column], node[row][column], 1e-5 * solver[0][0]);
        if (row + column == 0) continue;
        const double scale = std::abs(made[row]);
        EXPECT_NEAR(solver[row][column], made[row], 3e-3 * scale + 1e-4 * solver[0][0]) << row << column;
      }
    }
  }
}

// Under a uniform sky all is a closed form.
TEST(MaterialGround, SurroundingsSendWhatTheyReflectAndEmit) {
  const radiometry::SpectralNodes nodes = one_node();
  const math::Vec3 towards_sun = math::normalized(math::Vec3{0.5, -0.4, 0.7});
  const double sine = towards_sun.z, sun = 1500.0, sky = 40.0, black = 9.0;
  const materials::Material material = land();
  const auto light = SurroundingsLight::of(
      material, {nodes, towards_sun, false, nullptr, {1500.0f}, {40.0f}, {9.0f}, {0.0}});
  ASSERT_NE(light, nullptr);
  for (const math::Vec3 way : {math::Vec3{0.2, 0.6, -0.5}, {-0.7, 0.1, -0.4}, {0.0, 0.1, -1.0}}) {
    const math::Vec3 direction = math::normalized(way), leaves = -direction;
    const double azimuth = std::atan2(leaves.y, leaves.x) - std::atan2(-towards_sun.y, -towards_sun.x);
    const double share = share_of_paper(leaves.z);
    const auto part = [&](SurroundingsLight::Part which) {
      radiometry::SpectrumBlock row(1, 1);
      light->add(which, direction, nullptr, {row.row(0)});
      return static_cast<double>(row.row(0)[0]);
    };
    EXPECT_NEAR(part(SurroundingsLight::Part::sun) / (sun * sine * land_of_paper(sine, leaves.z, azimuth)),
                1.0, 1e-4);
    EXPECT_NEAR(part(SurroundingsLight::Part::sky) / (sky * share), 1.0, 2e-3);
    EXPECT_NEAR(part(SurroundingsLight::Part::emitted) / (black * (1.0 - share)), 1.0, 2e-3);
  }
}

}  // namespace ifov::transport::test_material_ground
