#include "io/tables/number_table.h"

#include "core/format.h"
#include "io/tables/text_table.h"

namespace ifov::io {

NumberTable read_number_table(const std::filesystem::path& path, std::size_t columns) {
  const TextFile file(path);
  NumberTable table;
  table.columns = columns;
  bool heading_allowed = true;
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    const std::vector<Field> fields = split(line, separator_of(line));
    if (heading_allowed && !number_in(fields[0].text)) {
      heading_allowed = false;
      continue;
    }
    heading_allowed = false;
    if (fields.size() != columns)
      file.fail(number, 0, format("found {} fields; expected {} numbers", fields.size(), columns));
    for (const Field& field : fields) {
      const std::optional<double> value = number_in(field.text);
      if (!value) file.fail(number, field.column, format("found '{}'; expected a number", field.text));
      table.values.push_back(*value);
    }
  }
  return table;
}

}  // namespace ifov::io
