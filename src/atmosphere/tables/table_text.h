#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ifov::atmosphere {

/// One section of a file of data/atmosphere: a line `@word word ...` and the numbers below it.
struct TableSection {
  std::vector<std::string> words;
  std::vector<double> values;
};

/// The sections of a text in the order they stand in; lines that start with # are skipped.
std::vector<TableSection> parse_table_text(std::string_view text);

/// Every `stride`-th value of a section from `first` on: one column of its table.
std::vector<double> table_column(const TableSection& section, std::size_t first, std::size_t stride);

/// Linear in a table of rising x; `below` and `above` what lies outside.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at, double below,
                   double above);

}  // namespace ifov::atmosphere
