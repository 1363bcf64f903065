// Rays that surfaces send to highlights of narrow lobes on other surfaces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "materials/bsdf/rough_conductor.h"
#include "radiometry/polarization_frame.h"
#include "transport/mirrors/lobe_targets.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/polarized/polarized_path_light.h"
#include "transport/small_scene.h"

namespace ifov::test_lobe_targets {
namespace {

using math::Point3;
using math::Vec3;
using std::numbers::pi;
using test::SmallScene;

std::shared_ptr<const materials::Bsdf> metal(double slope) {
  const auto one = [](double value) { return radiometry::Spectrum::constant(value); };
  return std::make_shared<materials::RoughConductor>(
      one(1.5), one(4.0), one(1.0),
      materials::RoughConductor::Facets{materials::FacetShape::ggx, slope, slope});
}

/// Dull ground below walls, a ball and a half ball of metal.
void build(SmallScene& scene, double slope) {
  const std::uint32_t dull = scene.material(0.5), shiny = scene.material(1.0, 0.0, metal(slope));
  scene.place(geometry::Plane{}, dull);
  scene.place(geometry::Box{{1.0, -1.0, 0.0}, {1.4, 1.0, 1.2}}, shiny);
  scene.place(geometry::Sphere{{-0.9, 0.4, 0.5}, 0.25}, shiny);
  scene.place(geometry::Hemisphere{{0.2, 1.8, 0.0}, 0.6}, shiny);
  scene.sun({-0.8, 0.1, 1.0}, 300.0, 0.00465);
  scene.sky(5.0);
}

const std::array<Point3, 4> kPlaces = {
    Point3{0.4, 0.2, 0.0}, {-0.7, 0.4, 0.0}, {0.9, 0.0, 0.0}, {-0.85, 0.4, 0.2}};
constexpr Vec3 kUp{0.0, 0.0, 1.0};

TEST(LobeTargets, DensitiesAreThoseOfTheirSamples) {
  SmallScene scene;
  build(scene, 0.15);
  const transport::SpectralScene& built = scene.build();
  transport::LobeView view;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  constexpr int kSamples = 100000, kRows = 600, kColumns = 1200;
  const auto octant = [](Vec3 d) {
    return (d.x > 0.0 ? 1u : 0u) + (d.y > 0.0 ? 2u : 0u) + (d.z > 0.3 ? 4u : 0u);
  };
  for (const Point3& place : kPlaces) {
    view.fill(built.sun_lobes()->targets(), place, kUp);
    std::array<double, 8> counted{}, integral{};
    for (int k = 0; k < kSamples; ++k) {
      const Vec3 sample = view.sample(uniform(random), {uniform(random), uniform(random)});
      ASSERT_NEAR(math::length(sample), 1.0, 1e-9);
      ASSERT_GT(view.density(sample), 0.0);
      counted[octant(sample)] += 1.0 / kSamples;
    }
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const double z = 2.0 * (row + 0.5) / kRows - 1.0, turn = 2.0 * pi * (column + 0.5) / kColumns,
                     r = std::sqrt(1.0 - z * z);
        const Vec3 even{r * std::cos(turn), r * std::sin(turn), z};
        integral[octant(even)] += 4.0 * pi * view.density(even) / (kRows * kColumns);
      }
    EXPECT_NEAR(std::accumulate(integral.begin(), integral.end(), 0.0), 1.0, 0.004);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(integral[k], counted[k], 0.008) << k;
  }
}

SmallScene::Estimate ground(bool sought, const Point3& place, double slope = 0.15) {
  SmallScene scene;
  build(scene, slope);
  scene.build();
  transport::TransportOptions options;
  options.seek_lobes = sought;
  return scene.radiance({place + Vec3{0.0, 0.0, 4.0}, -kUp}, 1 << 14, 5, options);
}

TEST(LobeTargets, WhatIsSoughtIsWhatIsFoundByChanceAndMoreEven) {
  double narrower = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto sought = ground(true, kPlaces[k]), found = ground(false, kPlaces[k]);
    EXPECT_NEAR(sought.mean, found.mean, 4.0 * std::hypot(sought.standard_error, found.standard_error)) << k;
    EXPECT_LT(sought.standard_error, 0.012 * sought.mean);
    narrower *= sought.standard_error / found.standard_error;
    // The planted fault: other lobes.
    if (k == 0) {
      const auto other = ground(true, kPlaces[k], 0.22);
      EXPECT_GT(std::abs(other.mean - found.mean),
                4.0 * std::hypot(other.standard_error, found.standard_error));
    }
  }
  EXPECT_LT(std::cbrt(narrower), 0.7);
}

