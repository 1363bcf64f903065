#include <gtest/gtest.h>

#include <cmath>

#include "io/product_parts/stac_item.h"

namespace ifov::io::test_stac_item {
namespace {

double area(const StacRing& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const StacPlace a = ring[k], b = ring[(k + 1) % ring.size()];
    twice += a.longitude_deg * b.latitude_deg - b.longitude_deg * a.latitude_deg;
  }
  return 0.5 * twice;
}

TEST(StacPolygons, RunCounterClockwise) {
  for (const StacRing& outline :
       {StacRing{{4, 51}, {5, 51}, {5, 52}, {4, 52}}, {{4, 51}, {4, 52}, {5, 52}, {5, 51}, {4, 51}}}) {
    const auto polygons = stac_polygons(outline);
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons.front().size(), 4u);
    EXPECT_DOUBLE_EQ(area(polygons.front()), 1.0);
  }
}

TEST(StacPolygons, NoPlaceForNoOutline) {
  EXPECT_TRUE(stac_polygons({}).empty());
  EXPECT_TRUE(stac_polygons({{4, 51}, {5, 51}}).empty());
  EXPECT_TRUE(stac_polygons({{4, 51}, {5, 51}, {4, 51}, {5, 51}}).empty());
  EXPECT_TRUE(stac_polygons({{4, 51}, {5, 52}, {6, 53}}).empty()) << "a line";
}

TEST(StacPolygons, WhatCrossesItselfIsItsHull) {
  const auto polygons = stac_polygons({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  ASSERT_EQ(polygons.size(), 1u);
  EXPECT_EQ(polygons.front().size(), 4u);
  EXPECT_DOUBLE_EQ(area(polygons.front()), 4.0);
  const auto bent = stac_polygons({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});  // hollow, but no crossing
  EXPECT_EQ(bent.front().size(), 5u);
  EXPECT_DOUBLE_EQ(area(bent.front()), 10.0);
}

TEST(StacPolygons, OverTheDateLineAreTwo) {
  const auto polygons = stac_polygons({{179, 10}, {-178, 10}, {-178, 11}, {179, 11}});
  ASSERT_EQ(polygons.size(), 2u);
  EXPECT_DOUBLE_EQ(area(polygons[0]), 1.0);
  EXPECT_DOUBLE_EQ(area(polygons[1]), 2.0);
  for (const StacPlace place : polygons[0])
    EXPECT_TRUE(place.longitude_deg >= 179.0 && place.longitude_deg <= 180.0);
  for (const StacPlace place : polygons[1])
    EXPECT_TRUE(place.longitude_deg >= -180.0 && place.longitude_deg <= -178.0);
}

TEST(StacAssets, AreNamedByWhatTheyHold) {
  const StacAsset radiance = stac_asset("flight_7_radiance.img", "flight_7");
  EXPECT_EQ(radiance.key, "radiance");
  EXPECT_TRUE(radiance.has_channels);
  EXPECT_EQ(radiance.roles, (std::vector<std::string>{"data"}));
  EXPECT_EQ(stac_asset("flight_7_half_width.img", "flight_7").roles,
            (std::vector<std::string>{"data", "uncertainty"}));
  EXPECT_FALSE(stac_asset("flight_7_location.img", "flight_7").has_channels);
  EXPECT_EQ(stac_asset("flight_7_radiance.tif", "flight_7").key, "geotiff");
  EXPECT_EQ(stac_asset("flight_7_radiance.img.hdr", "flight_7").key, "radiance_header");
  EXPECT_EQ(stac_asset("flight_7_quicklook.png", "flight_7").roles, (std::vector<std::string>{"overview"}));
}

}  // namespace
}  // namespace ifov::io::test_stac_item
