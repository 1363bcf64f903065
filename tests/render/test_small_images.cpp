// Images of small bright things in mirrors: sought where one mirror shows them, marked where several do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>
#include <vector>

#include "materials/bsdf/mirror.h"
#include "radiometry/planck.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/mirrors/mirror_images.h"
#include "render/tile_sink.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sampling/tile.h"
#include "sensor/orthographic_camera.h"
#include "transport/emitters.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_small_images {
namespace {

using test::SmallScene;

constexpr double kMirror = 0.8, kHot_k = 2000.0, kWarm_k = 300.0, kHotRadius = 0.1;
constexpr int kSide = 6;
const auto kMirrorKind = materials::Mirror::shared();
const math::Point3 kThing{-2.5, 1.0, 2.0};

double planck(double temperature_k) {
  return radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, temperature_k);
}

struct OneTile final : render::TileSink {
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

sensor::OrthographicCamera camera_over(double x, double y) {
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = kSide;
  settings.centre_x_m = x, settings.centre_y_m = y;
  settings.start_height_m = 100.0;
  return sensor::OrthographicCamera(settings);
}

/// Pixels of 1 m about (x, y), at an error of 1 %; `paths_alone`: by the sampler's paths and nothing else.
sampling::TileResult image_of(const transport::SpectralScene& scene, double x, double y, std::uint64_t seed,
                              bool paths_alone = false) {
  const sensor::OrthographicCamera camera = camera_over(x, y);
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  const sampling::AccuracySampler sampler;
  const render::ChannelBrightness brightness(scene.nodes());
  const render::AccuracyTolerance tolerance({}, brightness, scene.white_reflected(), kSide * kSide);
  render::RenderJob job{scene, camera, footprint, sampler};
  job.tolerance = &tolerance;
  job.seed = seed;
  OneTile sink;
  render::RenderControl control;
  control.threads = 1;
  if (!paths_alone) {
    render::render_image(job, control, sink);
    return sink.result;
  }
  render::SceneField field(scene, camera, {}, render::LabelDetail::sun_state);
  const int steering_channels[1] = {0};
  sampling::TileProblem problem;
  problem.tile = problem.image = {0, 0, kSide, kSide};
  problem.seed = seed;
  problem.footprint = &footprint;
  problem.tolerance = &tolerance;
  problem.steering_channels = steering_channels;
  sampler.sample(problem, field, sink.result);
  return sink.result;
}

/// A mirror over ground, and a hot ball beside it. All else has one temperature and is black but for the mirror: whatever
/// one looks at, without the ball it has the radiance of a black body of that temperature (Kirchhoff).
struct Scene : SmallScene {
  explicit Scene(std::initializer_list<geometry::Shape> mirrors, double relief = 0.0) {
    place(geometry::Plane{}, material(0.0, kWarm_k));
    const std::uint32_t mirror = material(kMirror, kWarm_k, kMirrorKind);
    if (relief > 0.0) scene().assignments[mirror].patterns.push_back(std::make_shared<Tilted>(relief));
    for (const geometry::Shape& shape : mirrors) place(shape, mirror);
    place(geometry::Sphere{kThing, kHotRadius}, material(0.0, kHot_k));
    sky(planck(kWarm_k));
  }
  /// Normals that lean to either side in strips.
  struct Tilted final : scene::Pattern {
    explicit Tilted(double slope) : slope_(slope) {}
    void apply(const geometry::SurfacePoint& point, scene::ResolvedSurface& surface) const override {
      const math::Vec3 n = surface.shading_normal.as_vector();
      const double side = std::sin(9.0 * point.position_m.y);
      surface.shading_normal =
          math::as_normal(math::normalized(n + slope_ * side * math::Vec3{0.0, 1.0, 0.0}));
    }
    bool bends_normals() const override { return true; }
    double slope_;
  };
};

/// What a pixel sees more where a mirror shows the ball to it: `spread` is the determinant of the map from places of the
/// focal plane to those about the ball, seen along the light's way.
double more(double spread) {
  return kMirror * (planck(kHot_k) - planck(kWarm_k)) * std::numbers::pi * kHotRadius * kHotRadius / spread;
}

const geometry::Polygon kFlat{{{0.0, -4.0, 0.0}, {4.0, -4.0, 4.0}, {4.0, 4.0, 4.0}, {0.0, 4.0, 0.0}}};
/// In the plane x = z each point stands where its x and z change places.
const math::Point3 kInFlat{kThing.z, kThing.y, kThing.x};

constexpr double kRadius = 0.9;
const math::Point3 kCentre{1.0, 0.3, 1.2};

struct InBall {
  math::Point3 at;
  double spread = 0.0;
};
/// From the law of reflection, by halving the arc between the zenith and the ball's direction; the light that comes down in
/// parallel fills (1 + 2 L / R cos) (1 + 2 L cos / R) times its section at a distance L from the mirror.
InBall in_ball() {
  math::Vec3 side = kThing - kCentre;
  const double height = side.z;
  side.z = 0.0;
  const double across = math::length(side);
  side = side / across;
  double low = 0.0, high = 0.5 * std::numbers::pi;
  for (int k = 0; k < 100; ++k) {
    const double angle = 0.5 * (low + high);
    const double x = kRadius * std::sin(angle), z = kRadius * std::cos(angle);
    // What is seen in a normal at this angle lies at twice the angle from the zenith.
    (std::atan2(across - x, height - z) > 2.0 * angle ? low : high) = angle;
  }
  const double cosine = std::cos(low);
  const math::Vec3 normal = std::sin(low) * side + math::Vec3{0.0, 0.0, cosine};
  const math::Point3 at = kCentre + kRadius * normal;
  const double way = math::length(kThing - at);
  return {at, (1.0 + 2.0 * way / (kRadius * cosine)) * (1.0 + 2.0 * way * cosine / kRadius)};
}

struct Judged {
  int pixels = 0, held = 0, sure = 0;
};

/// The pixel that shows the image at (x, y) of the ground, in pictures that are moved by parts of a pixel.
Judged judge(std::initializer_list<geometry::Shape> mirrors, math::Point3 image, double expected,
             bool paths_alone) {
  Judged judged;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const double left = image.x - 2.0 - sampling::unit_double(seed),
                 low = image.y - 2.0 - sampling::unit_double(seed + 50);
    Scene scene(mirrors);
    const sampling::TileResult tile =
        image_of(scene.build(), left + 0.5 * kSide, low + 0.5 * kSide, seed, paths_alone);
    const int column = static_cast<int>(std::floor(image.x - left)),
              row = kSide - 1 - static_cast<int>(std::floor(image.y - low));
    const auto at = static_cast<std::size_t>(row * kSide + column);
    ++judged.pixels;
    judged.sure += tile.converged(at);
    // Images that lie on a border are shared.
    const double inside_x = image.x - left - column, inside_y = image.y - low - (kSide - 1 - row);
    if (std::min({inside_x, inside_y, 1.0 - inside_x, 1.0 - inside_y}) < 1.5 * kHotRadius) {
      ++judged.held;
      continue;
    }
    judged.held += std::abs(static_cast<double>(tile.mean[at]) - planck(kWarm_k) - expected) <=
                   static_cast<double>(tile.half_width[at]) + 1e-3 * expected;
  }
  return judged;
}

