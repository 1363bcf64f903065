#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"
#include "io/raster/map_reference.h"

namespace ifov::io::test_map_reference {
namespace {

TEST(MapReference, LongitudeComesBeforeLatitude) {
  // Heidelberg castle, 49.4106 N 8.7153 E, in UTM zone 32N of GRS 80 by Krueger's series to n^4 (Karney 2011).
  const MapReference geographic("EPSG:4326"), utm("EPSG:25832");
  EXPECT_TRUE(geographic.is_geographic());
  EXPECT_TRUE(utm.is_projected());
  EXPECT_DOUBLE_EQ(utm.metres_per_unit(), 1.0);
  const MapPoint place = MapTransform(geographic, utm)({8.7153, 49.4106});
  EXPECT_NEAR(place.x, 479348.0460, 0.001);
  EXPECT_NEAR(place.y, 5473140.8299, 0.001);
  const MapPoint back = MapTransform(utm, geographic)(place);
  EXPECT_NEAR(back.x, 8.7153, 1e-9);
  EXPECT_NEAR(back.y, 49.4106, 1e-9);
}

TEST(MapReference, SamenessAndNames) {
  const MapReference utm("EPSG:32632");
  EXPECT_EQ(utm.name(), "WGS 84 / UTM zone 32N");
  EXPECT_TRUE(utm.same_as(MapReference(utm.wkt())));
  EXPECT_FALSE(utm.same_as(MapReference("EPSG:32633")));
  EXPECT_NEAR(MapReference("EPSG:2263").metres_per_unit(), 1200.0 / 3937.0, 1e-12);  // New York, survey feet
}

TEST(MapReference, UnknownTextsAreErrors) {
  for (const char* text : {"EPSG:999999", "nowhere", "https://example.org/crs", "/etc/passwd", ""}) {
    try {
      MapReference reference{std::string(text)};
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("is no coordinate reference system that PROJ knows"),
                std::string::npos);
    }
  }
}

TEST(MapReference, PointsWithoutAPlaceAreErrors) {
  const MapTransform transform(MapReference("EPSG:4326"), MapReference("EPSG:25832"));
  std::vector<MapPoint> points{{9.0, 49.0}, {400.0, 95.0}};
  try {
    transform.apply(points);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the point 400, 95 of 'WGS 84' has no place in"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace ifov::io::test_map_reference
