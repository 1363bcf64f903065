#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "core/error.h"
#include "io/product_parts/map_info.h"
#include "io/products/image_region.h"
#include "io/products/region_means.h"
#include "io/synthetic_image.h"
#include "sampling/intervals/bounded_error.h"

namespace ifov::io::test_region {
namespace {

const sampling::BoundedError kJoint(0.95);

using test::ScratchFolder;
using test::SyntheticImage;

ImageRegion::Image image_of(int width, int height) { return {width, height, std::nullopt}; }

std::vector<std::string> picture(const ImageRegion& region, const ImageRegion::Image& image) {
  std::vector<std::string> lines;
  std::vector<std::uint8_t> inside;
  for (int y = 0; y < image.height_px; ++y) {
    std::string& line = lines.emplace_back(static_cast<std::size_t>(image.width_px), '.');
    if (y < region.first_line() || y >= region.end_line()) continue;
    region.select(y, inside);
    for (std::size_t x = 0; x < inside.size(); ++x)
      if (inside[x] != 0) line[x] = '#';
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(ImageRegion, RectanglesEndBeforeTheirLastPixel) {
  const auto image = image_of(6, 4);
  EXPECT_EQ(picture(ImageRegion::parse("1,1,4,3", image), image),
            (Lines{"......", ".###..", ".###..", "......"}));
  EXPECT_EQ(picture(ImageRegion::parse("4,3,1,1", image), image),
            (Lines{"......", ".###..", ".###..", "......"}));
  EXPECT_EQ(picture(ImageRegion::parse(" -5, -5, 99, 1 ", image), image),
            (Lines{"######", "......", "......", "......"}));
}

TEST(ImageRegion, PolygonsHoldThePixelsWhoseCentresLieInside) {
  const auto image = image_of(6, 4);
  EXPECT_EQ(picture(ImageRegion::parse("0,0,4,0,0,4", image), image),
            (Lines{"###...", "##....", "#.....", "......"}));
  EXPECT_EQ(picture(ImageRegion::parse("0,0,6,0,6,4,4,4,4,2,2,2,2,4,0,4", image), image),
            (Lines{"######", "######", "##..##", "##..##"}));
}

TEST(ImageRegion, MapCoordinatesOfATurnedImage) {
  SyntheticImage made{6, 4, 1};
  render::ImageInfo info = made.info();
  info.map_rotation_rad = std::acos(-1.0) / 2.0;
  auto image = image_of(6, 4);
  image.map = geotransform(info);
  // Image (1, 1) to (4, 3) on the map.
  const auto& g = *image.map;
  const auto at = [&](double x, double y) {
    return format("{:.6f},{:.6f}", g[0] + x * g[1] + y * g[2], g[3] + x * g[4] + y * g[5]);
  };
  EXPECT_EQ(picture(ImageRegion::parse("map:" + at(1, 1) + "," + at(4, 3), image), image),
            (Lines{"......", ".###..", ".###..", "......"}));
}

std::string error_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImageRegion, SaysWhatIsWrong) {
  const auto error = [](const std::string& text) {
    return error_of([&] { ImageRegion::parse(text, image_of(6, 4)); });
  };
  const std::string expected =
      "expected x0,y0,x1,y1 (a rectangle), x,y of three corners or more, both in pixels or after 'map:' in map coordinates, "
      "or mask:FILE";
  EXPECT_EQ(error("1,2,x,4"), "region '1,2,x,4': 'x' is no number; " + expected);
  EXPECT_EQ(error("1,2,3"), "region '1,2,3': found 3 numbers; " + expected);
  EXPECT_EQ(error("6,0,9,4"), "region '6,0,9,4': no pixel's centre lies in it");
  EXPECT_EQ(error("map:1,2,3,4"), "region 'map:1,2,3,4': the image has no map coordinates; expected pixels");
}

/// A run whose pixels have the synthetic image's values.
class MeansOfAProduct : public testing::Test {
 protected:
  MeansOfAProduct() {
    ProductOptions options;
    options.folder = folder_.path();
    options.name = "demo";
    ProductWriter writer(options, image_.identity());
    writer.begin(image_.info());
    for (const auto& tile : image_.tiles(16)) writer.write(image_.tile(tile));
    writer.finish(image_.outcome());
  }
  ScratchFolder folder_{"region"};
  SyntheticImage image_{20, 12, 3};
};

TEST_F(MeansOfAProduct, AreThoseOfThePixels) {
  const auto rule = sampling::RegionRule::of_accuracy(1.0);
  const RegionMeans region =
      region_means(folder_.path() / "demo", ImageRegion::parse("3,2,9,7", image_of(20, 12)), rule, kJoint);
  std::uint64_t converged = 0;
  sampling::RegionSum sum;
  for (int y = 2; y < 7; ++y)
    for (int x = 3; x < 9; ++x) {
      converged += image_.reasons(x, y) == 0;
      sum.add(image_.radiance(x, y, 1), image_.half_width(x, y, 1), 0.75f);
    }
  EXPECT_EQ(region.pixels, 30u);
  EXPECT_EQ(region.converged, converged);
  EXPECT_EQ(region.reasons[static_cast<std::size_t>(sampling::Reason::samples)], 30 - converged);
  ASSERT_EQ(region.channels.size(), 3u);
  EXPECT_NEAR(region.channels[1].mean, sum.mean(), 1e-5);
  EXPECT_NEAR(region.channels[1].half_width, sum.half_width(rule, kJoint), 1e-6);
}

TEST_F(MeansOfAProduct, AMaskMarksItsPixels) {
  // The class raster of the same run serves as one: what is not converged.
  const auto region =
      ImageRegion::parse("mask:" + (folder_.path() / "demo_quality_class.img").string(), image_of(20, 12));
  const RegionMeans means =
      region_means(folder_.path() / "demo", region, sampling::RegionRule::all_common(), kJoint);
  EXPECT_GT(means.pixels, 0u);
  EXPECT_EQ(means.converged, 0u);
  EXPECT_NE(error_of([&] {
              ImageRegion::parse("mask:" + (folder_.path() / "demo_quality_class.img").string(),
                                 image_of(21, 12));
            }).find("the mask has 20 x 12 pixels, expected the image's 21 x 12"),
            std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_region
