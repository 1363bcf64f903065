#include "io/document/cameras/view_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/names.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

/// Which column each field of a row is.
std::vector<std::size_t> read_heading(const TextFile& file, int line, std::span<const ViewColumn> columns) {
  std::vector<std::string> names;
  for (const ViewColumn& column : columns) names.emplace_back(column.name);
  std::vector<std::size_t> order;
  for (const Field& field : split(file.line(line), ',')) {
    const auto found = std::find(names.begin(), names.end(), field.text);
    if (found == names.end())
      file.fail(line, field.column,
                format("found the heading '{}'; expected {}{}", field.text, list_names(names),
                       did_you_mean(field.text, names)));
    const auto which = static_cast<std::size_t>(found - names.begin());
    if (std::find(order.begin(), order.end(), which) != order.end())
      file.fail(line, field.column, format("'{}' is there twice", field.text));
    order.push_back(which);
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (std::isnan(columns[c].otherwise) && std::find(order.begin(), order.end(), c) == order.end())
      file.fail(line, 0, format("the table has no column '{}'", columns[c].name));
  return order;
}

}  // namespace

std::vector<double> read_view_table(const std::filesystem::path& path, std::span<const ViewColumn> columns) {
  const TextFile file(path);
  std::vector<double> values;
  std::optional<std::vector<std::size_t>> order;
  for (int line = 1; line <= file.line_count(); ++line) {
    if (is_blank(file.line(line)) || is_comment(file.line(line))) continue;
    if (!order) {
      order = read_heading(file, line, columns);
      continue;
    }
    const std::vector<Field> fields = row_of(file, line, order->size());
    if (values.size() >= kMostViews * columns.size())
      file.fail(line, 0, format("found more than {} rows; expected at most that", kMostViews));
    const std::size_t first = values.size();
    for (const ViewColumn& column : columns) values.push_back(column.otherwise * column.scale);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const ViewColumn& column = columns[(*order)[k]];
      values[first + (*order)[k]] =
          number_of(file, line, fields[k], {column.name, column.lowest, column.highest}) * column.scale;
    }
  }
  if (!order) file.fail(0, 0, "found an empty file; expected a table of views");
  if (values.empty()) file.fail(0, 0, "found a heading without rows; expected one row at least");
  return values;
}

}  // namespace ifov::io
