// Paths that carry Stokes vectors: against paths that carry radiance, closed forms, and rooms of one temperature.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "materials/bsdf/mirror.h"
#include "materials/bsdf/rough_conductor.h"
#include "materials/bsdf/rough_dielectric.h"
#include "radiometry/fresnel.h"
#include "radiometry/planck.h"
#include "radiometry/polarization_frame.h"
#include "transport/polarized/polarized_air.h"
#include "transport/polarized/polarized_path_light.h"
#include "transport/small_scene.h"

namespace ifov::test_polarized_paths {
namespace {

using math::Vec3;
using radiometry::MuellerMatrix;
using radiometry::PolarizationFrame;
using radiometry::Spectrum;
using radiometry::StokesVector;
using test::SmallScene;

struct Estimate {
  StokesVector mean, error;
  double scalar = 0.0;
};

/// Mean over paths along one ray, about a frame of light that goes back along it.
Estimate stokes(const transport::SpectralScene& scene, const math::Ray& ray, const PolarizationFrame& frame,
                std::uint32_t count) {
  transport::PathTracer tracer(scene, {});
  const std::vector<math::Ray> rays(count, ray);
  std::vector<transport::PathKey> keys(count);
  for (std::uint32_t k = 0; k < count; ++k) keys[k] = {1, k};
  std::vector<geometry::SurfacePoint> hits(count);
  sampling::RayCounts counts;
  const transport::PathRecord& paths = tracer.trace(rays, keys, hits, counts);
  transport::PolarizedPathLight polarized(scene);
  transport::PathLight plain(scene);
  const transport::PolarizedAir air(scene);
  std::array<double, 4> sum{}, squares{};
  Estimate found;
  for (std::uint32_t k = 0; k < count; ++k) {
    found.scalar += static_cast<double>(plain.radiance(paths, k)[0]) / count;
    const transport::StokesRows light = polarized.light(paths, k, frame);
    air.apply(paths.paths[k], frame, light);
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = static_cast<double>(light[c][0]);
      sum[c] += value, squares[c] += value * value;
    }
  }
  std::array<double, 4> mean{}, error{};
  for (std::size_t c = 0; c < 4; ++c) {
    mean[c] = sum[c] / count;
    error[c] = std::sqrt(std::max(0.0, squares[c] / count - mean[c] * mean[c]) / count);
  }
  found.mean = {mean[0], mean[1], mean[2], mean[3]};
  found.error = {error[0], error[1], error[2], error[3]};
  return found;
}

std::shared_ptr<const materials::Bsdf> conductor(double n, double k, double width) {
  return std::make_shared<materials::RoughConductor>(
      Spectrum::constant(n), Spectrum::constant(k), Spectrum::constant(1.0),
      materials::RoughConductor::Facets{materials::FacetShape::ggx, width, width, 0.0});
}

std::shared_ptr<const materials::Bsdf> lacquer(double base) {
  return std::make_shared<materials::RoughDielectric>(Spectrum::constant(1.5), Spectrum::constant(base),
                                                      materials::FacetShape::ggx, 0.2);
}

/// From above, aslant, onto the origin.
math::Ray towards_origin(double zenith_rad, double azimuth_rad) {
  const Vec3 up{std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
                std::cos(zenith_rad)};
  return {.origin_m = math::Point3{} + 5.0 * up, .direction = -up};
}

// Where nothing polarizes, and where mirrors alone do, whose sky is unpolarized, radiance is that of plain paths.
TEST(PolarizedPaths, WithoutPolarizersAreThoseOfRadiance) {
  SmallScene scene;
  const std::uint32_t mirror = scene.material(0.8, 0.0, materials::Mirror::shared());
  scene.place(geometry::Plane{}, scene.material(0.5, 290.0));
  scene.place(geometry::Polygon{{{3.0, -4.0, 0.0}, {3.0, 4.0, 0.0}, {3.0, 4.0, 6.0}, {3.0, -4.0, 6.0}}},
              mirror);
  scene.place(geometry::Sphere{{1.0, 2.0, 0.7}, 0.5}, mirror);
  scene.place(geometry::Disk{{-1.0, 0.5, 1.0}, 0.8}, scene.leaf(0.4, 0.45, 285.0));
  scene.place(geometry::Sphere{{0.8, -0.8, 0.6}, 0.2}, scene.material(0.2, 900.0));
  scene.sun({-0.8, 0.1, 1.0}, 300.0, 0.00465);
  scene.sky(20.0);
  const transport::SpectralScene& built = scene.build_polarized();
  for (const math::Ray& ray : {math::Ray{{0.2, 0.3, 5.0}, math::normalized({0.02, -0.04, -1.0})},
                               math::Ray{{-1.1, 0.4, 5.0}, {0.0, 0.0, -1.0}},
                               math::Ray{{0.0, 2.0, 2.0}, math::normalized({1.0, -0.3, -0.2})}}) {
    const Estimate found = stokes(built, ray, radiometry::meridional_frame(-ray.direction), 2000);
    EXPECT_NEAR(found.mean.i, found.scalar, 1e-5 * found.scalar);
    EXPECT_EQ(found.mean.q, 0.0);
    EXPECT_EQ(found.mean.u, 0.0);
  }
}

/// What a plate of facets makes of a point Sun, about `frame`: Fresnel's matrix of the facet halfway.
StokesVector sunlit(double n, double k, const Vec3& towards_sun, const math::Ray& ray,
                    const PolarizationFrame& frame) {
  const Vec3 seen = -ray.direction;
  const double beta = std::sqrt(0.5 + 0.5 * math::dot(seen, towards_sun));
  const radiometry::ScatteringFrames plane = radiometry::scattering_frames(-towards_sun, seen);
  const MuellerMatrix fresnel = radiometry::fresnel_reflection({n, k}, beta);
  const StokesVector light = fresnel * StokesVector{1.0, 0.0, 0.0, 0.0};
  return turned(plane.after, frame) * ((1.0 / light.i) * light);
}

TEST(PolarizedPaths, SunlightOnMetalIsFresnelsAboutAnyFrame) {
  constexpr double n = 1.5, k = 2.0;
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.9, 0.0, conductor(n, k, 0.3)));
  const Vec3 sun = math::normalized({0.5, 0.3, 0.9});
  scene.sun(sun, 300.0, 0.0);
  const transport::SpectralScene& built = scene.build_polarized();
  const auto worst = [&](double turn) {
    double off = 0.0;
    for (const double azimuth : {0.3, 2.0, 4.5}) {
      const math::Ray ray = towards_origin(0.8, azimuth);
      PolarizationFrame frame = radiometry::meridional_frame(-ray.direction);
      frame.x = std::cos(0.4) * frame.x + std::sin(0.4) * frame.y();
      const StokesVector found = stokes(built, ray, frame, 1).mean;
      // A planted fault: the frame turned by another angle than it was.
      PolarizationFrame expected_about = radiometry::meridional_frame(-ray.direction);
      expected_about.x = std::cos(turn) * expected_about.x + std::sin(turn) * expected_about.y();
      const StokesVector expected = sunlit(n, k, sun, ray, expected_about);
      // Light that facets send to each other dilutes it, most beside the lobe.
      const double degree = std::hypot(found.q, found.u) / found.i;
      EXPECT_LT(degree, 1.0001 * std::hypot(expected.q, expected.u));
      EXPECT_GT(degree, 0.7 * std::hypot(expected.q, expected.u));
      off = std::max(
          off, std::hypot(found.q / found.i / degree - expected.q / std::hypot(expected.q, expected.u),
                          found.u / found.i / degree - expected.u / std::hypot(expected.q, expected.u)));
    }
    return off;
  };
  EXPECT_LT(worst(0.4), 1e-5);
  EXPECT_GT(worst(-0.4), 0.1) << "turned the other way";
  EXPECT_GT(worst(0.0), 0.1) << "not turned";
}

