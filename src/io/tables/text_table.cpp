#include "io/tables/text_table.h"

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "io/files/input_file.h"

namespace ifov::io {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::uint64_t kLargest_bytes = std::uint64_t{256} << 20;

/// A line as it can be shown: cut to a length, with bytes that are not plain ASCII made harmless.
std::string shown(std::string_view line) {
  std::string text(line.substr(0, 100));
  for (char& symbol : text)
    if (symbol < ' ' || symbol > '~') symbol = symbol == '\t' ? ' ' : '?';
  return text;
}

}  // namespace

TextFile::TextFile(const std::filesystem::path& path) : name_(path.string()) {
  const InputFile file(path);
  if (file.size() > kLargest_bytes) fail(0, 0, "a table of more than 256 MiB is not read");
  text_ = file.text();
  find_lines();
}

TextFile::TextFile(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  find_lines();
}

void TextFile::find_lines() {
  std::string_view rest = text_;
  if (rest.substr(0, 3) == "\xef\xbb\xbf") rest.remove_prefix(3);
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of("\r\n");
    lines_.push_back(rest.substr(0, end));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(rest.substr(end, 2) == "\r\n" ? end + 2 : end + 1);
  }
}

void TextFile::fail(int line, int column, const std::string& message) const {
  throw table_error(name_, line, column,
                    line > 0 && line <= line_count() ? this->line(line) : std::string_view(), message);
}

InputError table_error(const std::string& name, int number, int column, std::string_view line,
                       const std::string& message) {
  std::string text = name;
  if (number > 0) text += format(":{}", number);
  if (column > 0) text += format(":{}", column);
  text += ": " + message;
  if (line.data() != nullptr) {
    text += "\n  " + shown(line);
    if (column > 0 && column <= 100)
      text += "\n  " + std::string(static_cast<std::size_t>(column - 1), ' ') + "^";
  }
  return InputError(text, {name, number, column});
}

std::vector<Field> split(std::string_view line, char separator) {
  std::vector<Field> fields;
  const std::string_view separators = separator == ' ' ? kBlanks : std::string_view(&separator, 1);
  std::size_t at = separator == ' ' ? line.find_first_not_of(kBlanks) : 0;
  while (at != std::string_view::npos && at <= line.size()) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    std::size_t first = at, last = end;
    const auto trim = [&](std::string_view symbols) {
      while (first < last && symbols.find(line[first]) != std::string_view::npos) ++first;
      while (last > first && symbols.find(line[last - 1]) != std::string_view::npos) --last;
    };
    trim(kBlanks);
    trim("\"");
    fields.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    if (end == line.size()) break;
    at = separator == ' ' ? line.find_first_not_of(kBlanks, end) : end + 1;
  }
  return fields;
}

char separator_of(std::string_view line) {
  for (const char separator : {';', ',', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

std::optional<double> number_in(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

double number_of(const TextFile& file, int line, const Field& field, const ColumnRange& column) {
  const std::optional<double> value = number_in(field.text);
  if (!value)
    file.fail(line, field.column, format("found '{}' as '{}'; expected a number", field.text, column.name));
  if (!(*value >= column.lowest && *value <= column.highest))
    file.fail(line, field.column,
              format("found {} as '{}'; expected {:g} to {:g}", field.text, column.name, column.lowest,
                     column.highest));
  return *value;
}

std::vector<Field> row_of(const TextFile& file, int line, std::size_t expected) {
  std::vector<Field> fields = split(file.line(line), ',');
  if (fields.size() != expected)
    file.fail(line, 0, format("found {} values; expected {}, as the heading has", fields.size(), expected));
  return fields;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

bool is_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  return first != std::string_view::npos &&
         (line[first] == '#' || line[first] == ';' || line.substr(first, 2) == "//");
}

bool is_blank(std::string_view line) { return line.find_first_not_of(kBlanks) == std::string_view::npos; }

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& symbol : lower)
    if (symbol >= 'A' && symbol <= 'Z') symbol = static_cast<char>(symbol - 'A' + 'a');
  return lower;
}

}  // namespace ifov::io
