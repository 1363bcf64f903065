#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "materials/draped_map.h"
#include "materials/mixture_map.h"
#include "materials/relief_map.h"

namespace ifov::materials::test_maps {
namespace {

MapGrid grid(int width, int height, Tiling tiling = Tiling::edge) {
  return {10.0, 50.0, 2.0, 5.0, width, height, tiling, MapBy::position};
}

template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MapGrid, ACellHoldsItsWestAndNorthEdges) {
  const ClassMap map(grid(3, 2), {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(map.at(10.0, 50.0), 0);
  EXPECT_EQ(map.at(std::nextafter(12.0, 0.0), 50.0), 0);
  EXPECT_EQ(map.at(12.0, 50.0), 1);
  EXPECT_EQ(map.at(14.0, 45.0), 5);
  EXPECT_EQ(map.at(14.0, std::nextafter(45.0, 100.0)), 2);
}

TEST(MapGrid, FarFromTheOriginEdgesStayWhereTheyAre) {
  MapGrid far = grid(3, 1);
  far.west_m = 4.0e6;
  far.cell_width_m = 0.125;
  const ClassMap map(far, {0, 1, 2});
  EXPECT_EQ(map.at(4.0e6 + 0.125, 49.0), 1);
  EXPECT_EQ(map.at(std::nextafter(4.0e6 + 0.125, 0.0), 49.0), 0);
  EXPECT_EQ(map.at(1e300, 49.0), 2);
  EXPECT_EQ(map.at(-1e300, 49.0), 0);
}

TEST(MapGrid, TilesRepeatAndMirror) {
  const std::vector<std::uint16_t> classes{0, 1, 2};
  const ClassMap edge(grid(3, 1), classes), repeat(grid(3, 1, Tiling::repeat), classes),
      mirror(grid(3, 1, Tiling::mirror), classes);
  const int repeated[] = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2},
            mirrored[] = {0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0};
  for (int k = -6; k < 6; ++k) {
    const double x = 10.0 + 2.0 * k + 1.0;
    EXPECT_EQ(edge.at(x, 49.0), k < 0 ? 0 : std::min(k, 2));
    EXPECT_EQ(repeat.at(x, 49.0), repeated[k + 6]) << k;
    EXPECT_EQ(mirror.at(x, 49.0), mirrored[k + 6]) << k;
    EXPECT_EQ(repeat.at(x + 6e9, 49.0), repeated[k + 6]);
  }
  EXPECT_EQ(repeat.at(std::nextafter(10.0, 0.0), 49.0), 2);
  EXPECT_EQ(mirror.at(std::nextafter(10.0, 0.0), 49.0), 0);
}

TEST(MapGrid, TextureCoordinatesRiseTowardsTheFirstRow) {
  MapGrid by_texture{0.0, 1.0, 0.5, 0.5, 2, 2, Tiling::repeat, MapBy::texture_coordinates};
  const ClassMap map(by_texture, {0, 1, 2, 3});
  EXPECT_EQ(map.at(MapPosition{1e6, 1e6, 0.1, 0.9}), 0);
  EXPECT_EQ(map.at(MapPosition{0, 0, 0.6, 0.9}), 1);
  EXPECT_EQ(map.at(MapPosition{0, 0, 0.1, 0.1}), 2);
  EXPECT_EQ(map.at(MapPosition{0, 0, 1.6, -0.9}), 3);
}

TEST(TemperatureMap, BilinearBetweenTheMiddlesOfCells) {
  const std::vector<float> values{280.0f, 290.0f, 300.0f, 330.0f};
  const TemperatureMap edge(grid(2, 2), values), repeat(grid(2, 2, Tiling::repeat), values);
  EXPECT_DOUBLE_EQ(edge.at_k(11.0, 47.5), 280.0);
  EXPECT_DOUBLE_EQ(edge.at_k(12.0, 45.0), 300.0);
  EXPECT_DOUBLE_EQ(edge.at_k(11.5, 47.5), 282.5);
  EXPECT_DOUBLE_EQ(edge.at_k(0.0, 100.0), 280.0);
  EXPECT_DOUBLE_EQ(repeat.at_k(10.0, 47.5), 285.0);
}

TEST(MixtureMap, FractionsAreMadeToSumToOneAndItIsSaid) {
  // Bands of 2 x 1 cells: the first sums to 1, the second to 200 (percent by twice).
  const std::vector<float> shares{0.25f, 50.0f, 0.75f, 150.0f};
  const MixtureMap map(grid(2, 1), 2, shares);
  const auto first = map.at({11.0, 48.0}), second = map.at({13.0, 48.0});
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].index, 1);
  EXPECT_FLOAT_EQ(first[0].share, 0.75f);
  EXPECT_FLOAT_EQ(second[0].share, 0.75f);
  EXPECT_FLOAT_EQ(second[1].share, 0.25f);
  EXPECT_EQ(map.report().rescaled, 1u);
  EXPECT_DOUBLE_EQ(map.report().highest_sum, 200.0);
  EXPECT_DOUBLE_EQ(map.report().lowest_sum, 200.0);
  EXPECT_EQ(map.report().shortened, 0u);
}

