#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/document/product_words.h"
#include "io/envi/colour_map.h"
#include "io/product_parts/picture.h"
#include "io/product_parts/product_headers.h"
#include "io/products/quicklook.h"
#include "io/synthetic_image.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::io::test_products_picture {
namespace {

struct Lab {
  double l, a, b;
};

double linear(std::uint8_t code) {
  const double v = code / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// CIELAB of a linear sRGB colour, white D65 (CIE 15).
Lab cielab(double r, double g, double b) {
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// What an eye without green (or red) cones sees, in linear sRGB (Machado, Oliveira & Fernandes 2009,
/// severity 1).
Lab without_green(double r, double g, double b) {
  return cielab(std::max(0.0, 0.367322 * r + 0.860646 * g - 0.227968 * b),
                std::max(0.0, 0.280085 * r + 0.672501 * g + 0.047413 * b),
                std::max(0.0, -0.011820 * r + 0.042940 * g + 0.968881 * b));
}
Lab without_red(double r, double g, double b) {
  return cielab(std::max(0.0, 0.152286 * r + 1.052583 * g - 0.204868 * b),
                std::max(0.0, 0.114503 * r + 0.786281 * g + 0.099216 * b),
                std::max(0.0, -0.003882 * r - 0.048116 * g + 1.051998 * b));
}

TEST(ColourMap, KeepsItsOrderForEveryEye) {
  for (const ColourMap* map : {&sequential_colours(), &heat_colours()})
    for (const auto see : {cielab, without_green, without_red}) {
      double before = -1.0, first = 0.0;
      for (std::size_t k = 0; k < map->size(); k += 5) {
        const Rgb c = (*map)[k];
        const double lightness = see(linear(c.r), linear(c.g), linear(c.b)).l;
        EXPECT_GT(lightness, before) << k;
        before = lightness;
        if (k == 0) first = lightness;
      }
      EXPECT_GT(before - first, 70.0);
    }
}

TEST(ColourMap, StepsLookAlike) {
  for (const ColourMap* map : {&sequential_colours(), &heat_colours()}) {
    std::vector<double> steps;
    for (std::size_t k = 16; k < map->size(); k += 16) {
      const Rgb p = (*map)[k - 16], q = (*map)[k];
      const Lab a = cielab(linear(p.r), linear(p.g), linear(p.b)),
                b = cielab(linear(q.r), linear(q.g), linear(q.b));
      steps.push_back(std::abs(b.l - a.l));
    }
    const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
    EXPECT_LT(*most / *least, 3.0);
  }
}

RasterView view_of(int width, int height, const std::vector<float>& values) {
  return {width, height, 1, [width, &values](int line, int, std::span<float> out) {
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(line) * width, width, out.begin());
          }};
}

TEST(Picture, AveragesSquaresAndLeavesOutWhatIsNotFinite) {
  const std::vector<float> values{1, 3, 10, 5, 7, NAN, 2, 4, INFINITY};
  const Layer layer = averaged_layer(view_of(3, 3, values), 0, 2);
  ASSERT_EQ(layer.width, 2);
  ASSERT_EQ(layer.height, 2);
  EXPECT_EQ(layer.values[0], 4.0f);
  EXPECT_EQ(layer.values[1], 10.0f);
  EXPECT_EQ(layer.values[2], 3.0f);
  EXPECT_TRUE(std::isnan(layer.values[3]));
}

TEST(Picture, PercentilesOfEqualValuesStillSpanSomething) {
  Layer layer{10, 10, std::vector<float>(100)};
  for (std::size_t i = 0; i < 100; ++i) layer.values[i] = static_cast<float>(i);
  EXPECT_EQ(percentiles(layer, 0.0, 1.0).high, 99.0);
  EXPECT_EQ(percentiles(layer, 0.1, 0.9).low, 9.0);
  layer.values.assign(100, 5.0f);
  EXPECT_LT(percentiles(layer, 0.01, 0.99).low, 5.0);
  EXPECT_GT(percentiles(layer, 0.01, 0.99).high, 5.0);
  layer.values[7] = 6.0f;
  EXPECT_EQ(percentiles(layer, 0.01, 0.99).high, 6.0);
}

TEST(Picture, GreyInSunlightLooksGrey) {
  const std::vector<double> visible{0.65, 0.56, 0.48}, with_infrared{0.85, 0.65, 0.56};
  std::vector<Layer> layers;
  for (const double um : visible) {
    Layer layer{10, 10, {}};
    for (int i = 0; i < 100; ++i)
      layer.values.push_back(static_cast<float>(
          i * radiometry::integral(radiometry::solar_irradiance_1au(), um - 0.01, um + 0.01)));
    layers.push_back(layer);
  }
  for (float& value : layers[0].values) value *= 2.0f;  // redder than sunlight
  const std::vector<Range> ranges = colour_ranges(layers, visible, 0.0, 1.0);
  for (const std::size_t k : {0u, 1u, 2u}) {
    const double share = (layers[k].values[50] - ranges[k].low) / (ranges[k].high - ranges[k].low);
    EXPECT_NEAR(share, (k == 0 ? 2.0 : 1.0) * 50.0 / (99.0 * 1.2126), 1e-5) << k;
  }
  const std::vector<Range> own = colour_ranges(layers, with_infrared, 0.0, 1.0);
  for (const std::size_t k : {0u, 1u, 2u}) EXPECT_EQ(own[k].high, percentiles(layers[k], 0.0, 1.0).high);
}

TEST(Picture, HazeIsTakenFromAllThreeAlike) {
  const std::vector<double> visible{0.65, 0.56, 0.48};
  for (const double haze : {0.1, 0.5}) {
    std::vector<Layer> layers;
    for (const double um : visible) {
      const double sunlight = radiometry::integral(radiometry::solar_irradiance_1au(), um - 0.01, um + 0.01);
      layers.push_back({2, 1, {static_cast<float>(haze * sunlight), static_cast<float>(sunlight)}});
    }
    for (const Range& range : colour_ranges(layers, visible, 0.0, 1.0))
      EXPECT_NEAR(range.low / range.high, haze < 0.2 ? 0.0 : haze, 1e-5);
  }
}

TEST(Picture, ThermalChannelsAreShownInKelvins) {
  render::ImageInfo info;
  info.channels = {{"red", 0.66, 0.02}, {"B10", 10.9, 0.6}};
  EXPECT_FALSE(is_thermal(info, 0));
  EXPECT_TRUE(is_thermal(info, 1));
  Layer layer{1, 1, {static_cast<float>(radiometry::planck_w_m2_sr_um(10.9, 300.0))}};
  to_brightness_temperature_k(layer, 10.9);
  EXPECT_NEAR(layer.values[0], 300.0, 1e-4);
}

TEST(Picture, ColourNeedsThreeVisibleChannels) {
  render::ImageInfo info;
  info.channels = {{"blue", 0.48, 0.06}, {"green", 0.56, 0.06}, {"red", 0.655, 0.03}, {"nir", 0.865, 0.03}};
  EXPECT_EQ(picture_channels(info), (std::vector<int>{2, 1, 0}));
  info.channels.erase(info.channels.begin());
  EXPECT_EQ(picture_channels(info), (std::vector<int>{1}));
}

int big_endian(const std::string& bytes, std::size_t at) {
  int value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value * 256 + static_cast<unsigned char>(bytes[at + k]);
  return value;
}

TEST(Quicklook, IsAPngThatHoldsTheEnlargedImage) {
  if (const std::string why = why_not_built("png"); !why.empty()) GTEST_SKIP() << why;
  const std::vector<float> values{1, 2, 3, 4, 5, 6};
  RunRecord record;
  record.image.width_px = 3;
  record.image.height_px = 2;
  record.image.channels = {{"B10", 10.9, 0.6}};
  const std::string png = make_quicklook(view_of(3, 2, values), record, {});
  ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_GE(big_endian(png, 16), 3 * 253);
  EXPECT_GE(big_endian(png, 20), 2 * 253);
}

}  // namespace
}  // namespace ifov::io::test_products_picture
