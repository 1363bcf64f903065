// The Sun's glints on curved mirrors, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "materials/bsdf/mirror.h"
#include "render/mirrors/glints.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sampling/tile.h"
#include "sensor/frame_camera.h"
#include "sensor/orthographic_camera.h"
#include "transport/small_scene.h"

namespace ifov::test_glints {
namespace {

using test::SmallScene;

constexpr double kMirror = 0.8, kIrradiance = 1000.0, kHalfAngle = 0.00465, kRadius = 0.7, kGsd = 0.5;
constexpr int kSide = 8;
const auto kMirrorKind = materials::Mirror::shared();
const math::Vec3 kSun{0.6, 0.2, 1.0};

sensor::OrthographicCamera nadir_camera() {
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = kSide;
  settings.gsd_m = kGsd;
  settings.start_height_m = 100.0;
  return sensor::OrthographicCamera(settings);
}

/// What the glints of a scene add to an image, with errors.
sampling::TileResult glints_in(const transport::SpectralScene& scene, const sensor::Camera& camera,
                               std::uint64_t seed = 1) {
  sampling::TileResult tile;
  tile.reset({0, 0, camera.width_px(), camera.height_px()}, 1);
  const render::Glints glints(scene, camera, 0.5, seed);
  glints.add_to(sampling::PixelFootprint::box(1.0), nullptr, tile);
  return tile;
}

double total(const sampling::TileResult& tile) {
  double sum = 0.0;
  for (const float value : tile.mean) sum += static_cast<double>(value);
  return sum;
}

/// A scene of one mirror under the Sun.
struct Ball : SmallScene {
  Ball(geometry::Shape shape, double half_angle, math::Vec3 towards_sun = kSun) {
    place(std::move(shape), material(kMirror, 0.0, kMirrorKind));
    sun(towards_sun, kIrradiance, half_angle);
  }
};

/// A mirror ball scatters alike in all directions: rho E R^2 / 4 in W per sr.
constexpr double kBall = kMirror * kIrradiance * kRadius * kRadius / 4.0 / (kGsd * kGsd);

TEST(Glints, BallAndDomeSendAQuarterOfTheirDiscEverywhere) {
  const auto camera = nadir_camera();
  for (const math::Vec3 sun : {kSun, math::Vec3{0.0, 0.0, 1.0}, math::Vec3{2.0, 0.0, 1.0}})
    for (const double half_angle : {kHalfAngle, 0.0})
      for (const geometry::Shape& shape :
           {geometry::Shape{geometry::Sphere{{0.12, 0.1, 1.0}, kRadius}},
            geometry::Shape{geometry::Hemisphere{{0.12, 0.1, 0.0}, kRadius}}}) {
        Ball scene(shape, half_angle, sun);
        EXPECT_NEAR(total(glints_in(scene.build(), camera)), kBall, 4e-3 * kBall);
      }
}

TEST(Glints, PixelsShareTheImageOfTheDisc) {
  // The glint for light from w lies at R n of the plane, n halfway between w and the zenith, and every part of the disc
  // has R^2 / 4 of area. Shifts put it across borders of pixels.
  const auto camera = nadir_camera();
  const math::Vec3 s = math::normalized(kSun);
  const sampling::TangentFrame frame(s);
  int judged = 0, held = 0;
  for (int shift = 0; shift < 50; ++shift) {
    // Every other shift lays the border through the glint.
    const math::Vec3 half = math::normalized(s + math::Vec3{0.0, 0.0, 1.0});
    const double spread = shift % 2 == 0 ? 1.0 : 0.004;
    const double x = -kRadius * half.x + spread * kGsd * (sampling::unit_double(2 * shift) - 0.5);
    const double y = -kRadius * half.y + spread * kGsd * (sampling::unit_double(2 * shift + 1) - 0.5);
    Ball scene(geometry::Sphere{{x, y, 2.0}, kRadius}, kHalfAngle);
    const sampling::TileResult tile = glints_in(scene.build(), camera, static_cast<std::uint64_t>(shift));
    std::map<int, double> expected;
    constexpr int kCells = 200;
    const double sine = std::sin(kHalfAngle);
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        const double a = (2.0 * i + 1.0) / kCells - 1.0, b = (2.0 * j + 1.0) / kCells - 1.0;
        if (a * a + b * b >= 1.0) continue;
        const math::Vec3 w = math::normalized(s + sine * a * frame.first + sine * b * frame.second);
        const math::Vec3 n = math::normalized(w + math::Vec3{0.0, 0.0, 1.0});
        sampling::FocalPoint at;
        camera.project({x + kRadius * n.x, y + kRadius * n.y, 0.0}, at);
        expected[static_cast<int>(at.y_px) * kSide + static_cast<int>(at.x_px)] +=
            kBall * 4.0 / (std::numbers::pi * kCells * kCells);
      }
    for (const auto& [pixel, value] : expected) {
      if (value < 0.01 * kBall) continue;
      const auto at = static_cast<std::size_t>(pixel);
      ++judged;
      held += std::abs(static_cast<double>(tile.mean[at]) - value) <=
              static_cast<double>(tile.half_width[at]) + 5e-4 * kBall;
      EXPECT_NEAR(static_cast<double>(tile.mean[at]), value, 0.02 * kBall);
    }
  }
  EXPECT_GT(judged, 60);
  EXPECT_GE(held, 0.93 * judged);
}

TEST(Glints, BothLegsMustBeFree) {
  const auto camera = nadir_camera();
  const math::Vec3 s = math::normalized(kSun), half = math::normalized(s + math::Vec3{0.0, 0.0, 1.0});
  const math::Point3 glint = math::Point3{0.0, 0.0, 1.0} + half * kRadius;
  for (const math::Vec3 leg : {math::Vec3{0.0, 0.0, 1.0}, s}) {
    Ball scene(geometry::Sphere{{0.0, 0.0, 1.0}, kRadius}, kHalfAngle);
    const math::Point3 at = glint + leg * 3.0;
    scene.place(geometry::Box{at - math::Vec3{0.3, 0.3, 0.05}, at + math::Vec3{0.3, 0.3, 0.05}},
                scene.material(0.1));
    EXPECT_EQ(total(glints_in(scene.build(), camera)), 0.0);
  }
  Ball free(geometry::Sphere{{0.0, 0.0, 1.0}, kRadius}, kHalfAngle);
  free.place(geometry::Box{{2.0, 2.0, 0.0}, {2.1, 2.1, 1.0}}, free.material(0.1));
  EXPECT_GT(total(glints_in(free.build(), camera)), 0.9 * kBall);
}

/// Along a pipe on its side the Sun's image is a line: over the focal plane L_sun times its length times R cos(phi) alpha,
/// phi half of the Sun's zenith angle, for a Sun across the pipe.
TEST(Glints, PipeShowsALine) {
  constexpr double kLength = 2.2, kZenith = 0.7;
  SmallScene scene;
  scene.place(geometry::Cylinder{{0.0, 0.0, 0.0}, kRadius, kLength, false},
              scene.material(kMirror, 0.0, kMirrorKind),
              math::Transform::translation({-0.4, -1.1, 2.0}) *
                  math::Transform::rotation({1.0, 0.0, 0.0}, -0.5 * std::numbers::pi));
  scene.sun({std::sin(kZenith), 0.0, std::cos(kZenith)}, kIrradiance, kHalfAngle);
  const double expected = kMirror * kIrradiance / (std::numbers::pi * kHalfAngle) * kLength * kRadius *
                          std::cos(0.5 * kZenith) / (kGsd * kGsd);
  EXPECT_NEAR(total(glints_in(scene.build(), nadir_camera())), expected, 0.01 * expected);
}

/// A sphere of triangles with the sphere's normals at its vertices.
geometry::TriangleMesh smooth_ball(int rings) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j <= 2 * rings; ++j) {
      const double a = std::numbers::pi * i / rings, b = std::numbers::pi * j / rings;
      const math::Vec3 n{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
      mesh.vertices_m.push_back(math::Point3{0.1, 0.0, 1.0} + n * kRadius);
      mesh.normals.push_back(math::as_normal(n));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (2 * rings + 1) + j); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rings) mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