TEST(MixtureMap, TheFourLargestStay) {
  const std::vector<float> shares{0.3f, 0.1f, 0.05f, 0.25f, 0.2f, 0.1f, 0.0f};
  const MixtureMap map(grid(1, 1), 7, shares);
  const auto parts = map.at({11.0, 48.0});
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].index, 0);
  EXPECT_EQ(parts[1].index, 3);
  EXPECT_EQ(parts[2].index, 4);
  EXPECT_EQ(parts[3].index, 1);
  double sum = 0.0;
  for (const auto& part : parts) sum += static_cast<double>(part.share);
  EXPECT_NEAR(sum, 1.0, 1e-6);
  EXPECT_NEAR(static_cast<double>(parts[0].share), 0.3 / 0.85, 1e-6);
  EXPECT_EQ(map.report().shortened, 1u);
  EXPECT_NEAR(map.report().largest_loss, 0.15, 1e-6);
}

TEST(MixtureMap, BadFractionsNameTheirCell) {
  EXPECT_EQ(error_of([] {
              MixtureMap(grid(2, 1), 2, std::vector<float>{0.5f, 1.0f, 0.5f, -0.1f});
            }),
            "the fractions at row 1, column 2 include -0.1 (band 2); they must be numbers from 0 on");
  EXPECT_EQ(error_of([] {
              MixtureMap(grid(1, 2), 2, std::vector<float>{1.0f, 0.0f, 0.0f, 0.0f});
            }),
            "the fractions at row 2, column 1 are all 0");
}

TEST(ReliefMap, APlaneOfHeightsTiltsByItsSlope) {
  // 0.1 m per metre to the east, 0.2 to the north; cells of 2 m x 5 m.
  std::vector<float> height;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      height.push_back(static_cast<float>(0.1 * 2.0 * column - 0.2 * 5.0 * row));
  const ReliefMap map = ReliefMap::from_heights(grid(4, 4), height);
  const math::Vec3 found = map.tilted({0.0, 0.0, 1.0}, {14.3, 41.0}).as_vector();
  EXPECT_NEAR(math::length(found - math::normalized({-0.1, -0.2, 1.0})), 0.0, 1e-6);
  // On a slope of its own, slopes add.
  const math::Normal3 slope = math::as_normal(math::normalized({-0.3, 0.0, 1.0}));
  const math::Vec3 added = map.tilted(slope, {14.3, 41.0}).as_vector();
  EXPECT_NEAR(math::length(added - math::normalized({-0.4, -0.2, 1.0})), 0.0, 1e-6);
  EXPECT_EQ(map.tilted({1.0, 0.0, 0.0}, {14.3, 41.0}), (math::Normal3{1.0, 0.0, 0.0}));
}

TEST(ReliefMap, NormalsAreThoseOfTheMap) {
  const ReliefMap map = ReliefMap::from_normals(grid(1, 1), std::vector<float>{-0.1f, -0.2f, 1.0f});
  const math::Vec3 found = map.tilted({0.0, 0.0, 1.0}, {0.0, 0.0}).as_vector();
  EXPECT_NEAR(math::length(found - math::normalized({-0.1, -0.2, 1.0})), 0.0, 1e-6);
  EXPECT_EQ(error_of([] {
              ReliefMap::from_normals(grid(1, 1), std::vector<float>{0.0f, 0.0f, 0.0f});
            }),
            "the normal in cell 1 is (0, 0, 0); it must point up");
  MapGrid by_texture = grid(1, 1);
  by_texture.by = MapBy::texture_coordinates;
  EXPECT_NE(error_of([&] { ReliefMap::from_heights(by_texture, std::vector<float>{0.0f}); }).find("by place"),
            std::string::npos);
}

}  // namespace
}  // namespace ifov::materials::test_maps
