#include "io/tables/column_table.h"

#include <algorithm>

#include "core/format.h"
#include "io/tables/text_table.h"

namespace ifov::io {

std::vector<std::vector<double>> read_column_table(const std::filesystem::path& path,
                                                   std::string_view of_what,
                                                   std::span<const ChannelRange> channels, int columns) {
  const TextFile file(path);
  std::vector<std::vector<double>> numbers(channels.size());
  char separator = 0;
  int lines = 0, last = 0;
  for (int line = 1; line <= file.line_count(); ++line) {
    const std::string_view text = file.line(line);
    if (is_blank(text) || is_comment(text)) continue;
    const bool first = separator == 0;
    if (first) separator = separator_of(text);
    const std::vector<Field> fields = split(text, separator);
    const auto is_number = [](const Field& field) { return number_in(field.text).has_value(); };
    if (first && std::none_of(fields.begin(), fields.end(), is_number)) continue;  // its heading
    if (fields.size() != channels.size())
      file.fail(
          line, fields.size() > channels.size() ? fields[channels.size()].column : 0,
          format("found {} numbers; expected {}, one for each channel", fields.size(), channels.size()));
    if (lines == columns)
      file.fail(line, 0,
                format("found more lines than the image has columns; expected {}, one for each", columns));
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::string name = format("{} of channel '{}'", of_what, channels[c].channel);
      numbers[c].push_back(number_of(file, line, fields[c], {name, channels[c].lowest, channels[c].highest}));
    }
    ++lines;
    last = line;
  }
  if (lines < columns)
    file.fail(
        last, 0,
        format("found {} lines of numbers; expected {}, one for each column of the image", lines, columns));
  return numbers;
}

}  // namespace ifov::io
