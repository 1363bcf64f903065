#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace ifov::io {

/// Rows of numbers, all of the same length.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> values;
  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  const double* row(std::size_t r) const { return values.data() + r * columns; }
};

/// Reads a table in text: fields separated by commas, semicolons, tabs or blanks; empty lines and comment lines are
/// skipped, and so is one heading line before the first number. Throws InputError with file, line and
/// column where a row has another number of fields than `columns` or a field is not a finite number,
/// EnvironmentError where the file cannot be read.
NumberTable read_number_table(const std::filesystem::path& path, std::size_t columns);

}  // namespace ifov::io
