#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "geodesy/sun_position.h"
#include "thermal/air_of_document.h"
#include "thermal/faces/sky_longwave.h"
#include "thermal/outdoors_series.h"
#include "thermal/sun_path.h"
#include "thermal/sun_split.h"
#include "thermal/weather_clock.h"

namespace ifov::thermal::test_outdoors_series {
namespace {

using atmosphere::WeatherKnot;
using atmosphere::WeatherSeries;
using Q = atmosphere::WeatherQuantity;

constexpr double kHour_s = 3600.0;
const geodesy::Geodetic kPlace{0.658, -1.849, 2317.0};  // Alamosa

/// The sine of the Sun's height every twenty minutes for three days, worked out once.
double sun_height(int i) {
  static const std::vector<double> heights = [] {
    std::vector<double> values;
    for (int k = 0; k < 3 * 72; ++k)
      values.push_back(
          std::sin(geodesy::sun_position(
                       {2440587.5, atmosphere::seconds_of_day(2016, 1, 1) / 86400.0 + k / 72.0}, kPlace)
                       .elevation_rad));
    return values;
  }();
  return heights[static_cast<std::size_t>(i)];
}

/// Days from 2016-01-01 0 h UTC on, every twenty minutes, with a clear Sun; the clock is ahead of UTC by `ahead_s`.
struct Made {
  double ahead_s = 0.0, night_w_m2 = 0.0;
  int days = 2;
  bool longwave = true, humidity = true, wind = true, direct = false;
};

WeatherSeries made(const Made& how) {
  WeatherSeries::Knots knots;
  const auto add = [&](Q quantity, double time_s, double value) {
    knots[static_cast<std::size_t>(quantity)].push_back({time_s, value});
  };
  const double begin_s = atmosphere::seconds_of_day(2016, 1, 1);
  for (int i = 0; i < how.days * 72; ++i) {
    const double time_s = begin_s + i * 1200.0, clock_s = time_s + how.ahead_s;
    const double height = sun_height(i);
    add(Q::air_temperature_k, clock_s, 280.0);
    add(Q::global_irradiance, clock_s, height > 0.0 ? 1000.0 * std::pow(height, 1.2) : how.night_w_m2);
    if (how.direct) add(Q::direct_irradiance, clock_s, height > 0.0 ? 700.0 : 0.0);
    if (how.wind) add(Q::wind_speed_m_s, clock_s, 2.0);
    if (how.humidity) add(Q::relative_humidity, clock_s, 0.5);
    if (how.longwave) add(Q::longwave_irradiance, clock_s, 180.0);
  }
  return {{"a station", {}, {}, {}}, std::move(knots)};
}

Span second_day() {
  Span span;
  span.end = geodesy::parse_utc("2016-01-02T23:50:00Z");
  span.spin_up_s = 23.0 * kHour_s;
  return span;
}

std::string message(const WeatherSeries& weather, const Span& span) {
  try {
    outdoors_of(weather, kPlace, span);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OutdoorsSeries, RowsOfADay) {
  const OutdoorsOfWeather found = outdoors_of(made({}), kPlace, second_day());
  ASSERT_EQ(found.series.rows.size(), 47u * 12u + 1u);
  EXPECT_NEAR(found.series.begin_s, atmosphere::seconds_of_day(2016, 1, 1) + 3000.0, 1e-3);
  const std::size_t noon = static_cast<std::size_t>((43.1 * kHour_s - 3000.0) / 300.0);
  const Outdoors& now = found.series.rows[noon];
  EXPECT_NEAR(now.sun_elevation_rad, 0.513, 0.003);
  EXPECT_NEAR(now.direct_w_m2 * std::sin(now.sun_elevation_rad) + now.diffuse_w_m2,
              1000.0 * std::pow(std::sin(now.sun_elevation_rad), 1.2), 5.0);
  EXPECT_EQ(now.longwave_w_m2, 180.0);
  EXPECT_NEAR(now.air.vapour_pa, 0.5 * atmosphere::saturation_pressure_pa(280.0), 1e-6);
  EXPECT_NEAR(now.air.pressure_pa, 76480.0, 200.0);  // of the standard atmosphere at 2317 m
  EXPECT_TRUE(std::isnan(now.wind_from_rad));        // nobody told
  ASSERT_EQ(found.notes.size(), 4u);
  EXPECT_EQ(found.notes[0], "direct and diffuse sunlight: from the global, by Erbs et al. (1982)");
  EXPECT_EQ(found.notes[1], "long-wave of the sky: measured");
  EXPECT_EQ(found.notes[3],
            "wind direction is not told: what slopes meets the wind as on average of all directions");
}

TEST(OutdoorsSeries, SkyByPrataWhereItIsNotMeasured) {
  Made how;
  how.longwave = false;
  const OutdoorsOfWeather found = outdoors_of(made(how), kPlace, second_day());
  const double expected = sky_longwave_w_m2(280.0, 0.5 * atmosphere::saturation_pressure_pa(280.0), 0.0);
  EXPECT_NEAR(found.series.rows[5].longwave_w_m2, expected, 1e-6);
  // A fault: a sky as warm as the air gives 90 W m-2 more.
  EXPECT_GT(kStefanBoltzmann_w_m2_k4 * std::pow(280.0, 4) - expected, 80.0);
  EXPECT_EQ(found.notes[1],
            "long-wave of the sky: by Prata (1996); no cloud is told, so the sky is taken to be clear");
}

/// The document's atmosphere stands in for long-wave that nobody measured, before Prata.
TEST(OutdoorsSeries, AirOfTheDocumentStandsIn) {
  AirOfDocument air;
  air.longwave_over_prata = 1.04;
  Made how;
  how.longwave = false;
  const OutdoorsOfWeather found = outdoors_of(made(how), kPlace, second_day(), &air);
  const double prata = sky_longwave_w_m2(280.0, 0.5 * atmosphere::saturation_pressure_pa(280.0), 0.0);
  EXPECT_NEAR(found.series.rows[5].longwave_w_m2, 1.04 * prata, 1e-6);
  EXPECT_EQ(
      found.notes[1],
      "long-wave of the sky: by the document's atmosphere, 1.040 of Prata (1996) at its own ground, as it changes "
      "with the air by Prata; no cloud is told, so the sky is taken to be clear");
  // What is measured comes first.
  EXPECT_EQ(outdoors_of(made({}), kPlace, second_day(), &air).series.rows[5].longwave_w_m2, 180.0);
  EXPECT_EQ(outdoors_of(made({}), kPlace, second_day(), &air).notes[1], "long-wave of the sky: measured");
  // No sky sends more than a black one.
  air.longwave_over_prata = 2.0;
  EXPECT_NEAR(outdoors_of(made(how), kPlace, second_day(), &air).series.rows[5].longwave_w_m2,
              kStefanBoltzmann_w_m2_k4 * std::pow(280.0, 4), 1e-6);

  air.clouds = "there are the atmosphere's own 1 layers";
  EXPECT_TRUE(outdoors_of(made(how), kPlace, second_day(), &air)
                  .notes[1]
                  .ends_with("; no cloud is told but there are the atmosphere's own 1 layers"));
}

TEST(OutdoorsSeries, DirectSunlightAsMeasured) {
  Made how;
  how.direct = true;
  const OutdoorsOfWeather found = outdoors_of(made(how), kPlace, second_day());
  EXPECT_NEAR(found.series.rows[500].direct_w_m2, 700.0, 1e-6);
}

TEST(OutdoorsSeries, DaysBeforeTheFirst) {
  Span span = second_day();
  span.spin_up_s = 72.0 * kHour_s;
  EXPECT_EQ(
      message(made({}), span),
      "'a station' does not tell air_temperature_k at 2015-12-29T23:50:00.000Z, which is needed from "
      "2015-12-29T23:50:00.000Z to 2016-01-02T23:50:00.000Z; it reaches back 23.8 h before the day shown: a "
      "\"spin_up\" of \"23 h\" or \"repeat_first_day\": true would do");
  span.repeat_first_day = true;
  const OutdoorsOfWeather found = outdoors_of(made({}), kPlace, span);
  EXPECT_NEAR(found.series.rows[200].sun_elevation_rad, found.series.rows[200 + 288].sun_elevation_rad,
              1e-12);
  EXPECT_EQ(found.notes.back(), "days before 2016-01-01T00:00:00.000Z are like the 24 hours from then on");
  span.end = geodesy::parse_utc("2016-01-09T00:00:00Z");
  EXPECT_NE(message(made({}), span).find("does not tell air_temperature_k at 2016-01-05T00:00:00.000Z"),
            std::string::npos);
}

// A picture before the first day of weather is over: the afternoons before it are like the one after it, and so is their Sun.
TEST(OutdoorsSeries, DaysBeforeAMorningHaveTheFirstDaysSun) {
  Span span = second_day();
  span.end = geodesy::parse_utc("2016-01-01T15:00:00Z");
  span.spin_up_s = 24.0 * kHour_s;
  span.repeat_first_day = true;
  const OutdoorsSeries series = outdoors_of(made({}), kPlace, span).series;
  const double noon_s = atmosphere::seconds_of_day(2016, 1, 1) + 19.0 * kHour_s;  // about the place's own
  for (const double back_s : {24.0 * kHour_s, 48.0 * kHour_s}) {
    const double row = (noon_s - back_s - series.begin_s) / series.step_s;
    if (row < 0.0) continue;
    const Outdoors& then = series.rows[static_cast<std::size_t>(std::round(row))];
    EXPECT_NEAR(then.sun_elevation_rad,
                geodesy::sun_position({2440587.5, noon_s / 86400.0}, kPlace).elevation_rad, 3e-4);
    EXPECT_GT(then.direct_w_m2, 300.0);
  }
}

// Twenty-four hourly rows are a day, though the last is an hour before the day's end; eighteen are not.
TEST(OutdoorsSeries, ADayToldHourByHourIsRepeated) {
  const auto hourly = [](int rows) {
    WeatherSeries::Knots knots;
    const double begin_s = atmosphere::seconds_of_day(2016, 1, 1);
    for (int i = 0; i < rows; ++i) {
      const auto add = [&](Q quantity, double value) {
        knots[static_cast<std::size_t>(quantity)].push_back({begin_s + i * kHour_s, value});
      };
      add(Q::air_temperature_k, 280.0 + i);
      add(Q::wind_speed_m_s, 2.0);
      add(Q::global_irradiance, 0.0);
      add(Q::longwave_irradiance, 200.0);
    }
    return WeatherSeries({"a station", {}, {}, {}}, knots);
  };
  Span span = second_day();
  span.end = geodesy::parse_utc("2016-01-01T10:00:00Z");
  span.spin_up_s = 24.0 * kHour_s;
  span.step_s = 900.0;
  span.repeat_first_day = true;
  const OutdoorsSeries series = outdoors_of(hourly(24), kPlace, span).series;
  const auto row_at = [&](double time_s) {
    return series.rows[static_cast<std::size_t>(std::round((time_s - series.begin_s) / span.step_s))];
  };
  const double midnight_s = atmosphere::seconds_of_day(2016, 1, 1);
  EXPECT_NEAR(row_at(midnight_s - kHour_s).air.temperature_k, 303.0 - 24.0 * 0.06, 1.0);
  EXPECT_NEAR(row_at(midnight_s - 0.5 * kHour_s).air.temperature_k, 291.5, 1e-6);
  EXPECT_EQ(
      message(hourly(18), span),
      "'a station' does not tell air_temperature_k at 2015-12-30T17:15:00.000Z, which is needed from "
      "2015-12-30T10:00:00.000Z to 2016-01-01T10:00:00.000Z; its first 24 hours, which stand for the days before, "
      "are not whole");
}

TEST(OutdoorsSeries, SaysWhatIsMissing) {
  Made how;
  how.wind = false;
  EXPECT_EQ(message(made(how), second_day()),
            "'a station' does not tell wind_speed_m_s, which surface temperatures need");
  how = {};
  how.longwave = how.humidity = false;
  EXPECT_EQ(message(made(how), second_day()),
            "'a station' does not tell relative_humidity, which surface temperatures need");
}

TEST(SunPath, AsThePositionItself) {
  const double begin_s = atmosphere::seconds_of_day(2016, 6, 1);
  const SunPath path(begin_s, begin_s + 86400.0, kPlace);
  for (const double at_s :
       {begin_s, begin_s + 1234.0, begin_s + 40000.0, begin_s + 70200.0, begin_s + 86400.0}) {
    const geodesy::SunPosition exact = geodesy::sun_position({2440587.5, at_s / 86400.0}, kPlace);
    const SunPath::Place found = path.at(at_s);
    EXPECT_NEAR(found.elevation_rad, exact.elevation_rad, 1.5e-4);
    EXPECT_NEAR(std::remainder(found.azimuth_rad - exact.azimuth_rad, 2.0 * std::numbers::pi) *
                    std::cos(exact.elevation_rad),
                0.0, 1.5e-4);
    EXPECT_NEAR(found.distance_au, exact.distance_au, 1e-6);
  }
  const double noon_s = solar_noon_s(begin_s + 50000.0, kPlace);
  EXPECT_NEAR(geodesy::sun_position({2440587.5, noon_s / 86400.0}, kPlace).azimuth_rad, std::numbers::pi,
              3e-4);
}

TEST(WeatherClock, UtcIsRecognised) {
  EXPECT_LT(std::abs(*noon_offset_s(made({}), kPlace)), 120.0);
  for (const double hours : {-7.0, -1.0, 1.0, 8.0}) {
    Made how;
    how.ahead_s = hours * kHour_s;
    how.days = 3;
    EXPECT_NEAR(*noon_offset_s(made(how), kPlace), hours * kHour_s, 120.0) << hours;
  }
}

TEST(WeatherClock, LocalTimeIsAnError) {
  Made how;
  how.ahead_s = -7.0 * kHour_s;
  EXPECT_EQ(
      message(made(how), second_day()),
      "the sunlight of 'a station' has its noon 418 minutes before the Sun at this place, expected at most 20; its "
      "clock may be local time: times 7.0 h later would make noon noon");
  how.ahead_s = 15.0 * 60.0;
  how.days = 3;
  EXPECT_EQ(message(made(how), second_day()), "");
  how.ahead_s = 25.0 * 60.0;
  EXPECT_NE(message(made(how), second_day()), "");
}

TEST(WeatherClock, LightByNightIsAnError) {
  Made how;
  how.night_w_m2 = 4.0;
  EXPECT_EQ(message(made(how), second_day()), "");
  how.night_w_m2 = 14.0;
  EXPECT_NE(message(made(how), second_day())
                .find("has sunlight of 14 W m-2 at 2016-01-01T00:50:00.000Z, while the Sun is"),
            std::string::npos)
      << message(made(how), second_day());
}

/// One row of a night with 40 W m-2: that is what is wrong, and not the clock.
TEST(WeatherClock, ARowOfANightIsNamed) {
  const WeatherSeries clear = made({});
  WeatherSeries::Knots knots;
  for (std::size_t q = 0; q < knots.size(); ++q) knots[q] = clear.knots(static_cast<Q>(q));
  auto& global = knots[static_cast<std::size_t>(Q::global_irradiance)];
  const double night_s = atmosphere::seconds_of_day(2016, 1, 2) + 5.0 * kHour_s;
  for (auto& knot : global)
    if (knot.time_s == night_s) knot.value = 40.0;
  const std::string told = message({{"a station", {}, {}, {}}, std::move(knots)}, second_day());
  EXPECT_NE(told.find("W m-2 at 2016-01-02T04:"), std::string::npos) << told;
  EXPECT_NE(told.find("while the Sun is"), std::string::npos) << told;
}

/// Where the Sun sinks steeply, an hour that ends in the dark has all of dusk in it, and the first hour of light may begin anywhere within
/// one: files told by the hour are no fault of the clock, by whatever minutes noon is off the hour.
TEST(WeatherClock, HoursAreFineEnough) {
  for (int minutes = 0; minutes < 60; minutes += 5)
    for (const double latitude : {0.0, 10.0, 50.0}) {
      const geodesy::Geodetic place{latitude * std::numbers::pi / 180.0,
                                    0.25 * minutes * std::numbers::pi / 180.0, 0.0};
      const double begin_s = atmosphere::seconds_of_day(2016, 3, 1);
      const SunPath sun(begin_s, begin_s + 2.0 * 86400.0, place);
      WeatherSeries::Knots knots;
      for (int hour = 0; hour <= 48; ++hour) {
        const double time_s = begin_s + hour * kHour_s, height = std::sin(sun.at(time_s).elevation_rad);
        const auto add = [&](Q quantity, double value) {
          knots[static_cast<std::size_t>(quantity)].push_back({time_s, value});
        };
        add(Q::air_temperature_k, 295.0);
        add(Q::global_irradiance, height > 0.0 ? 1000.0 * std::pow(height, 1.2) : 0.0);
        add(Q::wind_speed_m_s, 2.0);
        add(Q::longwave_irradiance, 380.0);
      }
      const WeatherSeries weather({"a station", {}, {}, {}}, std::move(knots));
      EXPECT_LT(std::abs(noon_offset_s(weather, place).value()), 10.0 * 60.0) << minutes << " " << latitude;
      Span span;
      span.end = geodesy::parse_utc("2016-03-03T00:00:00Z");
      span.spin_up_s = 24.0 * kHour_s;
      EXPECT_NO_THROW(outdoors_of(weather, place, span)) << minutes << " " << latitude;
    }
}

}  // namespace
}  // namespace ifov::thermal::test_outdoors_series
