#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace ifov::io {

/// The lines of a text file, without their ends (LF, CR LF or CR); a byte-order mark is dropped.
class TextFile {
 public:
  /// Throws SystemError where the file cannot be read, InputError where it is larger than 256 MiB.
  explicit TextFile(const std::filesystem::path& path);
  /// The same of bytes in memory; `name` is what messages call them.
  TextFile(std::string name, std::string text);

  int line_count() const { return static_cast<int>(lines_.size()); }
  std::string_view line(int number) const {
    return lines_[static_cast<std::size_t>(number - 1)];
  }  ///< from 1
  const std::string& name() const { return name_; }

  /// Throws an InputError that shows the place: "file:line:column: message", the line, a caret. Line 0: the
  /// file as a whole; column 0: the line as a whole.
  [[noreturn]] void fail(int line, int column, const std::string& message) const;

 private:
  void find_lines();

  std::string name_;
  std::string text_;
  std::vector<std::string_view> lines_;
};

/// What fail() throws, for a line that does not come from a TextFile.
InputError table_error(const std::string& name, int number, int column, std::string_view line,
                       const std::string& message);

/// A piece of a line, without blanks and quotes around it, and its column from 1.
struct Field {
  std::string_view text;
  int column = 0;
};

/// Fields separated by `separator`; ' ' stands for any run of blanks and tabs.
std::vector<Field> split(std::string_view line, char separator);

/// The separator of a table, from one of its lines: ';', ',' or a tab where there is one, else blanks.
char separator_of(std::string_view line);

/// The number that is the whole of a text, if it is one and finite.
std::optional<double> number_in(std::string_view text);

/// What a column of a table may hold.
struct ColumnRange {
  std::string_view name;
  double lowest, highest;
};
/// The number of a field; fails where it is none or out of the column's range.
double number_of(const TextFile& file, int line, const Field& field, const ColumnRange& column);

/// The fields of a line, which are to be as many as those of the heading.
std::vector<Field> row_of(const TextFile& file, int line, std::size_t expected);

/// A text as a field of comma-separated values: in quotes where it holds what separates (RFC 4180).
std::string csv_field(std::string_view text);

bool is_comment(std::string_view line);  ///< starts with #, ; or //
bool is_blank(std::string_view line);
std::string lower_case(std::string_view text);

}  // namespace ifov::io
