#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "sampling/random_placement.h"
#include "support/statistics.h"

namespace ifov::sampling::test_random_placement {
namespace {

/// Smallest distance of two places, all pairs.
double nearest_m(const std::vector<RandomPosition>& positions) {
  double nearest = 1e300;
  for (std::size_t a = 0; a < positions.size(); ++a)
    for (std::size_t b = a + 1; b < positions.size(); ++b)
      nearest = std::min(nearest, std::hypot(positions[a].at_m.x - positions[b].at_m.x,
                                             positions[a].at_m.y - positions[b].at_m.y));
  return nearest;
}

double count_within(const std::vector<RandomPosition>& positions, const PlacementArea& area) {
  return static_cast<double>(std::count_if(positions.begin(), positions.end(),
                                           [&](const auto& position) { return area.holds(position.at_m); }));
}

/// Whether a count is that of a density to within 3 standard errors of independent places (those that keep a
/// distance scatter less) and the 1.7 % that the formula for proposals is true to.
bool agrees(double count, double expected) {
  return std::abs(count - expected) < 3.0 * std::sqrt(expected) + 0.017 * expected;
}

TEST(RandomPlacement, ReachesItsDensity) {
  const PlacementArea area{-130.0, 40.0, 370.0, 540.0};
  for (const double share : {0.1, 0.4, 0.7, 0.9, 1.0}) {
    const double density_m2 = share * largest_placement_density(1.5);
    const auto positions = random_positions({area, 1.5, density_m2, {}, 11});
    EXPECT_TRUE(agrees(static_cast<double>(positions.size()), density_m2 * area.square_metres()))
        << share << ": " << static_cast<double>(positions.size()) / (density_m2 * area.square_metres());
    EXPECT_FALSE(agrees(static_cast<double>(positions.size()), 1.1 * density_m2 * area.square_metres()));
  }
}

TEST(RandomPlacement, IsAsDenseAtItsEdges) {
  // Strips a minimum distance wide: nothing beyond them would let more stand there.
  const double density_m2 = 0.9 * largest_placement_density(2.0);
  const auto positions = random_positions({{0.0, 0.0, 8000.0, 20.0}, 2.0, density_m2, {}, 5});
  EXPECT_TRUE(agrees(count_within(positions, {0.0, 0.0, 8000.0, 1.0}), 8000.0 * density_m2));
  EXPECT_TRUE(agrees(count_within(positions, {0.0, 19.0, 8000.0, 20.0}), 8000.0 * density_m2));
}

TEST(RandomPlacement, KeepsTheMinimumDistance) {
  const double density_m2 = largest_placement_density(3.0);
  const auto positions = random_positions({{-50.0, -50.0, 50.0, 50.0}, 3.0, density_m2, {}, 3});
  EXPECT_GT(positions.size(), 600u);
  EXPECT_GE(nearest_m(positions), 3.0);
  EXPECT_LT(nearest_m(positions), 3.05);
  // Places that know nothing of each other do come nearer.
  EXPECT_LT(nearest_m(random_positions({{-50.0, -50.0, 50.0, 50.0}, 0.0, density_m2, {}, 3})), 0.5);
}

class PlacementByMap : public testing::TestWithParam<double> {};

TEST_P(PlacementByMap, FollowsTheMap) {
  constexpr int kSide = 8;
  constexpr double kCell_m = 50.0, kPeak_m2 = 0.06;
  const auto factor = [](int column, int row) { return ((3 * column + 5 * row) % 8) / 7.0; };
  const auto density = [&](Point2 p) {
    return kPeak_m2 * factor(static_cast<int>(p.x / kCell_m), static_cast<int>(p.y / kCell_m));
  };
  const auto positions =
      random_positions({{0.0, 0.0, kSide * kCell_m, kSide * kCell_m}, GetParam(), kPeak_m2, density, 21});
  std::vector<double> observed(kSide * kSide, 0.0), expected, wrong;
  for (const auto& position : positions)
    observed[static_cast<std::size_t>(static_cast<int>(position.at_m.y / kCell_m) * kSide +
                                      static_cast<int>(position.at_m.x / kCell_m))] += 1.0;
  double sum = 0.0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      expected.push_back(factor(column, row));
      wrong.push_back(0.8 * factor(column, row) + 0.1);  // a map that is a little flatter
      sum += factor(column, row);
    }
  const auto count = static_cast<double>(positions.size());
  EXPECT_TRUE(agrees(count, kPeak_m2 * kCell_m * kCell_m * sum)) << count;
  double wrong_sum = 0.0;
  for (const double w : wrong) wrong_sum += w;
  for (double& e : expected) e *= count / sum;
  for (double& w : wrong) w *= count / wrong_sum;
  EXPECT_GT(test::chi_square_test(observed, expected), 1e-3);
  EXPECT_LT(test::chi_square_test(observed, wrong), 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Distances, PlacementByMap, testing::Values(0.0, 1.0, 2.5, 3.2));

TEST(RandomPlacement, IsUniformWithinItsCells) {
  // Where within a cell of the minimum distance places come to stand shows no trace of the cell.
  const auto positions =
      random_positions({{0.0, 0.0, 400.0, 400.0}, 2.0, 0.1, [](Point2) { return 0.05; }, 8});
  std::vector<double> observed(64, 0.0);
  for (const auto& position : positions) {
    const auto part = [](double v) { return static_cast<int>((v / 2.0 - std::floor(v / 2.0)) * 8.0); };
    observed[static_cast<std::size_t>(part(position.at_m.y) * 8 + part(position.at_m.x))] += 1.0;
  }
  const auto count = static_cast<double>(positions.size());
  EXPECT_GT(count, 7000.0);
  EXPECT_GT(test::chi_square_test(observed, std::vector<double>(64, count / 64.0)), 1e-3);
}

TEST(RandomPlacement, DependsOnItsSeedAndOnNothingElse) {
  const PlacementArea small{-20.0, -30.0, 40.0, 30.0};
  const auto at = [&](std::uint64_t seed, const PlacementArea& area) {
    std::vector<std::pair<double, double>> list;
    for (const auto& position : random_positions({area, 1.0, 0.5, {}, seed}))
      if (position.at_m.x > -10.0 && position.at_m.x < 30.0 && std::abs(position.at_m.y) < 20.0)
        list.emplace_back(position.at_m.x, position.at_m.y);
    std::sort(list.begin(), list.end());
    return list;
  };
  EXPECT_EQ(at(1, small), at(1, small));
  EXPECT_EQ(at(1, small), at(1, {-97.3, -61.8, 88.1, 70.4}));
  const auto one = at(1, small), other = at(2, small);
  std::vector<std::pair<double, double>> both;
  std::set_intersection(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(both));
  EXPECT_GT(one.size(), 600u);
  EXPECT_TRUE(both.empty());
}

TEST(RandomPlacement, StopsAtTheLargestDensity) {
  const PlacementArea area{0.0, 0.0, 100.0, 100.0};
  const auto full = random_positions({area, 1.0, 5.0, {}, 4});
  EXPECT_TRUE(agrees(static_cast<double>(full.size()), 1e4 * largest_placement_density(1.0))) << full.size();
  EXPECT_NEAR(largest_placement_density(1.0), 0.6268, 1e-4);
  EXPECT_TRUE(random_positions({area, 1.0, 0.0, {}, 4}).empty());
}

TEST(RandomPlacement, RefusesWhatIsTooMuch) {
  try {
    random_positions({{0.0, 0.0, 1e5, 1e5}, 0.0, 1.0, {}, 4});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "1e+10 places on 1e+10 m2 take 1e+10 proposals, more than the 3.36e+07 that are possible; "
                 "use several "
                 "smaller areas, or a lower density");
  }
}

}  // namespace
}  // namespace ifov::sampling::test_random_placement
