#include <gtest/gtest.h>

#include <vector>

#include "materials/bsdf/mirror.h"
#include "render/scene_field.h"
#include "sensor/orthographic_camera.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov {
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

}  // namespace
}  // namespace ifov
