#include "io/tables/number_table.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.h"

namespace ifov::io {

namespace {

constexpr std::string_view kSeparators = ",; \t\r";

/// Appends the numbers of a line; returns the column (from 1) of the first field that is not a number, else 0.
std::size_t parse_line(std::string_view line, std::vector<double>& numbers) {
  std::size_t at = 0;
  while ((at = line.find_first_not_of(kSeparators, at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, at), line.size());
    double number = 0.0;
    const auto [stop, code] = std::from_chars(line.data() + at, line.data() + end, number);
    if (code != std::errc() || stop != line.data() + end || !std::isfinite(number)) return at + 1;
    numbers.push_back(number);
    at = end;
  }
  return 0;
}

}  // namespace

NumberTable read_number_table(const std::filesystem::path& path, std::size_t columns) {
  std::ifstream file(path);
  if (!file) throw EnvironmentError(format("cannot read '{}'", path.string()));
  NumberTable table;
  table.columns = columns;
  std::vector<double> numbers;
  std::string line;
  bool heading_allowed = true;
  for (int number = 1; std::getline(file, line); ++number) {
    numbers.clear();
    if (line.find_first_not_of(kSeparators) == std::string::npos || line[line.find_first_not_of(kSeparators)] == '#')
      continue;
    const std::size_t bad = parse_line(line, numbers);
    if (bad != 0 && heading_allowed && numbers.empty()) {
      heading_allowed = false;
      continue;
    }
    if (bad != 0)
      throw InputError(format("{}:{}:{}: found something that is not a number; expected {} numbers", path.string(),
                              number, bad, columns),
                       {path.string(), number, static_cast<int>(bad)});
    if (numbers.size() != columns)
      throw InputError(format("{}:{}: found {} numbers; expected {}", path.string(), number, numbers.size(), columns),
                       {path.string(), number, 0});
    heading_allowed = false;
    table.values.insert(table.values.end(), numbers.begin(), numbers.end());
  }
  return table;
}

}  // namespace ifov::io
