#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "materials/colour_image.h"
#include "radiometry/colour/upsampling.h"

namespace ifov::materials::test_colour_image {
namespace {

constexpr std::uint32_t rgba(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return red | green << 8 | blue << 16 | 0xff000000u;
}

/// How far the corners side by side are from the colour that they stand for, at the worst of many.
double worst_of(const std::array<double, 3>& factor, bool lose_smallest) {
  const ColourLattice lattice(factor);
  double worst = 0.0;
  std::uint32_t random = 1;
  for (int k = 0; k < 2000; ++k) {
    random = random * 1664525u + 1013904223u;
    const std::uint32_t cell = k == 0 ? rgba(0, 0, 0) : k == 1 ? rgba(255, 255, 255) : random;
    const ColourLattice::Mix mix = lattice.mix(cell);
    std::array<double, 3> sum{};
    double shares = 0.0;
    const std::size_t count = lose_smallest && mix.count > 1 ? mix.count - 1 : mix.count;
    for (std::size_t p = 0; p < count; ++p) {
      EXPECT_GT(mix.parts[p].share, 0.0);
      shares += mix.parts[p].share;
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += mix.parts[p].share * ColourLattice::colour(mix.parts[p].corner)[c];
    }
    if (!lose_smallest) {
      EXPECT_NEAR(shares, 1.0, 1e-6);
    }
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(
          worst, std::abs(sum[c] - factor[c] * radiometry::srgb_decoded((cell >> (8 * c) & 255u) / 255.0)));
  }
  return worst;
}

TEST(ColourLattice, CornersSideBySideHaveTheColour) {
  EXPECT_LT(worst_of({1.0, 1.0, 1.0}, false), 1e-6);
  EXPECT_LT(worst_of({0.8, 0.5, 0.03}, false), 1e-6);
  EXPECT_GT(worst_of({1.0, 1.0, 1.0}, true), 1e-3) << "a corner that is lost must be seen";
}

TEST(ColourLattice, SpectraOfCornersMixToTheColourToo) {
  // Light of reflectances side by side adds up: what is seen of the mixture is the picture's colour.
  const ColourLattice lattice({1.0, 1.0, 1.0});
  for (const std::uint32_t cell :
       {rgba(200, 40, 40), rgba(17, 230, 99), rgba(128, 128, 128), rgba(3, 250, 251)}) {
    std::array<double, 3> sum{};
    const ColourLattice::Mix mix = lattice.mix(cell);
    for (std::size_t p = 0; p < mix.count; ++p) {
      const auto seen = radiometry::linear_srgb_of(
          radiometry::upsampled(ColourLattice::colour(mix.parts[p].corner)).spectrum("corner"));
      for (std::size_t c = 0; c < 3; ++c) sum[c] += mix.parts[p].share * seen[c];
    }
    std::array<double, 3> wanted{};
    for (std::size_t c = 0; c < 3; ++c)
      wanted[c] = radiometry::srgb_decoded((cell >> (8 * c) & 255u) / 255.0);
    EXPECT_LT(radiometry::colour_difference(sum, wanted), 1e-3);
  }
}

TEST(ColourImage, RowsAndColumnsMayWrapDifferently) {
  MapGrid grid;
  grid.width = grid.height = 2;
  grid.by = MapBy::texture_coordinates;
  grid.north_m = 1.0;
  grid.cell_width_m = grid.cell_height_m = 0.5;
  grid.tiling = Tiling::repeat;
  grid.tiling_down = Tiling::edge;
  const ColourImage image(grid, {1, 2, 3, 4});
  const auto at = [&](double u, double v) { return image.at({0.0, 0.0, u, v}); };
  EXPECT_EQ(at(0.25, 0.75), 1u);  // v rises to the first row
  EXPECT_EQ(at(0.75, 0.25), 4u);
  EXPECT_EQ(at(1.25, 0.75), 1u);   // repeats along u
  EXPECT_EQ(at(0.25, -1.75), 3u);  // goes on along v
  EXPECT_EQ(at(0.25, 5.0), 1u);
}

}  // namespace
}  // namespace ifov::materials::test_colour_image
