#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/format.h"
#include "geodesy/sun_position.h"
#include "io/files/input_file.h"
#include "io/spectra_files.h"
#include "io/weather/weather_file.h"
#include "support/truth_data.h"

namespace ifov::io::test_weather {
namespace {

using Q = atmosphere::WeatherQuantity;
using geodesy::parse_utc;

constexpr double kDegree = std::numbers::pi / 180.0;

std::string epw(const std::string& rows) {
  return "LOCATION,AMSTERDAM,-,NLD,IWEC Data,062400,52.30,4.77,1.0,-2.0\r\nDESIGN CONDITIONS,0\r\n"
         "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\r\n" +
         rows;
}

std::string epw_row(const std::string& time, const std::string& values) {
  // Flags, then dry bulb, dew point, humidity, pressure, two of extraterrestrial, infrared, GHI, DNI, DHI,
  // illuminances, wind, cloud.
  return time + ",60,?," + values + ",0,0,0,0,340,6.7,6,6\r\n";
}

const std::string kTmyHead =
    "723170,\"GREENSBORO\",NC,-5.0,36.100,-79.950,273\n"
    "Date (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),DNI (W/m^2),DHI (W/m^2),TotCld (tenths),Dry-bulb "
    "(C),Dew-point (C),"
    "RHum (%),Pressure (mbar),Wdir (degrees),Wspd (m/s)\n";

std::string surfrad_row(int hour, int minute, const std::string& temperature) {
  // 8 of time and zenith angle, then pairs of value and flag.
  std::string row = format(" 2016   1  1  1 {:2} {:2} {:6.3f} 120.00", hour, minute, hour + minute / 60.0);
  const std::string values[20] = {"-1.8",  "-0.8",      "0.0",   "1.5", "186.3", "265.0", "265.1",
                                  "250.0", "265.0",     "265.2", "0.0", "0.0",   "-1.0",  "-60.0",
                                  "-61.0", temperature, "52.7",  "3.1", "304.7", "773.5"};
  for (const std::string& value : values) row += format(" {:>7} {}", value, value == "-9999.9" ? 1 : 0);
  return row + "\n";
}

const std::string kSurfradHead = " Alamosa, CO\n  37.70  105.92 2317 m version 1\n";

atmosphere::WeatherSeries parse(const std::string& text, const WeatherOptions& options = {}) {
  return parse_weather(TextFile("a.txt", text), options);
}

std::string error_of(const std::string& text, const WeatherOptions& options = {}) {
  try {
    parse(text, options);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(0, what.find('\n'));
  }
  return "no error";
}

double celsius(const atmosphere::WeatherSeries& series, const std::string& time) {
  return series.at(Q::air_temperature_k, parse_utc(time)).value_or(NAN) - 273.15;
}

TEST(Weather, EpwTimesAndMissingValues) {
  const auto series = parse(epw(epw_row("1995,1,1,1", "5.0,1.8,79,100100,0,1415,288,100,0,0") +
                                epw_row("1995,1,1,2", "7.0,99.9,999,999999,0,1415,9999,200,0,0")));
  EXPECT_FALSE(series.typical_year());
  EXPECT_EQ(series.site().name, "AMSTERDAM");
  EXPECT_NEAR(*series.site().longitude_rad, 4.77 * kDegree, 1e-12);
  // Hour 1 ends at 1 h of the zone UTC+1, that is 0 h UTC.
  EXPECT_NEAR(celsius(series, "1995-01-01T00:00:00Z"), 5.0, 1e-9);
  EXPECT_NEAR(celsius(series, "1995-01-01T00:15:00Z"), 5.5, 1e-9);
  // Irradiances are means over the hour before: they stand at its middle.
  EXPECT_NEAR(*series.at(Q::global_irradiance, parse_utc("1994-12-31T23:30:00Z")), 100.0, 1e-9);
  EXPECT_NEAR(*series.at(Q::global_irradiance, parse_utc("1995-01-01T00:00:00Z")), 150.0, 1e-9);
  EXPECT_EQ(series.knots(Q::pressure_pa).size(), 1u);
  EXPECT_EQ(series.knots(Q::longwave_irradiance).size(), 1u);
  EXPECT_EQ(series.knots(Q::dew_point_k).size(), 1u);
  EXPECT_NEAR(*series.at(Q::cloud_fraction, parse_utc("1995-01-01T00:30:00Z")), 0.6, 1e-12);
  EXPECT_FALSE(series.at(Q::air_temperature_k, parse_utc("1995-01-01T03:00:00Z")));
}

TEST(Weather, TmyTypicalYears) {
  const auto series = parse(kTmyHead +
                            "12/31/1980,24:00,0,0,0,10,2.0,0.6,89,980,350,2.6\n"
                            "01/01/1988,01:00,0,0,0,10,4.0,6.1,-9900,993,10,6.2\n"
                            "01/01/1988,02:00,0,0,0,10,6.0,6.1,77,993,200,6.2\n");
  EXPECT_TRUE(series.typical_year());
  // 24 h at UTC-5 is 5 h UTC of any 1 January, and the next hour belongs to another year.
  EXPECT_NEAR(celsius(series, "2026-01-01T05:30:00Z"), 3.0, 1e-9);
  EXPECT_NEAR(celsius(series, "1950-01-01T06:30:00Z"), 5.0, 1e-9);
  // 350 to 10 degrees by north, not by south.
  EXPECT_NEAR(std::remainder(*series.at(Q::wind_direction_rad, parse_utc("2026-01-01T05:30:00Z")), 2 * M_PI),
              0.0, 1e-9);
  EXPECT_NEAR(*series.at(Q::pressure_pa, parse_utc("2026-01-01T05:00:00Z")), 98000.0, 1e-6);
  EXPECT_EQ(series.knots(Q::relative_humidity).size(), 2u);
  EXPECT_FALSE(series.at(Q::air_temperature_k, parse_utc("2026-07-01T05:30:00Z")));
}

TEST(Weather, SurfradFlagsAndOffsets) {
  const auto series = parse(kSurfradHead + surfrad_row(0, 1, "-7.6") + surfrad_row(0, 2, "-9999.9") +
                            surfrad_row(0, 3, "-7.8"));
  EXPECT_NEAR(celsius(series, "2016-01-01T00:02:00Z"), -7.7, 1e-9);  // bridged
  EXPECT_EQ(series.knots(Q::air_temperature_k).size(), 2u);
  EXPECT_DOUBLE_EQ(series.knots(Q::global_irradiance)[0].value, 0.0);  // -1.8 at night
  EXPECT_NEAR(*series.at(Q::longwave_irradiance, parse_utc("2016-01-01T00:01:30Z")), 186.3, 1e-9);
  EXPECT_DOUBLE_EQ(series.knots(Q::longwave_irradiance)[0].time_s,
                   series.knots(Q::air_temperature_k)[0].time_s - 30.0);
  EXPECT_NEAR(*series.site().longitude_rad, -105.92 * kDegree, 1e-12);
}

TEST(Weather, OwnTables) {
  const auto series = parse(
      "# by hand\ntime,air_temperature_c,relative_humidity_pct,wind_speed_m_s\n2026-06-21T10:00:00Z,20,50,\n"
      "2026-06-21T13:00:00+01:00,24,40,3\n");
  EXPECT_NEAR(celsius(series, "2026-06-21T11:00:00Z"), 22.0, 1e-9);
  EXPECT_NEAR(*series.at(Q::wind_speed_m_s, parse_utc("2026-06-21T12:20:00Z")), 3.0, 1e-12);
  EXPECT_FALSE(series.at(Q::wind_speed_m_s, parse_utc("2026-06-21T11:00:00Z")));
  // The dew point of air at 20 degrees and 50 % is 9.3 degrees.
  EXPECT_NEAR(*series.at(Q::dew_point_k, parse_utc("2026-06-21T10:00:00Z")) - 273.15, 9.27, 0.02);
}

// The example of the page on formats is read as it stands there.
TEST(Weather, ExampleInTheDocs) {
  const std::string page = read_input(IFOV_SOURCE_DIR "/docs/formats/weather.md");
  const std::size_t begin = page.find("```\n") + 4;
  const auto series = parse(page.substr(begin, page.find("```", begin) - begin));
  EXPECT_NEAR(celsius(series, "2026-06-21T06:30:00Z"), 15.55, 1e-9);
  for (std::size_t q = 0; q < atmosphere::kWeatherQuantities; ++q)
    EXPECT_NE(page.find(format("`{}`", atmosphere::name_of(static_cast<Q>(q)))), std::string::npos);
}

// The last hours of 28 February in a leap year are 29 February in UTC, west of Greenwich: none is lost.
TEST(Weather, TypicalYearsKeepTheEndOfFebruary) {
  std::string rows;
  for (int hour = 1; hour <= 24; ++hour)
    rows += format("02/28/1996,{:02}:00,0,0,0,10,{},0.6,89,980,350,2.6\n", hour, hour);
  rows += "03/01/1988,01:00,0,0,0,10,25,6.1,77,993,10,6.2\n";
  WeatherOptions options;
  options.typical_year = true;
  const auto series = parse(kTmyHead + rows, options);
  EXPECT_EQ(series.knots(Q::air_temperature_k).size(), 25u);
  EXPECT_NEAR(celsius(series, "2026-03-01T05:00:00Z"), 24.0, 1e-9);
  EXPECT_NEAR(celsius(series, "2026-03-01T05:30:00Z"), 24.5, 1e-9);
}

TEST(Weather, ErrorsShowThePlace) {
  EXPECT_EQ(error_of("lorem ipsum\n"),
            "a.txt:1: found no weather that is known here; expected EPW (LOCATION,...), TMY3, SURFRAD, or a "
            "table whose "
            "first heading is 'time' or 'hour_utc'");
  EXPECT_EQ(
      error_of("193 0.25\n  0.00  15.0\n"),
      "a.txt:1: found '193 0.25', rows and hours between them, as weather histories of DIRSIG begin: their columns are not read here, "
      "and tell neither date nor zone; expected a table whose first heading is 'time' or 'hour_utc'");
  EXPECT_EQ(error_of("193 0.25 1\n").substr(0, 43), "a.txt:1: found no weather that is known her");
  EXPECT_EQ(error_of(epw(epw_row("1995,1,1,1", "5.0,1.8,79,100100,0,1415,288,x,0,0"))),
            "a.txt:4:46: found 'x'; expected a number (global_irradiance)");
  EXPECT_EQ(error_of(epw(epw_row("1995,1,1,1", "95.0,1.8,79,100100,0,1415,288,0,0,0"))),
            "a.txt:4:17: found 95; expected air_temperature_k between -90 and 70");
  EXPECT_EQ(error_of(epw("1995,2,30,1,60,?,5\r\n")), "a.txt:4: found the day 1995-02-30, which there is not");
  EXPECT_EQ(error_of(epw("1995,2,3,25,60,?,5\r\n")), "a.txt:4:10: found 25; expected an hour from 1 to 24");
  EXPECT_EQ(error_of(epw("1995,2,3,2,60,?,5\r\n")),
            "a.txt:4: found 7 fields; expected a number (dew_point_k) in field 8");
  EXPECT_EQ(error_of(epw("")), "a.txt: found no rows of weather");
  EXPECT_EQ(error_of(kTmyHead + "13/31/1980,24:00,0\n"),
            "a.txt:3:1: found '13/31/1980'; expected a date MM/DD/YYYY");
  EXPECT_EQ(error_of(kTmyHead + "12/31/1980,2400,0\n"),
            "a.txt:3:12: found '2400'; expected a time HH:MM from 00:00 to 24:00");
  EXPECT_EQ(error_of(kSurfradHead + surfrad_row(0, 1, "-7.6") + " 2016 1 1\n"),
            "a.txt:4: found 3 fields; expected 48 of a daily file of SURFRAD");
  EXPECT_EQ(error_of("time,air_temperature_c\n2026-06-21,20\n2026-06-20,20\n"),
            "a.txt:3: found a time that does not follow that of the row before; expected rising times");
  EXPECT_EQ(error_of("time,air_temperature\n").substr(0, 63),
            "a.txt:1:6: found the heading 'air_temperature'; expected 'air_t");
  EXPECT_EQ(
      error_of("time,air_temperature_c\n21 June,20\n"),
      "a.txt:2:1: found the time '21 June'; expected ISO 8601 with a zone, such as '2003-10-17T19:30:30Z' or "
      "'2003-10-17T12:30:30-07:00'");
  EXPECT_EQ(
      error_of("hour_utc,minute_utc,air_temperature_c\n0,0,1\n"),
      "a.txt:1: found times of day without a date; expected a column 'time', or a date given with the file");
  EXPECT_EQ(error_of("time,air_temperature_c,air_temperature_k\n"),
            "a.txt:1:24: found air_temperature_k in two columns; expected one");
}

double sum(const atmosphere::WeatherSeries& series, Q quantity, double scale = 1.0, double offset = 0.0) {
  double total = 0.0;
  for (const auto& knot : series.knots(quantity)) total += knot.value * scale + offset;
  return total;
}

/// Irradiance that a series has while the Sun is below the horizon, as a part of all; from one hour in seven,
/// which come round to every hour of the day.
double part_at_night(const atmosphere::WeatherSeries& series, double shift_s) {
  double night = 0.0, all = 0.0;
  const double begin_s = atmosphere::seconds_of_day(atmosphere::WeatherSeries::kTypicalYear, 1, 1);
  const auto& knots = series.knots(Q::global_irradiance);
  for (std::size_t i = 0; i < knots.size(); i += 7) {
    all += knots[i].value;
    const geodesy::UtcTime time{2440587.5, (begin_s + knots[i].time_s + shift_s) / 86400.0};
    if (geodesy::sun_position(time, {*series.site().latitude_rad, *series.site().longitude_rad})
            .elevation_rad < -3.0 * kDegree)
      night += knots[i].value;
  }
  return night / all;
}

// Sums over the year of an EPW file, taken with another program, and the Sun as the judge of times.
TEST(Weather, ReferenceEpw) {
  const auto file = test::truth_file("weather/NLD_Amsterdam062400_IWEC.epw");
  if (!file) GTEST_SKIP() << "reference data not found: weather/NLD_Amsterdam062400_IWEC.epw";
  const auto series = read_weather(*file);
  EXPECT_TRUE(series.typical_year());
  EXPECT_EQ(series.knots(Q::air_temperature_k).size(), 8760u);
  EXPECT_NEAR(sum(series, Q::air_temperature_k, 1.0, -273.15), 87827.9, 0.01);
  EXPECT_NEAR(sum(series, Q::dew_point_k, 1.0, -273.15), 62447.9, 0.01);
  EXPECT_NEAR(sum(series, Q::relative_humidity, 100.0), 731652.0, 0.01);
  EXPECT_NEAR(sum(series, Q::global_irradiance), 982481.0, 0.01);
  EXPECT_NEAR(sum(series, Q::direct_irradiance), 698916.0, 0.01);
  EXPECT_NEAR(sum(series, Q::diffuse_irradiance), 590603.0, 0.01);
  EXPECT_NEAR(sum(series, Q::wind_speed_m_s), 46878.2, 0.01);
  EXPECT_LT(part_at_night(series, 0.0), 1e-4);
  EXPECT_GT(part_at_night(series, 7200.0), 1e-3);  // two hours of shift show
  // The humidity that the dew point gives is the one in the file, within rounding and the formula.
  int far = 0;
  for (const auto& knot : series.knots(Q::dew_point_k)) {
    const geodesy::UtcTime time{2440587.5, (atmosphere::seconds_of_day(2001, 1, 1) + knot.time_s) / 86400.0};
    const double expected = atmosphere::saturation_pressure_pa(*series.at(Q::dew_point_k, time)) /
                            atmosphere::saturation_pressure_pa(*series.at(Q::air_temperature_k, time));
    far += std::abs(*series.at(Q::relative_humidity, time) - expected) > 0.02 ? 1 : 0;
  }
  EXPECT_LT(far, 175);  // two in a hundred: single hours of the file do not agree with themselves
}

TEST(Weather, ReferenceTmy3) {
  const auto file = test::truth_file("weather/723170TYA.CSV");
  if (!file) GTEST_SKIP() << "reference data not found: weather/723170TYA.CSV";
  const auto series = read_weather(*file);
  EXPECT_TRUE(series.typical_year());
  EXPECT_EQ(series.knots(Q::air_temperature_k).size(), 8760u);
  EXPECT_EQ(series.knots(Q::cloud_fraction).size(), 8760u);
  EXPECT_LT(part_at_night(series, 0.0), 5e-4);
  EXPECT_GT(part_at_night(series, 7200.0), 1e-3);
  EXPECT_NEAR(*series.at(Q::air_temperature_k, parse_utc("2020-01-01T06:00:00Z")) - 273.15, 10.0, 1e-9);
}

TEST(Weather, ReferenceSurfradDay) {
  const auto file = test::truth_file("weather/surfrad_alamosa_2016-01-01_forcing.csv");
  if (!file) GTEST_SKIP() << "reference data not found: weather/surfrad_alamosa_2016-01-01_forcing.csv";
  WeatherOptions options;
  options.date = "2016-01-01";
  const auto series = read_weather(*file, options);
  EXPECT_EQ(series.knots(Q::air_temperature_k).size(), 1440u);
  EXPECT_NEAR(*series.at(Q::air_temperature_k, parse_utc("2016-01-01T00:00:30Z")) - 273.15, -7.65, 1e-9);
  EXPECT_NEAR(*series.at(Q::pressure_pa, parse_utc("2016-01-01T00:00:00Z")), 77350.0, 1e-6);
  EXPECT_GE(series.knots(Q::global_irradiance)[0].value, 0.0);
  // A file of another kind is told apart.
  const auto tower = test::truth_file("weather/US-AR1_2010_data_60.txt");
  EXPECT_NE(test::input_error(*tower, [](const auto& path) { read_weather(path); })
                .find("found no weather that is"),
            std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_weather
