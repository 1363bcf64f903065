#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/error.h"
#include "core/format.h"
#include "geodesy/utc_seconds.h"

namespace ifov::geodesy::test_utc_time {
namespace {

TEST(UtcTime, ReadsIso8601) {
  const UtcTime j2000 = parse_utc("2000-01-01T12:00:00Z");
  EXPECT_DOUBLE_EQ(j2000.jd1 + j2000.jd2, 2451545.0);
  EXPECT_EQ(format_utc(parse_utc("2003-10-17T12:30:30.25-07:00")), "2003-10-17T19:30:30.250Z");
  EXPECT_EQ(format_utc(parse_utc("2003-10-17T00:30:00+05:30")), "2003-10-16T19:00:00.000Z");
  EXPECT_EQ(format_utc(parse_utc("2003-10-17T19:30Z")), "2003-10-17T19:30:00.000Z");
  EXPECT_EQ(format_utc(parse_utc("2003-10-17T19:30+01:00")), "2003-10-17T18:30:00.000Z");
  EXPECT_EQ(format_utc(parse_utc("2003-10-17")), "2003-10-17T00:00:00.000Z");
  EXPECT_EQ(format_utc(parse_utc("2016-12-31T23:59:60Z")), "2016-12-31T23:59:60.000Z");
  EXPECT_EQ(format_utc(parse_utc("1950-06-01T01:02:03Z")), "1950-06-01T01:02:03.000Z");
}

TEST(UtcTime, SecondsBetween) {
  EXPECT_NEAR(seconds_after(parse_utc("2003-10-18T00:00:01.5Z"), parse_utc("2003-10-17T12:00+01:00")),
              46801.5, 1e-4);
  EXPECT_NEAR(seconds_after(parse_utc("2003-10-17"), parse_utc("2003-10-18")), -86400.0, 1e-4);
}

TEST(UtcTime, AnInstantIsTheSameInAllZones) {
  for (int zone_h = -12; zone_h <= 14; ++zone_h) {
    const int day = 17 + (12 + zone_h < 0 ? -1 : (12 + zone_h) / 24), hour = (36 + zone_h) % 24;
    const std::string text =
        format("2003-10-{:02}T{:02}:20{}{:02}:00", day, hour, zone_h < 0 ? '-' : '+', std::abs(zone_h));
    EXPECT_EQ(seconds_after(parse_utc(text), parse_utc("2003-10-17T12:20Z")), 0.0) << text;
  }
}

TEST(UtcTime, SaysWhatItExpects) {
  try {
    parse_utc("17 October 2003");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "found the time '17 October 2003'; expected ISO 8601 with a zone, such as "
                 "'2003-10-17T19:30:30Z' or '2003-10-17T12:30:30-07:00'");
  }
}

TEST(UtcTime, RefusesWhatIsNoTime) {
  for (const char* text :
       {"", "2003", "2003-10-17T19:30:30", "2003-13-01T00:00:00Z", "2003-02-29", "2003-10-17T24:30:00Z",
        "2003-10-17T19:60:00Z", "2003-10-17T19:30:61Z", "2017-12-31T23:59:60Z", "2003-10-17T19:30:30Zx",
        "2003-10-17T19:30:30+7:00", "2003-10-17T19:30:30.Z", "2003-10-17T19:30", "2003-10-17T19:30:Z",
        "2003-10-17T19:30:30+15:00", "2003-10-17 19:30:30Z"})
    EXPECT_THROW(parse_utc(text), InputError) << text;
}

}  // namespace
}  // namespace ifov::geodesy::test_utc_time
