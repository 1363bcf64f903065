#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "materials/bsdf/mirror.h"
#include "radiometry/planck.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_path_tracer {
namespace {

using test::SmallScene;

const geometry::Box kRoom{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
const math::Ray kInsideRoom{{0.1, -0.2, 0.3}, math::normalized({0.3, 0.5, -0.7})};

class Furnace : public testing::TestWithParam<double> {};

TEST_P(Furnace, ClosedEnclosureReturnsPlanck) {
  SmallScene scene;
  scene.place(kRoom, scene.material(GetParam(), 300.0));
  scene.build();
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  const auto estimate = scene.radiance(kInsideRoom, 1 << 19);
  EXPECT_LT(estimate.standard_error, 1e-3 * expected);
  EXPECT_NEAR(estimate.mean, expected, 3.0 * estimate.standard_error + 1e-6 * expected);
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Furnace, testing::Values(0.0, 0.2, 0.5, 0.8));

TEST(PathTracer, FurnaceWithMirrorsAndLambertiansReturnsPlanck) {
  SmallScene scene;
  scene.place(kRoom, scene.material(0.5, 300.0));
  scene.place(geometry::Sphere{{0.3, 0.4, -0.6}, 0.3},
              scene.material(0.7, 300.0, materials::Mirror::shared()));
  scene.build();
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  const auto estimate = scene.radiance(kInsideRoom, 1 << 16);
  EXPECT_NEAR(estimate.mean, expected, 3.0 * estimate.standard_error + 1e-6 * expected);
  EXPECT_LT(estimate.standard_error, 1e-3 * expected);
}

TEST(PathTracer, PlantedFaultTruncatedPathsFailTheFurnace) {
  SmallScene scene;
  scene.place(kRoom, scene.material(0.5, 300.0));
  scene.build();
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  transport::TransportOptions truncated;
  truncated.maximum_scatterings = 4;
  const auto estimate = scene.radiance(kInsideRoom, 1 << 14, 1, truncated);
  EXPECT_GT(std::abs(estimate.mean - expected), 3.0 * estimate.standard_error + 1e-3 * expected);
}

TEST(PathTracer, SunlitPlaneIsExactAndWithoutVariance) {
  for (const double zenith : {0.0, 0.5, 1.2}) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(0.3));
    scene.sun({std::sin(zenith), 0.0, std::cos(zenith)}, 1000.0, 0.00465);
    scene.build();
    const auto estimate = scene.radiance({{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}}, 256);
    EXPECT_NEAR(estimate.mean, 0.3 * 1000.0 * std::cos(zenith) / std::numbers::pi, 1e-4 * estimate.mean);
    EXPECT_LT(estimate.standard_error, 1e-6 * estimate.mean);
  }
}

TEST(PathTracer, UniformSkyOverPlaneIsExact) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.4));
  scene.sky(80.0);
  scene.build();
  const auto estimate = scene.radiance({{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}}, 256);
  EXPECT_NEAR(estimate.mean, 0.4 * 80.0, 1e-4);
}

TEST(PathTracer, HotDiskOverheadGivesItsViewFactor) {
  // Differential element to a parallel coaxial disk: F = r^2 / (r^2 + h^2) (Howell, configuration B-13).
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.5));
  scene.place(geometry::Disk{{0.0, 0.0, 2.0}, 1.0}, scene.material(0.0, 400.0));
  scene.build();
  const math::Vec3 down = math::normalized({-1.5, 0.0, -1.0});
  const auto estimate = scene.radiance({math::Point3{} - 1.5 * down, down}, 1 << 18);
  const double expected =
      0.5 * (1.0 / 5.0) * radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 400.0);
  EXPECT_NEAR(estimate.mean, expected, 2e-3 * expected);
}

TEST(PathTracer, MirrorShowsWhatItFaces) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.9, 0.0, materials::Mirror::shared()));
  scene.place(geometry::Box{{-5.0, -5.0, 10.0}, {5.0, 5.0, 11.0}}, scene.material(0.0, 350.0));
  scene.build();
  const auto estimate = scene.radiance({{-0.5, 0.0, 1.0}, math::normalized({0.5, 0.0, -1.0})}, 16);
  EXPECT_NEAR(estimate.mean, 0.9 * radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 350.0), 1e-4);
}

/// Share of a disc of radius 1 on the side x < t.
double segment_share(double t) {
  if (t >= 1.0) return 1.0;
  if (t <= -1.0) return 0.0;
  return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
}

double worst_penumbra_error(double half_angle_rad, double assumed_half_angle_rad) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.5));
  scene.place(geometry::Box{{0.0, -50.0, 10.0}, {50.0, 50.0, 10.01}}, scene.material(0.0));
  scene.sun({0.0, 0.0, 1.0}, 1000.0, half_angle_rad);
  scene.build();
  const double lit = 0.5 * 1000.0 / std::numbers::pi;
  double worst = 0.0;
  for (int k = -12; k <= 12; ++k) {
    const double x_m = 0.005 * k;
    const double edge_m = 0.0 - x_m;  // towards the plate
    const double c = edge_m / 10.0;
    const double expected = segment_share(c / std::sqrt(1.0 + c * c) / std::sin(assumed_half_angle_rad));
    const auto estimate = scene.radiance({{x_m, 0.0, 5.0}, {0.0, 0.0, -1.0}}, 1 << 14,
                                         static_cast<std::uint64_t>(k + 100), {1});
    worst = std::max(worst, std::abs(estimate.mean / lit - expected));
  }
  return worst;
}

TEST(PathTracer, PlateEdgeCastsTheDiscSegmentPenumbra) {
  EXPECT_LT(worst_penumbra_error(0.00465, 0.00465), 1e-3);
}

TEST(PathTracer, PlantedFaultWrongDiscFailsThePenumbra) {
  EXPECT_GT(worst_penumbra_error(0.00465 * 1.01, 0.00465), 1e-3);
}

TEST(PathTracer, ViewPathDimsAndAdds) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.4));
  scene.sky(80.0);
  scene.scene().view_path.transmittance = radiometry::Spectrum::constant(0.8);
  scene.scene().view_path.radiance = radiometry::Spectrum::constant(5.0);
  scene.build();
  const auto estimate = scene.radiance({{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}}, 64);
  EXPECT_NEAR(estimate.mean, 0.8 * 0.4 * 80.0 + 5.0, 1e-4);
}

TEST(PathTracer, RaysBelowTheHorizonMeetTheSurroundings) {
  SmallScene scene;
  scene.place(geometry::Box{{-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}}, scene.material(0.5));
  scene.sky(80.0);
  scene.build();
  scene.scene();
  // A wall sees half sky, half surroundings (black here).
  const auto estimate = scene.radiance({{5.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}}, 1 << 14);
  EXPECT_NEAR(estimate.mean, 0.5 * 0.5 * 80.0, 0.02);
}

}  // namespace
}  // namespace ifov::test_path_tracer
