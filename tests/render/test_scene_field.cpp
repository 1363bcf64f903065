#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "materials/bsdf/mirror.h"
#include "render/field/scene_field.h"
#include "sensor/orthographic_camera.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"
#include "transport/timed_world.h"

namespace ifov::test_scene_field {
namespace {

// A mirror 10 m high faces a Sun with a slope of 2: what it throws ends 5 m before it, and labels tell that ground from
// ground farther off, with another label for the rim, where part of the disc is seen.
TEST(SceneField, LabelsTellGroundThatAMirrorLights) {
  test::SmallScene scene;
  scene.place(geometry::Plane{}, scene.material(0.3));
  scene.place(geometry::Polygon{{{0.0, -90.0, 0.0}, {0.0, 90.0, 0.0}, {0.0, 90.0, 10.0}, {0.0, -90.0, 10.0}}},
              scene.material(0.8, 0.0, materials::Mirror::shared()));
  scene.sun({1.0, 0.0, 2.0}, 1000.0, 0.00465);
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = 20;
  settings.start_height_m = 100.0;
  const sensor::OrthographicCamera camera(settings);  // x metres before the mirror are at 10 + x
  render::SceneField field(scene.build(), camera, {}, render::LabelDetail::sun_state);
  const std::vector<sampling::FocalPoint> points{
      {11.0, 4.0}, {14.0, 9.0}, {15.0, 6.0}, {16.0, 4.0}, {19.0, 9.0}};
  std::vector<sampling::Label> labels(points.size());
  field.labels(points, labels);
  EXPECT_EQ(labels[0], labels[1]);
  EXPECT_EQ(labels[3], labels[4]);
  EXPECT_NE(labels[1], labels[3]);
  EXPECT_NE(labels[2], labels[1]);
  EXPECT_NE(labels[2], labels[3]);
}

// A point's time goes with all rays that are sent for it: labels' rays to the Sun and by way of mirrors, and paths.
TEST(SceneField, AsksTheSceneAtTheTimeOfThePoint) {
  test::SmallScene scene;
  test::TimedWorld::Counts counts;
  scene.place(geometry::Plane{}, scene.material(0.3));
  scene.place(geometry::Polygon{{{0.0, -90.0, 0.0}, {0.0, 90.0, 0.0}, {0.0, 90.0, 10.0}, {0.0, -90.0, 10.0}}},
              scene.material(0.8, 0.0, materials::Mirror::shared()));
  scene.sun({1.0, 0.0, 2.0}, 1000.0, 0.00465);
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = 20;
  settings.start_height_m = 100.0;
  const sensor::OrthographicCamera camera(settings);
  const transport::SpectralScene& built = scene.build([&](std::unique_ptr<geometry::World> world) {
    return std::make_unique<test::TimedWorld>(std::move(world), counts);
  });
  render::SceneField field(built, camera, {}, render::LabelDetail::sun_state);
  counts = {};
  const auto expect_time = [&](double time_s) {
    std::size_t all = 0;
    for (const auto* by_time : {&counts.intersected, &counts.occluded})
      for (const auto& [time, count] : *by_time) {
        EXPECT_EQ(time, time_s);
        all += count;
      }
    EXPECT_GT(all, 10u) << "more than the two rays from the sensor";
    counts = {};
  };
  std::vector<sampling::Label> labels(2);
  const std::vector<sampling::FocalPoint> points{{11.0, 4.0, 2.5}, {16.0, 4.0, 2.5}};
  field.labels(points, labels);
  expect_time(2.5);
  const std::vector<sampling::PathRequest> requests{{{11.0, 4.0, -1.0}, 7, 0}, {{16.0, 4.0, -1.0}, 7, 1}};
  std::vector<float> values(2 * static_cast<std::size_t>(field.stride()));
  field.values(requests, labels, values);
  expect_time(-1.0);
  // A point without one is seen at the document's instant.
  field.labels(std::vector<sampling::FocalPoint>{{11.0, 4.0}, {16.0, 4.0}}, labels);
  expect_time(0.0);
}

// Ground below half a roof, under a Sun 60 times as wide as ours: lit, in the penumbra, and in the shadow.
struct HalfARoof {
  test::SmallScene scene;
  sensor::OrthographicCamera::Settings settings;
  std::unique_ptr<sensor::OrthographicCamera> camera;
  std::unique_ptr<render::SceneField> field;
  std::vector<sampling::Label> of_places = std::vector<sampling::Label>(3);  // lit, penumbra, shaded
  const std::vector<sampling::FocalPoint> places{{1.0, 10.0}, {10.2, 10.0}, {17.0, 10.0}};

  HalfARoof() {
    scene.place(geometry::Plane{}, scene.material(0.3));
    scene.place(
        geometry::Polygon{{{0.0, -90.0, 10.0}, {90.0, -90.0, 10.0}, {90.0, 90.0, 10.0}, {0.0, 90.0, 10.0}}},
        scene.material(0.0));
    scene.sun({0.0, 0.0, 1.0}, 1000.0, 0.3);
    settings.width_px = settings.height_px = 20;
    settings.start_height_m = 5.0;
    camera = std::make_unique<sensor::OrthographicCamera>(settings);
    field = std::make_unique<render::SceneField>(scene.build(), *camera, transport::TransportOptions{},
                                                 render::LabelDetail::sun_state);
    field->labels(places, of_places);
  }
};

// Of a point that is taken to be lit, or shaded, the path's own ray to the Sun tells that it is; where it says otherwise, rays to all
// of the disc tell what it is. Values are the same whatever is expected.
TEST(SceneField, AsksAllOfTheSunsDiscOnlyWhereAPathDoesNotTell) {
  HalfARoof ground;
  const sampling::Label lit = ground.of_places[0], penumbra = ground.of_places[1],
                        shaded = ground.of_places[2];
  ASSERT_NE(lit, penumbra);
  ASSERT_NE(shaded, penumbra);
  ASSERT_NE(lit, shaded);
  const std::size_t stride = static_cast<std::size_t>(ground.field->stride());
  std::vector<sampling::PathRequest> requests;
  for (std::uint32_t k = 0; k < 300; ++k) requests.push_back({ground.places[k % 3], 7, k});
  std::vector<sampling::Label> labels(requests.size()), told(requests.size());
  std::vector<float> values(requests.size() * stride), same(values.size());
  std::uint64_t before = ground.field->counts().shadow;
  ground.field->values(requests, labels, values);
  const std::uint64_t all = ground.field->counts().shadow - before;
  for (const sampling::Label expected : {lit, shaded, penumbra, lit ^ (sampling::Label{1} << 3)}) {
    before = ground.field->counts().shadow;
    ground.field->values_expecting(requests, std::vector<sampling::Label>(requests.size(), expected), told,
                                   same);
    const std::uint64_t rays = ground.field->counts().shadow - before;
    EXPECT_EQ(same, values);
    int like = 0;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const bool sees = values[k * stride] > 0.0f, wanted = expected == lit ? sees : !sees;
      const bool by_path = (expected == lit || expected == shaded) && wanted;
      EXPECT_EQ(told[k], by_path ? expected : labels[k]) << k;
      like += by_path;
    }
    EXPECT_EQ(all - rays, 3u * static_cast<unsigned>(like));
    EXPECT_GT(like, expected == lit || expected == shaded ? 110 : -1);
  }
}

}  // namespace
}  // namespace ifov::test_scene_field