TEST(SmallImages, AHotBallIsSeenInAFlatMirrorAndInABall) {
  const InBall ball = in_ball();
  const geometry::Shape flat = kFlat, round = geometry::Sphere{kCentre, kRadius};
  for (const auto& [shape, image, expected] :
       {std::tuple{flat, kInFlat, more(1.0)}, std::tuple{round, ball.at, more(ball.spread)}}) {
    ASSERT_GT(expected, 3.0 * 0.01 * planck(kWarm_k)) << "what is asked for must notice it";
    const Judged judged = judge({shape}, image, expected, false);
    EXPECT_EQ(judged.held, judged.pixels);
    EXPECT_EQ(judged.sure, judged.pixels);
    // Planted fault: by paths alone it is not met, and the pixel is sure all the same.
    const Judged alone = judge({shape}, image, expected, true);
    EXPECT_LE(alone.held, alone.pixels / 2);
    EXPECT_GE(alone.sure, alone.pixels / 2);
  }
}

TEST(SmallImages, WhatStandsInTheWayHidesThem) {
  Scene scene({kFlat});
  scene.place(geometry::Box{{0.0, kThing.y - 0.5, kThing.z - 0.5}, {0.1, kThing.y + 0.5, kThing.z + 0.5}},
              scene.material(0.0, kWarm_k));
  const sampling::TileResult tile = image_of(scene.build(), kInFlat.x, kInFlat.y, 1);
  for (const float mean : tile.mean) EXPECT_NEAR(static_cast<double>(mean), planck(kWarm_k), 1e-4);
}

