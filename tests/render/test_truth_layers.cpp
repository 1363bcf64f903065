// What middles of pixels see, of cameras of every kind, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "platform/trajectory.h"
#include "render/truth_layers.h"
#include "sampling/tile.h"
#include "sensor/frame_camera.h"
#include "sensor/orthographic_camera.h"
#include "sensor/pushbroom_camera.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"
#include "truth/gsd.h"
#include "truth/identity.h"
#include "truth/orientation.h"
#include "truth/range.h"
#include "truth/sunlight.h"
#include "truth/time.h"

namespace ifov::test_truth_layers {
namespace {

using test::SmallScene;

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// All collectors' layers of an image, as one tile.
sampling::TileResult truth_of(const transport::SpectralScene& scene, const sensor::Camera& camera) {
  static constexpr const truth::Collector* kAll[] = {&truth::kRange,  &truth::kNormal,   &truth::kSlope,
                                                     &truth::kGsd,    &truth::kTime,     &truth::kSunAngles,
                                                     &truth::kShadow, &truth::kMaterial, &truth::kInstance};
  sampling::TileResult tile;
  tile.reset({0, 0, camera.width_px(), camera.height_px()}, 1, false);
  render::add_truth_layers(kAll, scene.scene(), camera, tile);
  EXPECT_EQ(tile.fault(), "");
  return tile;
}

template <class Value = float>
std::span<const Value> layer(const sampling::TileResult& tile, const truth::Collector& of) {
  return tile.layer(of.name)->values<Value>();
}

sensor::FrameCamera frame(int side, math::Point3 position_m) {
  sensor::FrameCamera::Settings settings;
  settings.width_px = settings.height_px = side;
  settings.focal_length_m = 0.1;
  settings.pitch_m = 0.002;
  settings.position_m = position_m;
  return sensor::FrameCamera(settings);
}

sensor::OrthographicCamera from_above(int side, double gsd_m, double start_m) {
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = side;
  settings.gsd_m = gsd_m;
  settings.start_height_m = start_m;
  return sensor::OrthographicCamera(settings);
}

/// z = a x, seen from H above the origin: the ray (u, v, -1) meets it at depth t = H / (1 + a u), at x = u t and y = v t.
TEST(TruthLayers, OfATiltedPlane) {
  constexpr double kTilt = 0.4, kHeight = 50.0, kStep = 0.02;
  constexpr int kSide = 9;
  SmallScene small;
  constexpr double kFar = 100.0;
  small.place(geometry::Polygon{{{-kFar, -kFar, -kFar * kTilt},
                                 {kFar, -kFar, kFar * kTilt},
                                 {kFar, kFar, kFar * kTilt},
                                 {-kFar, kFar, -kFar * kTilt}}},
              small.material(0.5, 300.0));
  small.sun({1.0, 1.0, 1.0}, 1000.0, 0.0);
  const transport::SpectralScene& scene = small.build();
  const sampling::TileResult tile = truth_of(scene, frame(kSide, {0.0, 0.0, kHeight}));
  const auto range = layer<double>(tile, truth::kRange);
  const auto time = layer<double>(tile, truth::kTime);
  const auto normal = layer(tile, truth::kNormal), slope = layer(tile, truth::kSlope),
             gsd = layer(tile, truth::kGsd), sun = layer(tile, truth::kSunAngles),
             shadow = layer(tile, truth::kShadow);
  const double along_slope = std::hypot(1.0, kTilt);
  for (std::size_t k = 0; k < kSide * kSide; ++k) {
    const double u = (static_cast<double>(k % kSide) - 4.0) * kStep,
                 v = (4.0 - static_cast<double>(k / kSide)) * kStep;
    const auto depth = [&](double at) { return kHeight / (1.0 + kTilt * at); };
    EXPECT_NEAR(range[k], depth(u) * std::sqrt(1.0 + u * u + v * v), 1e-11 * kHeight);
    EXPECT_NEAR(normal[3 * k], -kTilt / along_slope, 1e-7);
    EXPECT_NEAR(normal[3 * k + 1], 0.0, 1e-7);
    EXPECT_NEAR(normal[3 * k + 2], 1.0 / along_slope, 1e-7);
    EXPECT_NEAR(slope[2 * k], std::atan(kTilt) * kDegrees, 1e-5);
    EXPECT_NEAR(slope[2 * k + 1], 270.0, 1e-4) << "downhill is west";
    const double left = u - 0.5 * kStep, right = u + 0.5 * kStep;
    EXPECT_NEAR(gsd[2 * k],
                std::hypot(along_slope * (right * depth(right) - left * depth(left)),
                           v * (depth(right) - depth(left))),
                1e-6);
    EXPECT_NEAR(gsd[2 * k + 1], kStep * depth(u), 1e-6);
    EXPECT_NEAR(sun[3 * k], std::acos(std::sqrt(1.0 / 3.0)) * kDegrees, 1e-5);
    EXPECT_NEAR(sun[3 * k + 1], 45.0, 1e-5);
    EXPECT_NEAR(sun[3 * k + 2], std::acos((1.0 - kTilt) / along_slope * std::sqrt(1.0 / 3.0)) * kDegrees,
                1e-5);
    EXPECT_EQ(shadow[k], 0.0f);
    EXPECT_EQ(time[k], 0.0);
  }
}

/// A ball of radius R at height h over a plane: what of both the Sun reaches is told by the distance of its ray from the centre.
TEST(TruthLayers, OfASphereAndItsShadow) {
  constexpr double kRadius = 2.0, kHeight = 5.0;
  constexpr int kSide = 60;
  SmallScene small;
  const std::uint32_t ground = small.material(0.5, 300.0), ball = small.material(0.2, 310.0);
  small.place(geometry::Plane{}, ground);
  small.place(geometry::Sphere{{0.0, 0.0, kHeight}, kRadius}, ball);
  const math::Vec3 to_sun = math::normalized({1.0, 0.5, 1.5});
  small.sun(to_sun, 1000.0, 0.0);
  const transport::SpectralScene& scene = small.build();
  const sampling::TileResult tile = truth_of(scene, from_above(kSide, 0.31, 20.0));
  const auto normal = layer(tile, truth::kNormal), slope = layer(tile, truth::kSlope),
             gsd = layer(tile, truth::kGsd), sun = layer(tile, truth::kSunAngles),
             shadow = layer(tile, truth::kShadow);
  const auto range = layer<double>(tile, truth::kRange);
  const auto material = layer<std::uint16_t>(tile, truth::kMaterial);
  const auto instance = layer<std::uint32_t>(tile, truth::kInstance);
  int on_ball = 0, cast = 0, own = 0;
  for (std::size_t k = 0; k < kSide * kSide; ++k) {
    const double x = (static_cast<double>(k % kSide) - 29.5) * 0.31,
                 y = (29.5 - static_cast<double>(k / kSide)) * 0.31;
    const double across2 = x * x + y * y;
    EXPECT_TRUE(std::isnan(range[k])) << "parallel rays come from no place";
    if (across2 < kRadius * kRadius) {
      const double z = std::sqrt(kRadius * kRadius - across2);
      const math::Vec3 n = math::Vec3{x, y, z} / kRadius;
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(normal[3 * k + axis], (&n.x)[axis], 1e-6);
      EXPECT_NEAR(slope[2 * k], std::acos(n.z) * kDegrees, 1e-4);
      const double aspect = std::atan2(x, y) * kDegrees;
      EXPECT_NEAR(slope[2 * k + 1], aspect < 0.0 ? aspect + 360.0 : aspect, 1e-4);
      // On the plane that touches: a step of east, whose rise is -n.x / n.z.
      EXPECT_NEAR(gsd[2 * k], 0.31 * std::hypot(1.0, n.x / n.z), 1e-5);
      EXPECT_NEAR(gsd[2 * k + 1], 0.31 * std::hypot(1.0, n.y / n.z), 1e-5);
      const double cosine = math::dot(n, to_sun);
      EXPECT_NEAR(sun[3 * k + 2], std::acos(cosine) * kDegrees, 1e-4);
      EXPECT_EQ(shadow[k], cosine > 0.0 ? 0.0f : 1.0f);
      EXPECT_EQ(material[k], ball + 1);
      EXPECT_EQ(instance[k], 2u);
      ++on_ball;
      own += cosine <= 0.0;
    } else {
      EXPECT_EQ(normal[3 * k + 2], 1.0f);
      EXPECT_EQ(slope[2 * k], 0.0f);
      EXPECT_TRUE(std::isnan(slope[2 * k + 1])) << "level ground faces nowhere";
      EXPECT_NEAR(gsd[2 * k], 0.31, 1e-6);
      const math::Vec3 to_centre{-x, -y, kHeight};
      const double off = math::length(math::cross(to_centre, to_sun));
      EXPECT_EQ(shadow[k], off < kRadius ? 1.0f : 0.0f) << x << " " << y;
      EXPECT_EQ(material[k], ground + 1);
      EXPECT_EQ(instance[k], 1u);
      cast += off < kRadius;
    }
  }
  EXPECT_GT(on_ball, 100);
  EXPECT_GT(own, 5);
  EXPECT_GT(cast, 100);
}

/// Over level ground a line is as far from the next as the platform flies meanwhile, and an element as wide as its angle says.
TEST(TruthLayers, OfAMovingScanner) {
  constexpr double kSpeed = 60.0, kHeight = 800.0, kStep = 1e-3, kPeriod = 0.02, kStart = 1.5;
  constexpr int kWidth = 11, kLines = 7;
  const auto flight = std::make_shared<const platform::Trajectory>(
      platform::Trajectory::straight({0.0, 0.0, kHeight}, {0.0, kSpeed, 0.0}, {}));
  const sensor::PushbroomCamera camera({kWidth, kLines, kStep, 0.05, kStart, kPeriod, flight});
  SmallScene small;
  small.place(geometry::Plane{}, small.material(0.5, 300.0));
  small.sun({0.0, 0.0, 1.0}, 1000.0, 0.0);
  const sampling::TileResult tile = truth_of(small.build(), camera);
  const auto range = layer<double>(tile, truth::kRange), time = layer<double>(tile, truth::kTime);
  const auto gsd = layer(tile, truth::kGsd);
  for (std::size_t k = 0; k < kWidth * kLines; ++k) {
    const double u = (static_cast<double>(k % kWidth) - 5.0) * kStep;
    EXPECT_NEAR(range[k], kHeight * std::hypot(1.0, u), 1e-9);
    EXPECT_NEAR(time[k], kStart + (static_cast<double>(k / kWidth) + 0.5) * kPeriod, 1e-12);
    EXPECT_NEAR(gsd[2 * k], kHeight * kStep, 1e-6);
    EXPECT_NEAR(gsd[2 * k + 1], kSpeed * kPeriod, 1e-6);
  }
}

TEST(TruthLayers, WhereNothingIsSeenOrNothingShines) {
  SmallScene small;
  small.place(geometry::Disk{{0.0, 0.0, 0.0}, 5.0}, small.material(0.5, 300.0));
  const sampling::TileResult tile = truth_of(small.build(), frame(3, {0.0, 0.0, 200.0}));
  for (const std::size_t k : {std::size_t{0}, std::size_t{4}}) {
    const bool seen = k == 4;
    EXPECT_EQ(std::isnan(layer<double>(tile, truth::kRange)[k]), !seen);
    EXPECT_EQ(std::isnan(layer(tile, truth::kNormal)[3 * k]), !seen);
    EXPECT_EQ(std::isnan(layer(tile, truth::kSlope)[2 * k]), !seen);
    EXPECT_EQ(std::isnan(layer(tile, truth::kGsd)[2 * k]), !seen);
    EXPECT_TRUE(std::isnan(layer(tile, truth::kSunAngles)[3 * k])) << "there is no Sun";
    EXPECT_TRUE(std::isnan(layer(tile, truth::kShadow)[k]));
    EXPECT_EQ(layer<double>(tile, truth::kTime)[k], 0.0);
    EXPECT_EQ(layer<std::uint16_t>(tile, truth::kMaterial)[k], seen ? 1 : 0);
    EXPECT_EQ(layer<std::uint32_t>(tile, truth::kInstance)[k], seen ? 1u : 0u);
  }
}

/// A leaf sees the Sun from its lower side; a board does not.
TEST(TruthLayers, ShadowOfWhatLetsLightThrough) {
  for (const bool leaf : {true, false}) {
    SmallScene small;
    const std::uint32_t material = leaf ? small.leaf(0.4, 0.3) : small.material(0.4);
    small.place(geometry::Disk{{0.0, 0.0, 10.0}, 5.0}, material);
    small.sun({0.0, 0.0, 1.0}, 1000.0, 0.0);
    sensor::FrameCamera::Settings below;
    below.width_px = below.height_px = 1;
    below.focal_length_m = below.pitch_m = 1.0;
    below.axes = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const sampling::TileResult tile = truth_of(small.build(), sensor::FrameCamera(below));
    EXPECT_EQ(layer(tile, truth::kShadow)[0], leaf ? 0.0f : 1.0f);
    EXPECT_EQ(layer(tile, truth::kNormal)[2], -1.0f) << "of the side that is seen";
    EXPECT_NEAR(layer(tile, truth::kSunAngles)[2], 180.0, 1e-5);
  }
}

}  // namespace
}  // namespace ifov::test_truth_layers
