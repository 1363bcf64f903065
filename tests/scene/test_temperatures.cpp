#include <gtest/gtest.h>

#include "scene/map_patterns.h"

namespace test_temperatures {
using namespace ifov;

namespace {

std::shared_ptr<const materials::TemperatureMap> map_of(float low_k, float high_k) {
  return std::make_shared<materials::TemperatureMap>(materials::MapGrid{.width = 2, .height = 1},
                                                     std::vector<float>{low_k, high_k});
}

/// Two materials without a temperature, one surface assignment.
scene::Scene cold_scene() {
  scene::Scene scene;
  scene.materials.resize(3);
  scene.states = {{0, 0.0}, {1, 0.0}};
  scene.assignments.resize(1);
  scene.assignments[0].states = {0};
  scene.surroundings = {2, 0.0};
  return scene;
}

class OnePattern final : public scene::Pattern {
 public:
  void apply(const geometry::SurfacePoint&, scene::ResolvedSurface&) const override {}
  std::vector<std::uint32_t> mixed_materials() const override { return {1}; }
  std::optional<scene::TemperatureRange> temperatures() const override {
    return scene::TemperatureRange{330.0, 350.0};
  }
};

void expect_range(const std::optional<scene::TemperatureRange>& range, double coldest_k, double hottest_k) {
  ASSERT_TRUE(range);
  EXPECT_EQ(range->coldest_k, coldest_k);
  EXPECT_EQ(range->hottest_k, hottest_k);
}

}  // namespace

TEST(SceneTemperatures, ASceneWithoutAnyEmitsNothing) {
  EXPECT_FALSE(cold_scene().temperatures());
  EXPECT_FALSE(cold_scene().mapped_temperatures());
  EXPECT_FALSE(cold_scene().emits(0));
}

TEST(SceneTemperatures, EachPlaceThatHoldsOneIsAsked) {
  scene::Scene scene = cold_scene();
  scene.states[1].temperature_k = 300.0;
  expect_range(scene.temperatures(), 300.0, 300.0);
  EXPECT_FALSE(scene.mapped_temperatures());
  scene.sky.temperature_k = 220.0;
  expect_range(scene.temperatures(), 220.0, 300.0);
  scene.surroundings.temperature_k = 310.0;
  expect_range(scene.temperatures(), 220.0, 310.0);
  scene.assignments[0].temperatures = {map_of(280.0f, 320.0f)};
  expect_range(scene.temperatures(), 220.0, 320.0);
  expect_range(scene.mapped_temperatures(), 280.0, 320.0);
  scene.assignments[0].patterns = {std::make_shared<OnePattern>()};
  expect_range(scene.temperatures(), 220.0, 350.0);
  expect_range(scene.mapped_temperatures(), 280.0, 350.0);
}

TEST(SceneTemperatures, StatesEmitByTheirOwnByMapsAndByPatterns) {
  scene::Scene scene = cold_scene();
  scene.assignments[0].temperatures = {map_of(280.0f, 320.0f)};
  EXPECT_TRUE(scene.emits(0));
  EXPECT_FALSE(scene.emits(1));
  scene.assignments[0].patterns = {std::make_shared<OnePattern>()};
  EXPECT_TRUE(scene.emits(1));
}

/// Samplers look where maps stand out, one map after the other: the order of addresses, which is another in the next run,
/// would make another image.
TEST(SceneMaps, AreInTheOrderGivenWhereverTheyLie) {
  const auto first = map_of(280.0f, 290.0f), second = map_of(300.0f, 310.0f);
  for (const auto& [front, back] : {std::pair(first, second), std::pair(second, first)}) {
    scene::SurfaceAssignment assignment;
    assignment.temperatures = {front, back, front, nullptr};
    assignment.back_temperatures = {back};
    EXPECT_EQ(assignment.maps(), (std::vector<const materials::NumberedMap*>{front.get(), back.get()}));
  }
}

}  // namespace test_temperatures