TEST(SmallImages, PathsSeeThroughWhatIsAddedApart) {
  Scene small({kFlat});
  const transport::SpectralScene& scene = small.build();
  const sensor::OrthographicCamera camera = camera_over(kInFlat.x, kInFlat.y);
  const auto images = render::MirrorImages::find(scene, camera, {}, 0.5, 1, 1);
  ASSERT_NE(images, nullptr);
  EXPECT_FALSE(images->apart().empty());
  const math::Ray ray{{kInFlat.x, kInFlat.y, 50.0}, {0.0, 0.0, -1.0}};
  transport::TransportOptions apart;
  apart.separate_images = &images->apart();
  EXPECT_NEAR(small.radiance(ray, 4).mean, kMirror * planck(kHot_k) + (1.0 - kMirror) * planck(kWarm_k),
              1e-3 * planck(kHot_k));
  EXPECT_NEAR(small.radiance(ray, 4, 1, apart).mean, planck(kWarm_k), 1e-3 * planck(kWarm_k));
  // Seen straight it is what it was.
  const math::Ray straight{kThing + math::Vec3{0.0, 0.0, 9.0}, {0.0, 0.0, -1.0}};
  EXPECT_NEAR(small.radiance(straight, 4, 1, apart).mean, planck(kHot_k), 1e-3 * planck(kHot_k));
}

// A rod far thinner than the sphere about it, and specks of one object far apart: what is looked for is where they are.
TEST(SmallImages, RodsAndScatteredSpecksAreFoundWhole) {
  constexpr double kThin = 0.004, kLength = 1.7;
  for (const bool rod : {true, false}) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(0.0, kWarm_k));
    scene.place(kFlat, scene.material(kMirror, kWarm_k, kMirrorKind));
    double area = 0.0;
    if (rod) {
      // Lies along y; its ends are not seen.
      scene.place(geometry::Cylinder{{0.0, 0.0, 0.0}, kThin, kLength, true}, scene.material(0.0, kHot_k),
                  math::Transform::translation(kThing - math::Point3{0.0, 0.5 * kLength, 0.0}) *
                      math::Transform::rotation({1.0, 0.0, 0.0}, -0.5 * std::numbers::pi));
      area = 2.0 * kThin * kLength;
    } else {
      geometry::TriangleMesh mesh;  // faces towards the mirror
      for (std::uint32_t k = 0; k < 60; ++k) {
        const math::Point3 at =
            kThing + math::Vec3{0.0, 3.0 * sampling::unit_double(k) - 1.5, sampling::unit_double(k + 99)};
        for (const math::Vec3 to : {math::Vec3{}, math::Vec3{0.0, kThin, 0.0}, math::Vec3{0.0, 0.0, kThin}})
          mesh.vertices_m.push_back(at + to);
        mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        area += 0.5 * kThin * kThin;
      }
      scene.place(std::move(mesh), scene.material(0.0, kHot_k));
    }
    scene.sky(planck(kWarm_k));
    const transport::SpectralScene& spectral = scene.build();
    const sensor::OrthographicCamera camera = camera_over(kInFlat.x, kInFlat.y);
    const auto images = render::MirrorImages::find(spectral, camera, {}, 0.5, 1, 1);
    ASSERT_NE(images, nullptr);
    sampling::TileResult tile;
    tile.reset({0, 0, kSide, kSide}, 1);
    images->add_to(sampling::PixelFootprint::box(1.0), nullptr, tile);
    double sum = 0.0;
    for (const float mean : tile.mean) sum += static_cast<double>(mean);
    const double expected = kMirror * (planck(kHot_k) - planck(kWarm_k)) * area;
    EXPECT_NEAR(sum, expected, 0.01 * expected) << rod;
  }
}

/// Pixels of a picture that say that light may reach them by ways that are not sought.
std::vector<bool> marked(const sampling::TileResult& tile) {
  std::vector<bool> marks;
  for (const sampling::Reasons reasons : tile.reasons)
    marks.push_back((reasons & sampling::bit(sampling::Reason::unseen_light)) != 0);
  return marks;
}

