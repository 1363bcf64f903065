#include <gtest/gtest.h>

#include <cmath>

#include "accuracy_scenes.h"
#include "sampling/accuracy/detection.h"
#include "sampling/random.h"

namespace ifov::sampling::test_detection {
namespace {

/// Share of features, squares or discs of the given area anywhere in the middle of 3 x 3 pixels, that jittered grids meet.
double share_found(const std::vector<GridSides>& grids, double area, bool disc, bool with_lattice) {
  constexpr int kFeatures = 10000;
  const double half = disc ? std::sqrt(area / 3.14159265358979) : 0.5 * std::sqrt(area);
  int found = 0;
  for (int k = 0; k < kFeatures; ++k) {
    test::Draw draw(static_cast<std::uint64_t>(k) + 900000);
    const double cx = 1.0 + draw(), cy = 1.0 + draw();
    const auto met = [&](double x, double y) {
      return disc ? (x - cx) * (x - cx) + (y - cy) * (y - cy) < half * half
                  : std::abs(x - cx) < half && std::abs(y - cy) < half;
    };
    bool hit = false;
    for (const auto [columns, rows] : grids)
      for (int j = 0; j < 3 * rows; ++j)
        for (int i = 0; i < 3 * columns; ++i) hit = met((i + draw()) / columns, (j + draw()) / rows) || hit;
    if (with_lattice)
      for (int j = 0; j <= 9; ++j)
        for (int i = 0; i <= 9; ++i) hit = hit || met(i / 3.0, j / 3.0);
    found += hit;
  }
  return static_cast<double>(found) / kFeatures;
}

TEST(Detection, FeaturesOfTheStatedSizeAreFoundAsOftenAsStated) {
  Detection detection;
  const GridSides two = GridSides::square(2), three = GridSides::square(3);
  for (const std::vector<GridSides>& grids : {std::vector<GridSides>{two},
                                              {three},
                                              {two, three},
                                              {two, three, three},
                                              {two, three, {8, 8}},
                                              {{6, 6}},
                                              {{16, 16}},
                                              {{6, 4}},
                                              {{2, 4}, {8, 6}}}) {
    const double area = detection.missable_fraction({grids, 0.0});
    EXPECT_NEAR(share_found(grids, area, false, false), 0.95, 0.01)
        << grids.size() << " " << grids.back().columns << " " << grids.back().rows;
    EXPECT_NEAR(share_found(grids, area, true, false), 0.95, 0.012) << "discs";
  }
}

// Counted as a round of nine random rays, the lattice would promise three times too much.
TEST(Detection, ALatticeTakenForARandomRoundIsCaught) {
  Detection detection;
  const double claimed = detection.missable_fraction({{{2, 2}, {3, 3}}, 0.0});
  EXPECT_LT(share_found({{2, 2}}, claimed, false, false), 0.8);
}

TEST(Detection, MoreRaysFindSmallerThings) {
  Detection detection;
  EXPECT_GT(detection.missable_fraction({{}, 0.0}), 0.99f);
  float before = 1.0f;
  for (const int side : {2, 3, 5, 10, 40}) {
    const float now = detection.missable_fraction({{GridSides::square(side)}, 0.0});
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_NEAR(detection.missable_fraction({{}, 28.0}), 1.0 - std::pow(0.05, 1.0 / 28.0), 1e-3);
}

// The values of a noisy surface stand anywhere in its pixel: what they would meet is counted with the random rays.
TEST(Detection, ValuesCountAsRandomRays) {
  test::ShapeField field{[](double, double) { return Label{0}; },
                         [](Label, double x, double y, int) {
                           return static_cast<float>(unit_double(hash(static_cast<std::uint64_t>(x * 1e9),
                                                                      static_cast<std::uint64_t>(y * 1e9))));
                         }};
  test::Rendering render = test::three_by_three(3);
  render.half_width = 0.05;
  const TileResult result = render(field);
  const double values = result.radiance_evaluations[4];
  ASSERT_GT(values, 100.0);
  Detection detection;
  // All but those of the lattice.
  const RandomRays none{{GridSides::square(render.options.random_rays_per_side)}, 0.0},
      all{none.grids, values}, most{none.grids, 0.9 * values};
  EXPECT_GE(result.missable_fraction[4], detection.missable_fraction(all));
  EXPECT_LE(result.missable_fraction[4], detection.missable_fraction(most));
  EXPECT_LT(detection.missable_fraction(most), 0.1 * detection.missable_fraction(none));
}

}  // namespace
}  // namespace ifov::sampling::test_detection
