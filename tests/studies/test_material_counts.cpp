#include <gtest/gtest.h>

#include <cmath>

#include "studies/common/material_counts.h"

namespace ifov::studies::test_material_counts {
namespace {

struct Found {
  std::uint32_t pixel, material;
  float fraction, half_width;
};

/// Two pixels side by side.
void fill(ImageStore& image, std::initializer_list<Found> found) {
  render::ImageInfo info;
  info.width_px = 2;
  info.height_px = 1;
  info.channels = {{"a", 0.5, 0.01}};
  image.begin(info);
  sampling::TileResult tile;
  tile.reset({0, 0, 2, 1}, 1);
  for (const Found& f : found) tile.abundances.push_back({f.pixel, f.material, f.fraction, f.half_width});
  image.write(tile);
}

TEST(MaterialCounts, CountsFromAThousandthOfAPixel) {
  ImageStore image;
  fill(image,
       {{0, 0, 0.9995f, 0}, {0, 1, 0.0005f, 0}, {1, 0, 0.5f, 0}, {1, 2, 0.499f, 0}, {1, 3, 0.001f, 0}});
  const MaterialCounts counts = count_materials(image);
  EXPECT_DOUBLE_EQ(counts.counted, 2.0);  // 1 and 3
  EXPECT_DOUBLE_EQ(counts.raw, 2.5);
}

TEST(MaterialCounts, AbundancesAgainstAReference) {
  ImageStore truth, image;
  fill(truth, {{0, 0, 0.75f, 0}, {0, 1, 0.25f, 0}, {1, 0, 1.0f, 0}});
  fill(image, {{0, 0, 0.70f, 0.06f}, {0, 2, 0.30f, 0.06f}, {1, 0, 1.0f, 0.0f}});
  const AbundanceErrors errors = compare_abundances(image, truth, 0.0);
  // Pixel 0: 0.05, 0.25 of the missed material, 0.3 of the one that is not there.
  EXPECT_NEAR(errors.rms, std::sqrt((0.05 * 0.05 + 0.25 * 0.25 + 0.3 * 0.3) / 2.0), 1e-7);
  EXPECT_NEAR(errors.largest, 0.3, 1e-7);
  EXPECT_DOUBLE_EQ(errors.missed, 0.5);
  EXPECT_NEAR(errors.coverage, 1.0 / 3.0, 1e-12);
}

TEST(MaterialCounts, ThatTheImageKnowsItselfIsNoError) {
  ImageStore truth;
  fill(truth, {{0, 0, 0.75f, 0}, {0, 1, 0.25f, 0}, {1, 0, 1.0f, 0}});
  const AbundanceErrors errors = compare_abundances(truth, truth, 0.0);
  EXPECT_EQ(errors.rms, 0.0);
  EXPECT_EQ(errors.missed, 0.0);
  EXPECT_EQ(errors.coverage, 1.0);
}

}  // namespace
}  // namespace ifov::studies::test_material_counts