TEST(SmallImages, SeveralMirrorsInTurnAndReliefsMarkWhereTheyMayLie) {
  // Behind the thing a second mirror shows it from its other side, 1 m farther off by way of the first one.
  const geometry::Box second{{kThing.x - 1.0, -4.0, 0.2}, {kThing.x - 0.5, 4.0, 5.0}};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double x = kInFlat.x + sampling::unit_double(seed) - 0.5, y = kInFlat.y;
    Scene one({kFlat}), two({kFlat, second}), bumpy({kFlat}, 0.05);
    const sampling::TileResult single = image_of(one.build(), x, y, seed),
                               twice = image_of(two.build(), x, y, seed),
                               rough = image_of(bumpy.build(), x, y, seed);
    const std::vector<bool> none = marked(single), some = marked(twice), around = marked(rough);
    EXPECT_EQ(std::count(none.begin(), none.end(), true), 0);
    const int column = static_cast<int>(std::floor(kInFlat.x - x + 0.5 * kSide)), row = kSide / 2;
    // The image lies on the border of two rows.
    EXPECT_TRUE(some[static_cast<std::size_t>(row * kSide + column)] ||
                some[static_cast<std::size_t>((row - 1) * kSide + column)]);
    EXPECT_TRUE(around[static_cast<std::size_t>(row * kSide + column)] ||
                around[static_cast<std::size_t>((row - 1) * kSide + column)]);
    EXPECT_LT(std::count(some.begin(), some.end(), true), kSide * kSide * 3 / 4);
  }
}

// A hot ball 3 m from a chrome ball lights grey ground by way of it: near the ball by percents, far from it by nothing. That
// is sought where the chrome ball is round.
TEST(SmallImages, WhatABallThrowsOnTheGroundIsMarkedWhereItMatters) {
  const auto picture = [](double thing_k, double x, double stretch = 1.02) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(0.5, kWarm_k));
    scene.place(geometry::Sphere{{0.0, 0.0, 0.0}, kRadius}, scene.material(kMirror, kWarm_k, kMirrorKind),
                math::Transform::translation(kCentre - math::Point3{}) *
                    math::Transform::scaling({1.0, stretch, 1.0}));
    scene.place(geometry::Sphere{kThing, 1.5 * kHotRadius}, scene.material(0.0, thing_k));
    scene.sky(planck(kWarm_k));
    return marked(image_of(scene.build(), x, 0.0, 3));
  };
  const std::vector<bool> near = picture(6000.0, 2.0), cool = picture(400.0, 2.0),
                          far = picture(6000.0, 60.0), round = picture(6000.0, 2.0, 1.0);
  EXPECT_GT(std::count(near.begin(), near.end(), true), 3);
  EXPECT_LT(std::count(cool.begin(), cool.end(), true), 10) << "under the ball alone";
  EXPECT_EQ(std::count(far.begin(), far.end(), true), 0);
  EXPECT_EQ(std::count(round.begin(), round.end(), true), 0);
}

/// Hot specks over grey ground, so many that none is sought, at one end of a picture.
TEST(UnseenEmitters, MarkWhatTheyMayLightAndNothingFarOff) {
  const auto picture = [](std::size_t specks) {
    SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(0.5, kWarm_k));
    geometry::TriangleMesh mesh;
    constexpr double kSize = 1e-5;
    for (std::size_t k = 0; k < specks; ++k) {
      const math::Point3 at{-3.0 + 1e-3 * static_cast<double>(k % 1024),
                            -0.5 + 1e-3 * static_cast<double>(k / 1024), 1.0};
      const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
      for (const math::Vec3 to : {math::Vec3{}, math::Vec3{kSize, 0.0, 0.0}, math::Vec3{0.0, kSize, 0.0}})
        mesh.vertices_m.push_back(at + to);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    scene.place(std::move(mesh), scene.material(0.0, 1.0e5));
    scene.sky(planck(kWarm_k));
    return image_of(scene.build(), 0.0, 0.0, 1).reasons;
  };
  const auto unseen = sampling::bit(sampling::Reason::unseen_light);
  const std::vector<sampling::Reasons> few = picture(1000), many = picture(transport::Emitters::kMost + 1024);
  for (const sampling::Reasons reasons : few) EXPECT_EQ(reasons & unseen, 0);
  const std::size_t row = kSide / 2 * kSide;
  EXPECT_NE(many[row] & unseen, 0);
  EXPECT_NE(many[row + 1] & unseen, 0);
  EXPECT_EQ(many[row + kSide - 1] & unseen, 0);
}

}  // namespace
}  // namespace ifov::test_small_images