/// A warm plate under a sky of its own radiance times a share.
Estimate plate_under_sky(const std::shared_ptr<const materials::Bsdf>& bsdf, double share,
                         std::uint32_t count) {
  constexpr double kWarm_k = 300.0;
  const double black = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, kWarm_k);
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.2, kWarm_k, bsdf));
  scene.sky(share * black);
  const math::Ray ray = towards_origin(std::acos(23.0 / 32.0), 0.9);  // an angle of the table of emissivities
  Estimate found = stokes(scene.build_polarized(), ray, radiometry::meridional_frame(-ray.direction), count);
  found.mean = (1.0 / black) * found.mean;
  found.error = (1.0 / black) * found.error;
  return found;
}

TEST(PolarizedPaths, EmissionIsAcrossReflectedSky) {
  for (const auto& bsdf : {conductor(1.5, 0.1, 0.15), lacquer(0.3)}) {
    const Estimate warm = plate_under_sky(bsdf, 0.0, 1 << 8), room = plate_under_sky(bsdf, 1.0, 1 << 16);
    EXPECT_GT(warm.mean.q, 0.01);  // x of the meridional frame is p
    EXPECT_NEAR(warm.mean.u, 0.0, 1e-6);
    // In a room of one temperature nothing is left of it; emission that is unpolarized, the planted fault, would leave
    // what is reflected.
    EXPECT_NEAR(room.mean.i, 1.0, 4e-4);
    EXPECT_NEAR(room.mean.q, 0.0, 1e-4);
    EXPECT_NEAR(room.mean.u, 0.0, 1e-4);
    EXPECT_LT(room.mean.q - warm.mean.q, -0.01);
  }
}

