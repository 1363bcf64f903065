#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/weather_series.h"
#include "core/error.h"

namespace ifov::atmosphere::test_weather_series {
namespace {

using Q = WeatherQuantity;
using geodesy::parse_utc;

WeatherSeries series_of(Q quantity, std::vector<WeatherKnot> knots, bool typical = false) {
  WeatherSeries::Knots all;
  all[static_cast<std::size_t>(quantity)] = std::move(knots);
  return {{"a place", {}, {}, {}}, std::move(all), typical};
}

TEST(WeatherSeries, TimesAreUtc) {
  EXPECT_DOUBLE_EQ(seconds_of_day(1970, 1, 2), 86400.0);
  EXPECT_NEAR(seconds_of(parse_utc("2000-01-01T12:00:00Z")), 946728000.0, 1e-3);
  EXPECT_NEAR(seconds_of(parse_utc("2000-01-01T12:00:00+02:00")), 946720800.0, 1e-3);
  EXPECT_TRUE(is_day(2024, 2, 29));
  EXPECT_FALSE(is_day(2023, 2, 29));
}

TEST(WeatherSeries, LinearWithinGapsAndHeldAtTheEnds) {
  const double start = seconds_of_day(2026, 6, 21);
  const WeatherSeries series = series_of(
      Q::pressure_pa, {{start, 100.0}, {start + 7200.0, 300.0}, {start + 7200.0 + 4.0 * 3600.0, 0.0}});
  const auto at = [&](const char* time) { return series.at(Q::pressure_pa, parse_utc(time)); };
  EXPECT_NEAR(*at("2026-06-21T01:00:00Z"), 200.0, 1e-6);
  EXPECT_NEAR(*at("2026-06-21T02:00:00Z"), 300.0, 1e-6);
  EXPECT_FALSE(at("2026-06-21T04:00:00Z"));  // four hours without a value
  EXPECT_NEAR(*at("2026-06-20T23:40:00Z"), 100.0, 1e-6);
  EXPECT_FALSE(at("2026-06-20T23:20:00Z"));
  EXPECT_NEAR(*at("2026-06-21T06:20:00Z"), 0.0, 1e-6);
  EXPECT_FALSE(at("2026-06-21T06:40:00Z"));
  EXPECT_FALSE(series.at(Q::cloud_fraction, parse_utc("2026-06-21T01:00:00Z")));
}

TEST(WeatherSeries, TypicalYearsGoRound) {
  const WeatherSeries series = series_of(Q::wind_speed_m_s,
                                         {{seconds_of_day(2001, 1, 1) + 1800.0, 4.0},
                                          {seconds_of_day(2001, 1, 1) - 1800.0, 2.0},
                                          {seconds_of_day(2001, 2, 28) + 3600.0, 7.0}},
                                         true);
  const auto at = [&](const char* time) { return series.at(Q::wind_speed_m_s, parse_utc(time)); };
  EXPECT_NEAR(*at("2031-01-01T00:00:00Z"), 3.0, 1e-9);
  EXPECT_NEAR(*at("2030-12-31T23:45:00Z"), 2.5, 1e-9);
  EXPECT_NEAR(*at("2024-02-29T01:00:00Z"), 7.0, 1e-9);  // as on the 28th
}

TEST(WeatherSeries, HumidityAndDewPointFollowFromEachOther) {
  const double time = seconds_of_day(2026, 6, 21);
  WeatherSeries::Knots knots;
  knots[static_cast<std::size_t>(Q::air_temperature_k)] = {{time, 293.15}};
  knots[static_cast<std::size_t>(Q::dew_point_k)] = {{time, 283.15}};
  const WeatherSeries series({"a", {}, {}, {}}, knots);
  // Saturation pressures of 1228 and 2339 Pa (WMO tables).
  EXPECT_NEAR(*series.at(Q::relative_humidity, parse_utc("2026-06-21")), 1228.0 / 2339.0, 1e-3);
  EXPECT_NEAR(dew_point_k(saturation_pressure_pa(281.0)), 281.0, 1e-9);
  EXPECT_NEAR(saturation_pressure_pa(273.16), 611.657, 1.0);  // the triple point
  EXPECT_NEAR(saturation_pressure_pa(313.15), 7384.9, 30.0);
}

TEST(WeatherSeries, RefusesWhatCannotBe) {
  EXPECT_THROW(series_of(Q::pressure_pa, {{0.0, NAN}}), InputError);
  EXPECT_THROW(series_of(Q::pressure_pa, {{5.0, 1.0}, {5.0, 2.0}}), InputError);
  try {
    series_of(Q::pressure_pa, {{5.0, 1.0}, {5.0, 2.0}});
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a place: found two values of pressure_pa at one time");
  }
}

}  // namespace
}  // namespace ifov::atmosphere::test_weather_series