TEST(Glints, SmoothMeshIsNearlyABall) {
  for (const double half_angle : {kHalfAngle, 0.0}) {
    Ball scene(smooth_ball(60), half_angle);
    EXPECT_NEAR(total(glints_in(scene.build(), nadir_camera())), kBall, 0.02 * kBall);
  }
}

TEST(Glints, FrameCameraSeesThem) {
  // From a distance D the ball sends rho E R^2 / 4 / D^2 to the sensor, spread over a pixel's solid angle.
  sensor::FrameCamera::Settings settings;
  settings.width_px = settings.height_px = kSide;
  settings.focal_length_m = 1.0;
  settings.pitch_m = 1e-3;
  settings.position_m = {0.0, 0.0, 1000.0};
  settings.axes.forward = {0.0, 0.0, -1.0};
  settings.axes.right = {1.0, 0.0, 0.0};
  settings.axes.down = {0.0, -1.0, 0.0};
  const sensor::FrameCamera camera(settings);
  for (const double half_angle : {kHalfAngle, 0.0}) {
    Ball scene(geometry::Sphere{{0.3, 0.2, 1.0}, kRadius}, half_angle);
    const double expected = kBall * kGsd * kGsd / (999.0 * 999.0) / 1e-6;
    EXPECT_NEAR(total(glints_in(scene.build(), camera)), expected, 6e-3 * expected);
  }
}

TEST(Glints, ImagesPathsLeaveThemOutAndOthersFindThem) {
  // Straight at the glint: by chance paths see the disc, apart they do not.
  Ball scene(geometry::Sphere{{0.0, 0.0, 1.0}, kRadius}, kHalfAngle);
  scene.build();
  const math::Vec3 half = math::normalized(math::normalized(kSun) + math::Vec3{0.0, 0.0, 1.0});
  const math::Ray ray{math::Point3{kRadius * half.x, kRadius * half.y, 50.0}, {0.0, 0.0, -1.0}};
  EXPECT_NEAR(scene.radiance(ray, 4).mean,
              kMirror * kIrradiance / (std::numbers::pi * std::pow(std::sin(kHalfAngle), 2)),
              1e-3 * scene.radiance(ray, 4).mean);
  transport::TransportOptions apart;
  apart.sought_only = true;
  EXPECT_EQ(scene.radiance(ray, 4, 1, apart).mean, 0.0);
}

}  // namespace
}  // namespace ifov::test_glints