// A mirror shows a polarized emitter as if it stood behind: U of the image changes its sign with the hand of its frame.
TEST(PolarizedPaths, AMirrorTurnsTheHandOfWhatItShows) {
  SmallScene scene;
  // Above: a warm plate that looks down; below: a mirror.
  scene.place(
      geometry::Polygon{{{-50.0, -50.0, 4.0}, {-50.0, 50.0, 4.0}, {50.0, 50.0, 4.0}, {50.0, -50.0, 4.0}}},
      scene.material(0.2, 300.0, conductor(1.5, 0.1, 0.1)));
  scene.place(geometry::Plane{}, scene.material(0.9, 0.0, materials::Mirror::shared()));
  const transport::SpectralScene& built = scene.build_polarized();
  const math::Ray down{{0.0, 0.0, 2.0}, math::normalized({0.9, 0.2, -0.6})},
      up{{0.0, 0.0, 2.0}, math::normalized({0.9, 0.2, 0.6})};
  // About axes that are none of either surface.
  PolarizationFrame frame = radiometry::meridional_frame(-down.direction);
  frame.x = std::cos(0.3) * frame.x + std::sin(0.3) * frame.y();
  PolarizationFrame image = radiometry::meridional_frame(-up.direction);
  image.x = std::cos(0.3) * image.x - std::sin(0.3) * image.y();
  // Plates reflect each other's light: one scattering beyond is enough for this, and noise cancels where paths are few.
  const Estimate shown = stokes(built, down, frame, 1 << 14), straight = stokes(built, up, image, 1 << 14);
  const auto within = [](double a, double b, double e) { return std::abs(a - b) < 4.0 * e + 1e-6; };
  EXPECT_GT(std::abs(straight.mean.u), 20.0 * straight.error.u);
  EXPECT_TRUE(within(shown.mean.q, 0.9 * straight.mean.q, std::hypot(shown.error.q, straight.error.q)))
      << shown.mean.q << " " << straight.mean.q;
  EXPECT_TRUE(within(shown.mean.u, -0.9 * straight.mean.u, std::hypot(shown.error.u, straight.error.u)))
      << shown.mean.u << " " << straight.mean.u;
}

/// A yard of metal and lacquer with a hot ball: light goes from one thing to another.
Estimate yard(bool sought, std::uint32_t count) {
  SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.3, 290.0, lacquer(0.3)));
  scene.place(geometry::Polygon{{{3.0, -4.0, 0.0}, {3.0, 4.0, 0.0}, {3.0, 4.0, 6.0}, {3.0, -4.0, 6.0}}},
              scene.material(0.8, 0.0, conductor(1.5, 2.0, 0.3)));
  scene.place(geometry::Sphere{{0.8, -0.8, 0.6}, 0.4}, scene.material(0.2, 900.0, conductor(2.0, 0.5, 0.3)));
  scene.sky(20.0);
  const transport::SpectralScene& built = scene.build_polarized();
  transport::TransportOptions options;
  options.seek_emitters = sought;
  transport::PathTracer tracer(built, options);
  const math::Ray ray{{-3.0, 1.0, 2.0}, math::normalized({0.8, -0.2, -0.45})};
  const PolarizationFrame frame = radiometry::meridional_frame(-ray.direction);
  const std::vector<math::Ray> rays(count, ray);
  std::vector<transport::PathKey> keys(count);
  for (std::uint32_t k = 0; k < count; ++k) keys[k] = {7, k};
  std::vector<geometry::SurfacePoint> hits(count);
  sampling::RayCounts counts;
  const transport::PathRecord& paths = tracer.trace(rays, keys, hits, counts);
  transport::PolarizedPathLight light(built);
  std::array<double, 3> sum{}, squares{};
  for (std::uint32_t k = 0; k < count; ++k) {
    const transport::StokesRows rows = light.light(paths, k, frame);
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(rows[c][0]);
      sum[c] += value, squares[c] += value * value;
    }
    // No path brings light that cannot be.
    EXPECT_LE(std::hypot(rows[1][0], rows[2][0], rows[3][0]), rows[0][0] * (1.0f + 1e-4f));
  }
  const auto error = [&](std::size_t c) {
    return std::sqrt((squares[c] / count - std::pow(sum[c] / count, 2)) / count);
  };
  return {{sum[0] / count, sum[1] / count, sum[2] / count, 0.0}, {error(0), error(1), error(2), 0.0}};
}

// Light that is sought from emitters and light that is found by chance are the same.
TEST(PolarizedPaths, SoughtAndFoundLightAgree) {
  const Estimate sought = yard(true, 1 << 14), found = yard(false, 1 << 15);
  EXPECT_NEAR(sought.mean.i, found.mean.i, 4.0 * std::hypot(sought.error.i, found.error.i));
  EXPECT_NEAR(sought.mean.q, found.mean.q, 4.0 * std::hypot(sought.error.q, found.error.q));
  EXPECT_NEAR(sought.mean.u, found.mean.u, 4.0 * std::hypot(sought.error.u, found.error.u));
  EXPECT_GT(std::hypot(sought.mean.q, sought.mean.u), 5.0 * sought.error.q);
}

}  // namespace
}  // namespace ifov::test_polarized_paths
