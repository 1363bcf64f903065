#include "io/tables/number_table.h"

#include <algorithm>
#include <string>

#include "core/format.h"
#include "core/names.h"

namespace ifov::io {
namespace {

/// The column of each field.
std::vector<std::size_t> heading_of(const TextFile& file, int line, std::span<const NumberColumn> columns) {
  std::vector<std::string> choices;
  for (const NumberColumn& column : columns) choices.emplace_back(column.range.name);
  std::vector<std::size_t> found;
  for (const Field& field : split(file.line(line), ',')) {
    const auto named = std::find(choices.begin(), choices.end(), field.text);
    if (named == choices.end())
      file.fail(line, field.column,
                format("found the heading '{}'; expected {}{}", field.text, list_names(choices),
                       did_you_mean(field.text, choices)));
    const auto column = static_cast<std::size_t>(named - choices.begin());
    if (std::find(found.begin(), found.end(), column) != found.end())
      file.fail(line, field.column, format("'{}' is there twice", field.text));
    found.push_back(column);
  }
  return found;
}

}  // namespace

NumberTable read_number_table(const std::filesystem::path& path, std::span<const NumberColumn> columns,
                              std::string_view what) {
  NumberTable table{TextFile(path), {}, std::vector<std::optional<std::size_t>>(columns.size()), {}};
  std::vector<std::size_t> heading;
  for (int line = 1; line <= table.file.line_count(); ++line) {
    if (is_blank(table.file.line(line)) || is_comment(table.file.line(line))) continue;
    if (heading.empty()) {
      heading = heading_of(table.file, line, columns);
      for (std::size_t k = 0; k < heading.size(); ++k) table.field_of[heading[k]] = k;
      continue;
    }
    const std::vector<Field> fields = row_of(table.file, line, heading.size());
    std::vector<double>& row = table.rows.emplace_back(columns.size(), 0.0);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const NumberColumn& column = columns[heading[k]];
      row[heading[k]] = number_of(table.file, line, fields[k], column.range) * column.scale;
    }
    table.lines.push_back(line);
  }
  if (heading.empty()) table.file.fail(0, 0, format("found an empty file; expected a table of {}", what));
  if (table.rows.empty()) table.file.fail(0, 0, "found a heading without rows; expected one row at least");
  return table;
}

}  // namespace ifov::io