/// I, Q and U of a place, and their standard errors.
std::array<std::array<double, 3>, 2> polarized(bool sought) {
  constexpr std::uint32_t kCount = 1 << 14;
  SmallScene scene;
  build(scene, 0.25);
  // The ground as well: it polarizes what the ball throws on it.
  scene.scene().materials[0].bsdf = metal(0.29);
  const transport::SpectralScene& built = scene.build_polarized();
  transport::TransportOptions options;
  options.seek_lobes = sought;
  transport::PathTracer tracer(built, options);
  const math::Ray ray{{-0.7, -2.6, 3.0}, math::normalized({0.0, 3.0, -3.0})};
  const std::vector<math::Ray> rays(kCount, ray);
  std::vector<transport::PathKey> keys(kCount);
  for (std::uint32_t k = 0; k < kCount; ++k) keys[k] = {7, k};
  std::vector<geometry::SurfacePoint> hits(kCount);
  sampling::RayCounts counts;
  const transport::PathRecord& paths = tracer.trace(rays, keys, hits, counts);
  transport::PolarizedPathLight light(built);
  std::array<std::array<double, 3>, 2> result{};
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const transport::StokesRows rows = light.light(paths, k, radiometry::meridional_frame(-ray.direction));
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(rows[c][0]);
      result[0][c] += value / kCount;
      result[1][c] += value * value / kCount;
    }
  }
  for (std::size_t c = 0; c < 3; ++c)
    result[1][c] = std::sqrt((result[1][c] - result[0][c] * result[0][c]) / kCount);
  return result;
}

TEST(LobeTargets, WithPolarizationAsWell) {
  const auto sought = polarized(true), found = polarized(false);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(sought[0][c], found[0][c], 4.0 * std::hypot(sought[1][c], found[1][c])) << c;
  EXPECT_GT(std::abs(sought[0][1]), 5.0 * sought[1][1]);
}

TEST(LobeTargets, FacetsAreClusteredByPlaceAndNormal) {
  geometry::SurfaceSurvey survey;
  for (int k = 0; k < 40; ++k) {
    const double x = k < 20 ? 0.0 : 50.0;
    const Vec3 normal = k % 2 == 0 ? Vec3{0.0, 0.0, 1.0} : math::normalized(Vec3{1.0, 0.0, 0.2});
    survey.faces.push_back({normal, {{x + 0.1 * k, 0.0, 0.0}, 0.1}, 1.0});
  }
  const auto clusters = transport::facet_clusters(survey, 4);
  ASSERT_EQ(clusters.size(), 4u);
  for (const transport::FacetCluster& cluster : clusters) {
    EXPECT_LT(cluster.spread, 1e-9);
    EXPECT_LT(cluster.ball.radius_m, 1.2);
  }
  for (const auto& face : survey.faces) {
    bool held = false;
    for (const transport::FacetCluster& cluster : clusters)
      held = held || (math::length(face.normal - cluster.normal) < 1e-9 &&
                      math::length(face.ball.centre_m - cluster.ball.centre_m) + face.ball.radius_m <
                          cluster.ball.radius_m + 1e-9);
    EXPECT_TRUE(held);
  }
  EXPECT_TRUE(transport::facet_clusters({}, 4).empty());

  // A plane without end and a wide floor hide nothing.
  survey.faces.push_back({{0.0, 0.0, 1.0}, {{0.0, 0.0, 0.0}, 1e12}, 1e24});
  for (int k = 0; k < 1000; ++k)
    survey.faces.push_back({{0.0, 0.0, 1.0}, {{10.0 * (k % 32), 10.0 * (k / 32), -1.0}, 7.0}, 100.0});
  int walls = 0;  // clusters of these alone, whose highlight is found by their normal
  for (const transport::FacetCluster& cluster : transport::facet_clusters(survey, 16))
    walls += cluster.spread < 0.1 && cluster.normal.x > 0.9 && cluster.ball.radius_m < 30.0;
  EXPECT_GE(walls, 1);
}

}  // namespace
}  // namespace ifov::test_lobe_targets
