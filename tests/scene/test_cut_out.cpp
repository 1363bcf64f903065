// Holes of surfaces by maps, and by the materials that a map of classes names.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/error.h"
#include "materials/draped_map.h"
#include "materials/opacity_map.h"
#include "scene/cut_out.h"
#include "scene/scene.h"

namespace ifov::scene::test_cut_out {
namespace {

materials::MapGrid grid(int width, int height, materials::MapBy by = materials::MapBy::position) {
  materials::MapGrid grid;
  grid.width = width, grid.height = height;
  grid.north_m = height;
  grid.by = by;
  return grid;
}

TEST(OpacityMap, CellsAreThereOrNot) {
  const materials::OpacityMap map(grid(2, 2), {true, false, false, false});
  EXPECT_TRUE(map.is_open({0.5, 1.5}));
  EXPECT_FALSE(map.is_open({1.5, 1.5}));
  EXPECT_FALSE(map.is_open({0.5, 0.5}));
  EXPECT_EQ(map.open_share(), 0.25);
  EXPECT_THROW(materials::OpacityMap(grid(2, 2), {true}), InputError);
}

TEST(SurfaceCutOut, HolesAreThoseOfTheMaterialThere) {
  const auto holes = std::make_shared<const materials::OpacityMap>(grid(1, 1), std::vector<bool>{true});
  const auto classes =
      std::make_shared<const materials::ClassMap>(grid(2, 1), std::vector<std::uint16_t>{0, 1});
  const SurfaceCutOut alone(nullptr, {holes}), one_of_two(classes, {nullptr, holes});
  EXPECT_TRUE(alone.is_open({0.5, 0.5, 0.0}, 0.0, 0.0));
  EXPECT_FALSE(one_of_two.is_open({0.5, 0.5, 0.0}, 0.0, 0.0));
  EXPECT_TRUE(one_of_two.is_open({1.5, 0.5, 0.0}, 0.0, 0.0));
  EXPECT_EQ(one_of_two.grid().width, 1);
  EXPECT_THROW(SurfaceCutOut(nullptr, {nullptr}), InputError);
}

TEST(SurfaceCutOut, MayGoByTextureCoordinates) {
  const auto holes = std::make_shared<const materials::OpacityMap>(
      grid(2, 1, materials::MapBy::texture_coordinates), std::vector<bool>{true, false});
  const SurfaceCutOut cut_out(nullptr, {holes});
  EXPECT_TRUE(cut_out.is_open({1.5, 0.5, 0.0}, 0.5, 0.5));
  EXPECT_FALSE(cut_out.is_open({0.5, 0.5, 0.0}, 1.5, 0.5));
}

TEST(SurfaceCutOut, AreAskedForOnlyWhereThereAreAny) {
  Scene scene;
  scene.assignments.resize(2);
  EXPECT_TRUE(cut_outs(scene).empty());
  scene.assignments[1].cut_out = std::make_shared<const SurfaceCutOut>(
      nullptr, std::vector<std::shared_ptr<const materials::OpacityMap>>{
                   std::make_shared<const materials::OpacityMap>(grid(1, 1), std::vector<bool>{true})});
  ASSERT_EQ(cut_outs(scene).size(), 2u);
  EXPECT_EQ(cut_outs(scene)[0], nullptr);
  EXPECT_EQ(cut_outs(scene)[1], scene.assignments[1].cut_out);
}

}  // namespace
}  // namespace ifov::scene::test_cut_out
