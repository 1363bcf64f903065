// Where looks meet something that the lattice did not announce, more like it may lie beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "accuracy_scenes.h"

namespace ifov::test {
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
    if (!(result.half_width[kMiddle * kSide + kMiddle] > 0.0f)) continue;  // no look met it
    ++found;
    const int least = render.options.probes_per_side * render.options.probes_per_side;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int away = std::max(std::abs(x - kMiddle), std::abs(y - kMiddle));
        const std::uint32_t rays = result.label_rays[static_cast<std::size_t>(y * kSide + x)];
        if (away == 1) {
          EXPECT_GE(rays, far + static_cast<std::uint32_t>(least)) << "pixel " << x << ", " << y << " of seed " << seed;
        }
        if (away > 1) {
          EXPECT_EQ(rays, far) << "pixel " << x << ", " << y << " of seed " << seed;
        }
      }
  }
  EXPECT_GE(found, 5);
  EXPECT_LE(found, 40);
}

}  // namespace
}  // namespace ifov::test
