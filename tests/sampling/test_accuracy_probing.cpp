// Where random rays meet something that the lattice did not announce, more like it may lie beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "accuracy_scenes.h"
#include "sampling/hash.h"

namespace ifov::test::test_accuracy_probing {
namespace {

using namespace sampling;

/// A small disc amid a cell of the lattice, in the middle pixel of 7 x 7: whenever a look meets it, all eight pixels around
/// are probed, and none farther off.
TEST(AccuracyProbing, ASurprisingFindIsProbedAroundOnAllSides) {
  constexpr int kSide = 7, kMiddle = 3;
  const DiscScene disc{kMiddle + 0.5, kMiddle + 0.5, 0.13};
  int found = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    ShapeField field = disc.field();
    Rendering render = three_by_three(seed);
    render.tile = render.image = {0, 0, kSide, kSide};
    const TileResult result = render(field);
    const std::uint32_t far = result.label_rays[0];
    if (!(result.half_width[kMiddle * kSide + kMiddle] > 0.0f)) continue;  // no random ray met it
    ++found;
    const int least = render.options.probes_per_side * render.options.probes_per_side;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int away = std::max(std::abs(x - kMiddle), std::abs(y - kMiddle));
        const std::uint32_t rays = result.label_rays[static_cast<std::size_t>(y * kSide + x)];
        if (away == 1) {
          EXPECT_GE(rays, far + static_cast<std::uint32_t>(least))
              << "pixel " << x << ", " << y << " of seed " << seed;
        }
        if (away > 1) {
          EXPECT_EQ(rays, far) << "pixel " << x << ", " << y << " of seed " << seed;
        }
      }
  }
  EXPECT_GE(found, 5);
  EXPECT_LE(found, 40);
}

// Two surfaces that look alike, and a hot gap between them that runs between two columns of the lattice: the border of
// the two matters to nobody, and yet the gap is found whatever the seed.
TEST(AccuracyProbing, AGapBetweenTwoThatLookAlikeIsFound) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Draw draw(seed);
    const double left = 1.36 + 0.2 * draw(), width = 0.03;
    ShapeField field([=](double x, double) -> Label { return x < left           ? 1
                                                             : x < left + width ? 2
                                                                                : 3; },
                     [](Label l, double, double, int) { return static_cast<float>(l == 2 ? kHot : kCold); });
    Rendering render = three_by_three(seed);
    render.options.clutter_switch = false;
    const TileResult result = render(field);
    for (const std::size_t p : {1, 4, 7})
      EXPECT_NEAR(result.mean[p], kCold + (kHot - kCold) * width, 0.1 * kRadiancePerKelvin)
          << p << " of seed " << seed;
  }
}

/// Of 120 pixels that a hot gap crosses: those whose intervals hold. It lies `beside` px left of where two surfaces meet that
/// differ by 0.3 K and have some grain, too little for their border to be traced in place of stratified values.
int held_with_gap(double beside) {
  int held = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Draw draw(seed);
    const double border = 1.40 + 0.2 * draw(), slope = 0.1 * (draw() - 0.5), width = 0.025;
    ShapeField field(
        [=](double x, double y) -> Label {
          const double left = border + slope * (y - 1.5);
          return x >= left ? 3 : x < left - beside && x > left - beside - width ? 2 : 1;
        },
        [](Label l, double x, double y, int) {
          const double grain =
              unit_double(hash(static_cast<std::uint64_t>(1e9 * x), static_cast<std::uint64_t>(1e9 * y)));
          return static_cast<float>(
              l == 2 ? kHot : kCold + ((l == 3 ? 0.3 : 0.0) + 0.2 * grain) * kRadiancePerKelvin);
        });
    Rendering render = three_by_three(seed);
    const TileResult result = render(field);
    for (int y = 0; y < 3; ++y) {
      const std::size_t p = static_cast<std::size_t>(3 * y + 1);
      const double right = 2.0 - border - slope * (y + 0.5 - 1.5), gap = width;
      const double truth =
          kCold + (0.3 * right + 0.1 * (1.0 - gap)) * kRadiancePerKelvin + (kHot - kCold) * gap;
      held += std::abs(result.mean[p] - truth) <= result.half_width[p];
    }
  }
  return held;
}

// Few values would do for such a border, and overlook what lies along it.
TEST(AccuracyProbing, AGapIsFoundWhereFewValuesWouldDo) {
  EXPECT_GE(held_with_gap(0.0), 114);
  EXPECT_LT(held_with_gap(0.1), 100);  // planted fault: nothing tells that there is one
}

// A slanted hot strip meets the lattice once on the left and once on the right of three pixels, where a chessboard makes
// clutter of them. In the pixel between, which is traced, the lattice and most seeds' looks miss it.
TEST(AccuracyProbing, WhatCrossesAPixelBetweenTwoOfClutterIsFound) {
  constexpr double kHalfHeight = 0.02, kSquare = 1.0 / 48.0;
  const auto strip = [](double x, double y) { return std::abs(y - 1.25 - 0.125 * (x - 0.5)) < kHalfHeight; };
  const auto chess = [](double x, double y) {
    const bool there = y > 1.55 && y < 1.95 && (x < 0.95 || x > 2.05);
    return there && (static_cast<int>(x / kSquare) + static_cast<int>(y / kSquare)) % 2 == 0;
  };
  int clutter = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    ShapeField field([&](double x, double y) -> Label { return strip(x, y)   ? 2
                                                               : chess(x, y) ? 3
                                                                             : 1; },
                     [](Label l, double, double, int) { return static_cast<float>(l == 1 ? kCold : kHot); });
    Rendering render = three_by_three(seed);
    render.options.lattice = 4;
    render.half_width = 0.2 * kRadiancePerKelvin;
    const TileResult result = render(field);
    clutter += result.radiance_evaluations[3] > 1000 && result.radiance_evaluations[5] > 1000 &&
               result.radiance_evaluations[4] < 100;
    EXPECT_NEAR(result.mean[4], kCold + (kHot - kCold) * 2.0 * kHalfHeight, 0.25 * kRadiancePerKelvin)
        << "seed " << seed;
  }
  EXPECT_EQ(clutter, 40);
}

}  // namespace
}  // namespace ifov::test::test_accuracy_probing
