#include "io/weather/time_table_file.h"

#include <algorithm>
#include <string>

#include "atmosphere/weather_series.h"
#include "core/format.h"
#include "core/names.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

/// The first line from `number` on that says something; 0 where there is none.
int told_line(const TextFile& file, int number) {
  while (number <= file.line_count() && (is_blank(file.line(number)) || is_comment(file.line(number))))
    ++number;
  return number <= file.line_count() ? number : 0;
}

const TimeTableColumn& column_of(const TextFile& file, int number, std::span<const TimeTableColumn> columns) {
  std::vector<std::string> choices;
  for (const TimeTableColumn& column : columns) choices.emplace_back(column.heading);
  const std::vector<Field> fields = split(file.line(number), ',');
  if (fields.size() != 2 || fields[0].text != "time")
    file.fail(
        number, fields[0].column,
        format("found the headings '{}'; expected 'time' and {}", file.line(number), list_names(choices)));
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const TimeTableColumn& column) {
    return column.heading == fields[1].text;
  });
  if (found == columns.end())
    file.fail(number, fields[1].column,
              format("found the heading '{}'; expected {}{}", fields[1].text, list_names(choices),
                     did_you_mean(fields[1].text, choices)));
  return *found;
}

double told_time(const TextFile& file, int number, const Field& field) {
  try {
    return atmosphere::seconds_of(geodesy::parse_utc(field.text));
  } catch (const InputError& error) {
    file.fail(number, field.column, error.what());
  }
}

}  // namespace

TimeTableRows read_time_table(const std::filesystem::path& path, std::span<const TimeTableColumn> columns) {
  return parse_time_table(TextFile(path), columns);
}

TimeTableRows parse_time_table(const TextFile& file, std::span<const TimeTableColumn> columns) {
  const int heading = told_line(file, 1);
  if (heading == 0) file.fail(0, 0, "found an empty file; expected a table over time");
  const TimeTableColumn& column = column_of(file, heading, columns);
  TimeTableRows rows;
  for (int number = told_line(file, heading + 1); number != 0; number = told_line(file, number + 1)) {
    const std::vector<Field> fields = row_of(file, number, 2);
    const double time_s = told_time(file, number, fields[0]);
    if (!rows.time_s.empty() && time_s <= rows.time_s.back())
      file.fail(number, fields[0].column,
                format("found the time {}; expected one after that of the row before", fields[0].text));
    rows.time_s.push_back(time_s);
    rows.value.push_back(column.offset +
                         number_of(file, number, fields[1], {column.heading, column.lowest, column.highest}));
  }
  if (rows.time_s.empty()) file.fail(heading, 0, "found no row below the headings; expected one at least");
  return rows;
}

}  // namespace ifov::io
