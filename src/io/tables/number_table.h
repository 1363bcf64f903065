#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "io/tables/text_table.h"

namespace ifov::io {

/// Comma-separated numbers below a heading of the columns' names.
struct NumberTable {
  TextFile file;
  std::vector<int> lines;                            ///< of the file, of each row
  std::vector<std::optional<std::size_t>> field_of;  ///< by column as asked for: its field; none: not there
  std::vector<std::vector<double>> rows;             ///< by column as asked for; 0 where not there

  bool has(std::size_t column) const { return field_of[column].has_value(); }
  [[noreturn]] void fail(std::size_t row, std::string_view message) const {
    file.fail(lines[row], 0, std::string(message));
  }
};

/// A column, and how numbers in it count.
struct NumberColumn {
  ColumnRange range;
  double scale = 1.0;
};

/// Some of the columns, in any order; rows one at least. InputError at the line and column of the file. `what`: "a lens".
NumberTable read_number_table(const std::filesystem::path& path, std::span<const NumberColumn> columns,
                              std::string_view what);

}  // namespace ifov::io
