#include <gtest/gtest.h>

#include "materials/bsdf/lambertian.h"
#include "materials/bsdf/mirror.h"
#include "materials/bsdf/node_bsdf.h"
#include "materials/material.h"
#include "materials/spectral_materials.h"
#include "radiometry/solar_spectrum.h"
#include "radiometry/spectral_nodes.h"

namespace ifov::materials::test_spectral_materials {
namespace {

using radiometry::Channel;
using radiometry::Spectrum;

TEST(SpectralMaterials, KirchhoffHoldsInEveryNode) {
  const std::vector<Material> materials{
      {"edge", Spectrum({0.3, 0.68, 0.72, 5.0, 14.0}, {0.05, 0.05, 0.5, 0.1, 0.02}), Lambertian::shared(),
       300.0},
      {"black", Spectrum::constant(0.0), Lambertian::shared(), {}},
      {"mirror", Spectrum::constant(0.9), Mirror::shared(), 250.0}};
  const std::vector<Channel> channels{Channel::top_hat("red edge", 0.65, 0.75),
                                      Channel::monochromatic("m", 8.5)};
  const std::vector<Spectrum> surfaces{materials[0].reflectance};
  const auto nodes = radiometry::SpectralNodes::build(channels, radiometry::solar_irradiance_1au(), surfaces);
  const SpectralMaterials rows(materials, nodes);
  ASSERT_GT(nodes.node_count(), 2u);
  for (std::uint32_t m = 0; m < 3; ++m)
    for (std::size_t n = 0; n < nodes.node_count(); ++n)
      EXPECT_NEAR(rows.reflectance(m)[n] + rows.emissivity(m)[n], 1.0f, 1e-6f) << m << ' ' << n;
  const std::size_t thermal = nodes.first_node(1);
  const double at_8500nm = 0.1 + (8.5 - 5.0) / 9.0 * (0.02 - 0.1);
  EXPECT_NEAR(rows.emissivity(0)[thermal], 1.0 - at_8500nm, 1e-6);
  EXPECT_LE(rows.maximum_reflectance(0), 0.5f);
  EXPECT_GT(rows.maximum_reflectance(0), 0.4f);
  EXPECT_EQ(rows.maximum_reflectance(1), 0.0f);
  EXPECT_NEAR(rows.maximum_reflectance(2), 0.9f, 1e-6f);
}

}  // namespace
}  // namespace ifov::materials::test_spectral_materials
