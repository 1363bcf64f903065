// Tables over time of comma-separated values, and what is said of mistaken ones.
#include <gtest/gtest.h>

#include "io/tables/text_table.h"
#include "io/weather/time_table_file.h"

namespace ifov::io::test_time_table {
namespace {

std::string error_of(const std::string& text,
                     std::span<const TimeTableColumn> columns = kTemperatureColumns) {
  try {
    parse_time_table(TextFile("a.csv", text), columns);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(0, what.find('\n'));
  }
  return "no error";
}

TEST(TimeTable, ReadsTimesWithTheirZones) {
  const TimeTableRows rows = parse_time_table(
      TextFile("a.csv",
               "# a hall\ntime, temperature_c\n1970-01-02T01:00+01:00,20\n\n1970-01-02T00:30Z,-40.5\n"),
      kTemperatureColumns);
  EXPECT_EQ(rows.time_s, (std::vector<double>{86400.0, 88200.0}));
  ASSERT_EQ(rows.value.size(), 2u);
  EXPECT_DOUBLE_EQ(rows.value[0], 293.15);
  EXPECT_DOUBLE_EQ(rows.value[1], 232.65);
  const TimeTableRows kelvins =
      parse_time_table(TextFile("a.csv", "time,temperature_k\n1970-01-02,300\n"), kTemperatureColumns);
  EXPECT_EQ(kelvins.value, std::vector<double>{300.0});
  const TimeTableRows power =
      parse_time_table(TextFile("a.csv", "time,power_w_m2\n1970-01-02,-60\n"), kPowerColumns);
  EXPECT_EQ(power.value, std::vector<double>{-60.0});
}

TEST(TimeTable, ErrorsShowThePlace) {
  EXPECT_EQ(error_of("# nothing\n"), "a.csv: found an empty file; expected a table over time");
  EXPECT_EQ(
      error_of("when,temperature_c\n"),
      "a.csv:1:1: found the headings 'when,temperature_c'; expected 'time' and 'temperature_c' or 'temperature_k'");
  EXPECT_EQ(
      error_of("time,temperatur_c\n"),
      "a.csv:1:6: found the heading 'temperatur_c'; expected 'temperature_c' or 'temperature_k'; did you mean "
      "'temperature_c'?");
  EXPECT_EQ(error_of("time,temperature_c\n", kPowerColumns),
            "a.csv:1:6: found the heading 'temperature_c'; expected 'power_w_m2'");
  EXPECT_EQ(error_of("time,temperature_c\n"),
            "a.csv:1: found no row below the headings; expected one at least");
  EXPECT_EQ(error_of("time,temperature_c\n2026-06-21T06:00Z,20\n2026-06-21T07:00+02:00,21\n"),
            "a.csv:3:1: found the time 2026-06-21T07:00+02:00; expected one after that of the row before");
  EXPECT_NE(error_of("time,temperature_c\n2026-06-21T06:00,20\n").find("a.csv:2:1: "), std::string::npos);
  EXPECT_NE(error_of("time,temperature_c\n2026-06-21T06:00,20\n").find("zone"), std::string::npos);
  EXPECT_NE(error_of("time,temperature_c\n2026-06-21T06:00Z,warm\n").find("a.csv:2:19: found 'warm'"),
            std::string::npos)
      << error_of("time,temperature_c\n2026-06-21T06:00Z,warm\n");
  EXPECT_NE(error_of("time,temperature_c\n2026-06-21T06:00Z,-274\n").find("a.csv:2:19: "), std::string::npos);
  EXPECT_NE(error_of("time,temperature_c\n2026-06-21T06:00Z\n").find("a.csv:2"), std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_time_table
