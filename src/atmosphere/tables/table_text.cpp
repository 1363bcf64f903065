#include "atmosphere/tables/table_text.h"

#include <algorithm>
#include <charconv>

namespace ifov::atmosphere {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    if (end > at) words.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

}  // namespace

std::vector<TableSection> parse_table_text(std::string_view text) {
  std::vector<TableSection> sections;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '@') {
      sections.emplace_back();
      for (const std::string_view word : words_of(line.substr(1))) sections.back().words.emplace_back(word);
      continue;
    }
    for (const std::string_view word : words_of(line)) {
      double value = 0.0;
      std::from_chars(word.data(), word.data() + word.size(), value);
      sections.back().values.push_back(value);
    }
  }
  return sections;
}

std::vector<double> table_column(const TableSection& section, std::size_t first, std::size_t stride) {
  std::vector<double> column;
  for (std::size_t i = first; i < section.values.size(); i += stride) column.push_back(section.values[i]);
  return column;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at, double below,
                   double above) {
  if (at < x.front()) return below;
  if (at >= x.back()) return at == x.back() ? y.back() : above;
  const std::size_t i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
  return y[i] + (y[i + 1] - y[i]) * (at - x[i]) / (x[i + 1] - x[i]);
}

}  // namespace ifov::atmosphere
